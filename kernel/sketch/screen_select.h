/// Selection of vertices and faces by shapes drawn over a picture: a rectangle, a lasso, a brush.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/region.h"
#include "kernel/sketch/pick_scene.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Elements selected by a shape.
enum class SelectKind {
    /// Vertices that are seen inside.
    vertices,
    /// Faces with a triangle whose centroid is seen inside; a brush also selects faces that it
    /// touches. With all their vertices.
    faces
};

struct SelectOptions {
    SelectKind kind = SelectKind::vertices;
    /// Includes elements that surfaces hide.
    bool through = false;
    /// Include faces seen from behind. Otherwise they are as if they were not there: neither
    /// selected, nor their vertices, nor hiding anything.
    bool back_faces = true;
    /// Vertices that are known already and not tested, so that a long stroke costs only as much as
    /// the new elements under it: a region for each object of the scene, or null.
    std::span<const Region* const> known = {};
};

/// Selected elements of one surface.
struct Selected {
    /// Its number in the scene.
    Index object;
    Region vertices;
    /// The selected faces, ascending; empty if vertices were asked for.
    std::vector<Index> faces;
    /// Vertices inside the shape that are not selected as they are not seen; empty if faces were
    /// asked for. They may be among the known ones as long as neither camera nor surface moves.
    Region unseen;
};

/// Selects the elements seen inside a shape, for every surface of the scene in their order. Pixels
/// may lie outside the picture. Elements partly behind the camera are selected by their part in
/// front. Errors: not_finite; invalid_argument for a negative radius, a picture without size, or
/// known vertices if faces are selected; topology_mismatch for those of another surface; cancelled.
///
/// Selects by the rectangle with two opposite corners `a` and `b`.
std::vector<Selected> select_rectangle(const PickScene& scene, const View& view, const Vec2& a,
                                       const Vec2& b, const SelectOptions& options = {},
                                       const Context& context = {});
/// Selects inside the closed outline, in either direction; if it crosses itself, everywhere that it
/// goes around at least once. Fewer than three points enclose nothing.
std::vector<Selected> select_lasso(const PickScene& scene, const View& view,
                                   std::span<const Vec2> outline, const SelectOptions& options = {},
                                   const Context& context = {});

/// A disk that is moved along a polyline; one point is a dab.
struct Brush {
    std::span<const Vec2> stroke;
    /// Pixels.
    double radius = 20.0;
};
std::vector<Selected> select_brush(const PickScene& scene, const View& view, const Brush& brush,
                                   const SelectOptions& options = {}, const Context& context = {});

}  // namespace lissom
