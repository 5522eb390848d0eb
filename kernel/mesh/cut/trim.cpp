#include "kernel/mesh/cut/trim.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/mesh/cut/cut_parts.h"
#include "kernel/mesh/cut/split.h"
#include "kernel/mesh/cut/surface_curve.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// The band in which distances are known reaches this many edges beyond the new boundary.
constexpr double kTrimBandEdges = 3.0;

// Maximum number of halvings of the smoothing until a line is found.
constexpr int kMaxHalvings = 3;

void require_options(const TrimOptions& options) {
    if (!(options.smoothing > 0.0 && options.smoothing <= 0.1)) {
        throw Error(ErrorCode::invalid_argument,
                    "smoothing is a fraction of the loop's length, above 0 and at most 0.1");
    }
    if (!(options.margin >= 0.0 && std::isfinite(options.margin))) {
        throw Error(ErrorCode::invalid_argument, "margin must be 0 or more");
    }
}

// The boundary's loop in its own direction, with the surface on the left.
const std::vector<Index>& loop_of(const Mesh& mesh, const Path& boundary) {
    if (boundary.on_mesh()) require_same_topology(mesh, boundary.topology(), "the boundary");
    if (!boundary.is_boundary()) {
        throw Error(ErrorCode::not_a_boundary,
                    "only an open boundary of the mesh can be trimmed; take one of its boundaries");
    }
    const Index smallest =
        *std::min_element(boundary.vertices().begin(), boundary.vertices().end());
    const auto& loops = mesh.topology().boundary_loops();
    return *std::find_if(loops.begin(), loops.end(),
                         [&](const auto& loop) { return loop[0] == smallest; });
}

[[noreturn]] void refuse_strip(const std::vector<Index>& loop) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : loop) elements.add(v);
    throw Error(ErrorCode::boundary_conflict,
                "no smooth line runs all around inside this boundary: another boundary is too "
                "close, or the mesh too coarse or too small there; subdivide it, or smooth less",
                std::move(elements));
}

// The contour at a constant distance from the smooth loop, just inside the innermost vertex; none
// if there is no such line all around.
std::vector<ContourLine> line_inside(const Mesh& mesh, const std::vector<Index>& loop,
                                     const SurfaceCurve& curve, double margin,
                                     const Context& context) {
    const double edge = edge_length_at(mesh, loop);
    double inside = -std::numeric_limits<double>::infinity();
    for (const Index v : loop) {
        inside = std::max(inside, curve.nearest(mesh.position(v)).left);
    }
    inside += margin * edge;
    const double width = std::abs(inside) + kTrimBandEdges * edge;
    const CurveDistances distances = distances_to_curve(mesh, curve, loop, width, context);
    std::vector<double> value = distances.left;
    for (double& x : value) x -= inside;
    return contour_along(mesh, level_set(mesh.topology(), std::move(value), 0.0), distances,
                         context);
}

// A loop with sharp turns may not bear as much smoothing as was asked for.
std::vector<ContourLine> new_boundary(const Mesh& mesh, const std::vector<Index>& loop,
                                      const TrimOptions& options, double& smoothing,
                                      const Context& context) {
    const std::vector<Vec3> normals = vertex_normals(mesh);
    smoothing = options.smoothing;
    for (int halved = 0; halved <= kMaxHalvings; ++halved, smoothing *= 0.5) {
        const SurfaceCurve curve(mesh, loop, normals, smoothing);
        std::vector<ContourLine> lines = line_inside(mesh, loop, curve, options.margin, context);
        if (!lines.empty()) return lines;
    }
    refuse_strip(loop);
}

Index removed_faces(const Mesh& mesh, const MeshMap& map) {
    std::vector<char> kept(mesh.face_count(), 0);
    for (Index f = 0; f < map.faces.size(); ++f) kept[map.faces.main_source(f)] = 1;
    return index_of(std::count(kept.begin(), kept.end(), 0));
}

}  // namespace

Trim trim(const Mesh& mesh, const Path& boundary, const TrimOptions& options,
          const Context& context) {
    require_options(options);
    require_cuttable(mesh, {.slide = options.slide});
    const std::vector<Index>& loop = loop_of(mesh, boundary);
    Progress progress(context, "trim");
    progress.step(0.6);
    double smoothing = 0.0;
    std::vector<ContourLine> lines = new_boundary(mesh, loop, options, smoothing, context);
    std::vector<signed char> side = sides_of(mesh, lines);
    if (side[loop[0]] > 0) refuse_strip(loop);
    assign_whole_components(mesh, side, [](const auto&) -> signed char { return 1; });
    const Splitting splitting{std::move(lines), std::move(side), options.slide};
    progress.step(0.4);
    SplitResult parts = split(mesh, splitting, context);
    SplitPart& part = parts.positive;
    Trim result{std::move(part.mesh), std::move(part.map), part.lines[0]};
    result.smoothing = smoothing;
    result.turn_before = mean_turn(mesh, Path(mesh.shared_topology(), loop, true));
    result.turn_after = mean_turn(result.mesh, result.boundary);
    result.removed_faces = removed_faces(mesh, result.map);
    result.divided_faces = parts.divided_faces;
    return result;
}

double mean_turn(const Mesh& mesh, const Path& path) {
    const std::vector<Vec3> p = path.points(mesh);
    const std::size_t n = p.size(), turns = path.closed() ? n : n - 2;
    double sum = 0.0;
    for (std::size_t i = 1; i <= turns; ++i) {
        const Vec3 a = p[i % n] - p[i - 1], b = p[(i + 1) % n] - p[i % n];
        sum += std::atan2(a.cross(b).norm(), a.dot(b));
    }
    return turns > 0 ? sum / turns : 0.0;
}

}  // namespace lissom
