/// Picking: finds the element under the cursor in a picture, by rays and by distances in pixels.
/// Nothing is drawn for it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Kinds of pickable elements, in order of preference within the radius: elements over a surface
/// before its own, and smaller ones before larger ones.
enum class PickKind {
    /// A point of a PointSet.
    point,
    /// A line of a PolylineSet.
    polyline,
    /// A vertex of a surface; one without faces is not found.
    vertex,
    /// A loop of Topology::boundary_loops.
    boundary,
    /// An edge of a surface.
    edge,
    /// A face of a surface, exactly under the cursor.
    face
};

struct PickOptions {
    /// Kinds to search for; the first of PickKind within the radius counts.
    std::vector<PickKind> kinds{PickKind::face};
    /// Pixels that points and lines may be away from the cursor.
    double radius = 8.0;
    /// Include faces seen from behind. Otherwise they are as if they were not there: neither picked
    /// nor hiding anything.
    bool back_faces = true;
    /// Includes elements that surfaces hide.
    bool through = false;
};

/// Picked element. Ids are those of the object's own elements.
struct PickHit {
    PickKind kind = PickKind::face;
    /// Number of the object in the scene, and of the point, line, vertex, loop, edge or face in it.
    Index object = kNoIndex, index = kNoIndex;
    /// Segment of lines, loops and edges (0 for an edge), and the fraction along it of the point
    /// seen nearest to the cursor, 0 to 1; an edge runs as Topology::edge says.
    Index segment = kNoIndex;
    double along = 0.0;
    /// Face of a surface at the point, the triangle of that face, the barycentric coordinates
    /// of the point in it and the nearest of its vertices. An edge or vertex has a face that is
    /// turned to the camera if there is one.
    Index face = kNoIndex;
    Triangle triangle{kNoIndex, kNoIndex, kNoIndex};
    Vec3 barycentric = Vec3::Zero();
    Index vertex = kNoIndex;
    /// Position and normal in the world. The normal has unit length; at vertices and edges it is
    /// the mean of the faces around, by angle; zero if there is no surface.
    Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
    /// Depth along the view, and distance from the cursor in pixels.
    double depth = 0.0, pixels = 0.0;
};

/// Returns the element under the cursor: of the first kind that is found, the nearest in pixels
/// that is not hidden, if it is nearer than `radius`; of equally near ones the one with the least
/// depth. Without `through`, hidden things are skipped; of very many within the radius the nearest
/// 10,000 are looked at. Points and lines may lie two pixels' length behind a surface without being
/// hidden by it. Errors: invalid_argument for a radius that is negative or not finite, or a picture
/// without size; not_finite for the cursor.
std::optional<PickHit> pick(const PickScene& scene, const View& view, const Vec2& cursor,
                            const PickOptions& options = {});

/// Returns all of it in that order, at most `most`; of faces with `through` all along the ray,
/// without it the first. Errors: as `pick`.
std::vector<PickHit> pick_all(const PickScene& scene, const View& view, const Vec2& cursor,
                              const PickOptions& options = {}, std::size_t most = 1000);

}  // namespace lissom
