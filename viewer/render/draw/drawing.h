/// Drawable content and its appearance. Plain data, without OpenGL and without names of a script.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"
#include "viewer/render/draw/image/color.h"
#include "viewer/render/draw/strand_style.h"

namespace lissom {

/// smooth: normals are averaged over the faces around a vertex, weighted by angle; edges sharper
/// than the crease angle stay sharp. flat: one normal a face.
enum class Shading { smooth, flat };

/// A region drawn in a colour of its own.
struct DrawnRegion {
    Region region;
    Color color = kRegionColor;

    bool operator==(const DrawnRegion&) const = default;
};

/// Style of a mesh. A face takes its colour from the first of these that applies: a handle with
/// all of the face's vertices; the values; the region, likewise; the last of the parts that does;
/// the attribute "color"; `color`.
struct MeshStyle {
    Color color = kClayColor;
    /// Draw the colours of the attribute "color" (read as sRGB) if the mesh has it.
    bool vertex_colors = true;
    Shading shading = Shading::smooth;
    /// Angle in radians between the normals of faces above which their edge is sharp.
    double crease = 50.0 * kPi / 180.0;
    /// 1: hides everything behind it, strands and lines too; below 1 those are visible through it,
    /// its own inside is not. Transparent meshes of one picture use the least opacity.
    double opacity = 1.0;
    /// Drawn a little nearer than it is, so that it hides the surface that it lies on.
    bool raised = false;

    /// Draw the polygons' own edges.
    bool wire = false;
    Color wire_color = kWireColor;
    /// Width of the edges in pixels.
    double wire_width = 1.0;

    /// Drawn in `region_color`.
    std::optional<Region> region = std::nullopt;
    Color region_color = kRegionColor;
    /// Drawn in `handle_color`; vertices of a handle that it holds no face of are drawn as points.
    std::vector<Region> handles = {};
    Color handle_color = kHandleColor;
    /// Drawn each in its colour, vertices of one that it holds no face of as points.
    std::vector<DrawnRegion> parts = {};

    /// Draw the loops of open boundaries as lines, each in its own colour.
    bool boundaries = false;
    /// Draw normals as lines of half the mean length of an edge: at vertices, and in the middle of
    /// faces. If there are many, an even selection.
    bool vertex_normals = false, face_normals = false;
    /// Width of these lines in pixels; points are three times as wide.
    double line_width = 4.0;

    /// One number a vertex, drawn in the colours of the scale; NaN is none. Empty: not drawn.
    std::vector<double> values = {};
};

using NamedRegions = std::map<std::string, Region, std::less<>>;

/// A mesh in the picture, which must not change while it is shared.
struct DrawnMesh {
    std::shared_ptr<const Mesh> mesh;
    MeshStyle style = {};
    /// Map from the mesh to the world of the camera.
    Affine transform = {};
    /// Identity of a mesh in the snapshots of a scene, so that unchanged data stays on the graphics
    /// card. Several with one number are told apart by their order.
    std::uint64_t object = 0;
    /// Regions by name in place of the mesh's own, if only these have changed since it was copied;
    /// null: the mesh's.
    std::shared_ptr<const NamedRegions> regions = nullptr;
};

/// Returns the named regions of a mesh in the picture.
inline const NamedRegions& regions_of(const DrawnMesh& drawn) {
    return drawn.regions ? *drawn.regions : drawn.mesh->regions();
}

/// Strands in the picture, which must not change while they are shared. They hide lines and points,
/// also those before them.
struct DrawnStrands {
    std::shared_ptr<const Strands> strands;
    StrandStyle style = {};
    /// Map from the mesh that they grow on to the world of the camera.
    Affine transform = {};
};

/// A line through points, of constant width in pixels.
struct DrawnLine {
    std::vector<Vec3> points;
    bool closed = false;
    Color color = kWireColor;
    double width = 4.0;

    bool operator==(const DrawnLine&) const = default;
};

/// A ball of constant radius in pixels.
struct DrawnPoint {
    Vec3 position = Vec3::Zero();
    Color color = kHandleColor;
    double radius = 5.0;

    bool operator==(const DrawnPoint&) const = default;
};

/// Numbers that the two ends of the colour scale stand for.
struct ValueRange {
    double low = 0.0;
    double high = 1.0;

    bool operator==(const ValueRange&) const = default;
};

/// Marks that belong together, for instance the curves of a hairstyle or the axes of a gizmo.
struct Overlay {
    std::vector<DrawnLine> lines = {};
    std::vector<DrawnPoint> points = {};
    /// No surface hides them.
    bool on_top = false;

    bool operator==(const Overlay&) const = default;
};

/// Returns the smallest range that holds all finite values of `meshes`; nothing if there are none.
std::optional<ValueRange> range_of_values(const std::vector<DrawnMesh>& meshes);

}  // namespace lissom
