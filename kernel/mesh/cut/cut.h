/// Cutting: a mesh becomes two along a smooth line that runs through its faces.
///
/// Triangles on the line are divided, polygons on it triangulated; all others stay as they are, to
/// the bit and in their order. A vertex closer to the line than `slide` of an edge is moved along
/// that edge onto it instead, so that no slivers appear. Attributes are interpolated, labels and
/// named regions carried, as `derive` does. Both parts have the same points along the line, to the
/// bit, so that together they are as watertight as before.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Choice of the lines in which a plane crosses a mesh.
enum class CutLoops {
    /// The one nearest to the picked point; the other lines of the plane leave the mesh whole.
    nearest,
    /// All of them.
    all,
};

struct CutOptions {
    CutLoops loops = CutLoops::nearest;
    /// A vertex slides onto the line if the line crosses one of its edges within this fraction of
    /// the edge's length; 0 to 0.45.
    double slide = 0.25;
};

struct CutPlane {
    Vec3 point = Vec3::Zero();
    /// Towards the part that is kept; of any length.
    Vec3 normal = Vec3::UnitY();
    /// A point on or near the part to keep, instead of the side that the normal points to.
    std::optional<Vec3> seed{};
    /// Reference point that selects the line; `point` if absent.
    std::optional<Vec3> near{};
};

/// A closed line to cut along.
struct CutPath {
    /// Through vertices, or free points near the surface; the cut follows the shortest ways along
    /// edges between them, smoothed.
    Path path;
    /// A point on or near the part to keep, instead of the part on the left of the path.
    std::optional<Vec3> seed{};
    /// The line is smoothed over two edges around, but over no more than this fraction of its
    /// length; above 0, at most 0.1.
    double smoothing = 0.04;
};

/// A region to cut out along its outlines, all of them at once.
struct CutRegion {
    Region region;
    /// Same as CutPath::smoothing.
    double smoothing = 0.04;
};

/// The line along which a function is 0, linear on the triangles of the mesh.
struct CutContour {
    /// One value a vertex, none of them NaN; the part with positive values is kept.
    std::vector<double> value;
};

/// Possible defects of a cut.
enum class CutConcern {
    /// A line ends at an open boundary, which now belongs to both parts in pieces.
    touches_boundary,
    /// A line is much more folded than its convex outline, as one around a body and its fins is.
    folded_line,
    /// The plane crosses the mesh not far from the line that was cut too.
    lines_nearby,
    /// A plane or path without a seed keeps more than 80 % of the mesh's area: perhaps the wrong
    /// part.
    keeps_most,
    /// A region has several outlines, which were all cut.
    several_outlines,
    /// The sides of the lines are connected elsewhere: a cut would fail. Only in previews.
    not_separating,
};

struct CutWarning {
    CutConcern concern = CutConcern::touches_boundary;
    /// Finding and remedy.
    std::string message;
    /// Old vertices of the finding.
    Elements elements;
};

struct CutReport {
    std::vector<CutWarning> warnings;
    /// Open boundaries that lines end at: numbers in `boundaries` of the old mesh, ascending.
    std::vector<Index> touched_boundaries;
    /// Lines in which the plane crosses the mesh and which were not cut.
    Index lines_left = 0;
    /// Components without a cut, which went to one part as a whole.
    Index whole_components = 0;
    /// Fraction of the mesh's area that lies on the side of the lines that is kept.
    double kept_fraction = 0.0;
    /// Old vertices that slid onto a line, ascending.
    std::vector<Index> slid_vertices;
    /// Old faces that were divided.
    Index divided_faces = 0;
};

/// A part of a mesh, with the old elements of its elements.
struct CutPiece {
    Mesh mesh;
    MeshMap map;
};

/// One line of a cut on both parts, each with its surface on the left: `rest` starts at the same
/// point as `kept` and runs the other way. Closed, unless it ends at open boundaries.
struct CutLine {
    Path kept, rest;
};

struct Cut {
    CutPiece kept, rest;
    std::vector<CutLine> lines;
    CutReport report;
};

/// Predicted lines of a cut.
struct CutPreview {
    /// Lines that would be cut, of free points, each with the kept part on its left.
    std::vector<Path> lines;
    /// Lines in which the plane crosses the mesh and which would stay whole.
    std::vector<Path> others;
    /// Without `slid_vertices` and `divided_faces`, which are known only after the mesh is divided.
    CutReport report;
};

/// Cuts by a plane. If the plane crosses the mesh in several lines, the one nearest to the picked
/// point is cut, so that a plane through a neck leaves the legs alone; everything connected to
/// either side of it goes there whole. Components that are not cut go to the side of the plane on
/// which the mean of their vertices lies. A plane that only touches the surface does not cross it.
/// Errors: mesh_empty; invalid_argument for a normal without length, options out of range, or a
/// plane that does not cross the mesh; not_finite; boundary_conflict if the line does not separate
/// the mesh, because both sides are connected elsewhere; nonmanifold_edge; cancelled.
Cut cut(const Mesh& mesh, const CutPlane& plane, const CutOptions& options = {},
        const Context& context = {});

/// Cuts along a closed path: on a smooth line near it rather than along its edges. It passes the
/// picked points within about an edge. The part on the left of the path, seen from outside, is
/// kept. Components that are not cut go to the side of the nearest point of the path. Errors:
/// mesh_empty; topology_mismatch; invalid_argument for an open path, one that visits a vertex
/// twice, or options out of range; boundary_conflict if the smooth line meets an open boundary or
/// does not separate the mesh; nonmanifold_edge; cancelled.
Cut cut(const Mesh& mesh, const CutPath& path, const CutOptions& options = {},
        const Context& context = {});

/// Cuts along the outlines of a region and keeps the region. Outlines that are open boundaries of
/// the mesh are no cuts. Components that are not cut go with most of their vertices. Errors:
/// mesh_empty; topology_mismatch; region_empty if the region holds no face; invalid_argument for
/// options out of range or a region without an outline to cut; boundary_conflict naming vertices if
/// an outline or its smooth line runs into an open boundary or another outline; nonmanifold_edge;
/// cancelled.
Cut cut(const Mesh& mesh, const CutRegion& region, const CutOptions& options = {},
        const Context& context = {});

/// Cuts along all lines on which a function is 0, exactly if `slide` is 0, and keeps the part with
/// positive values. Components without a line go to the side of their values' sum. Errors:
/// mesh_empty; invalid_argument for options out of range, a wrong number of values, or a function
/// without a line; not_finite for NaN; nonmanifold_edge; cancelled.
Cut cut(const Mesh& mesh, const CutContour& contour, const CutOptions& options = {},
        const Context& context = {});

/// Returns the lines along which `cut` would divide the mesh, before vertices slide onto them; the
/// mesh stays as it is. If the lines would not separate it, they are shown with a warning
/// (not_separating). Errors: otherwise as `cut`.
CutPreview preview_cut(const Mesh& mesh, const CutPlane& plane, const CutOptions& options = {},
                       const Context& context = {});
CutPreview preview_cut(const Mesh& mesh, const CutPath& path, const CutOptions& options = {},
                       const Context& context = {});
CutPreview preview_cut(const Mesh& mesh, const CutRegion& region, const CutOptions& options = {},
                       const Context& context = {});

}  // namespace lissom
