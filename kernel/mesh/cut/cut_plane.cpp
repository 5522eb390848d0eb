#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/memory_error.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/cut_parts.h"

namespace lissom {
namespace {

// Distances from the plane that rounding of the coordinates explains count as 0.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

// Another line is nearby if it is less than this many times as far from the picked point.
constexpr double kNearby = 2.0;

void require_plane(const CutPlane& plane) {
    const Vec3 near = plane.near.value_or(plane.point);
    if (!plane.point.allFinite() || !plane.normal.allFinite() || !near.allFinite()) {
        throw Error(ErrorCode::not_finite, "the plane's point or normal is NaN or infinite");
    }
    if (!(plane.normal.stableNorm() > 0.0)) {
        throw Error(ErrorCode::invalid_argument,
                    "the normal of the plane must have a length above 0");
    }
}

LevelSet distances_from(const Mesh& mesh, const CutPlane& plane) {
    const Vec3 normal = plane.normal.stableNormalized();
    std::vector<double> value;
    value.reserve(mesh.vertex_count());
    double largest = plane.point.cwiseAbs().maxCoeff();
    for (const Vec3& p : mesh.positions()) {
        value.push_back(normal.dot(p - plane.point));
        largest = std::max(largest, p.cwiseAbs().maxCoeff());
    }
    return level_set(mesh.topology(), std::move(value), kRounding * largest);
}

double distance_to(const Mesh& mesh, const ContourLine& line, const Vec3& p) {
    const std::vector<Vec3> points = line.points(mesh);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Vec3& a = points[i];
        const Vec3 along = points[(i + 1) % points.size()] - a;
        const double square = along.squaredNorm();
        const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, (p - a - t * along).norm());
    }
    return least;
}

// Leaves only the line nearest to the picked point.
void keep_nearest(const Mesh& mesh, const Vec3& picked, CutLines& found) {
    std::vector<ContourLine>& lines = found.lines;
    std::vector<double> distance;
    for (const ContourLine& line : lines) distance.push_back(distance_to(mesh, line, picked));
    const auto nearest = std::min_element(distance.begin(), distance.end()) - distance.begin();
    const auto nearby = std::count_if(distance.begin(), distance.end(),
                                      [&](double d) { return d <= kNearby * distance[nearest]; }) -
                        1;
    found.report.lines_left = count_of(lines) - 1;
    found.others = std::move(lines);
    lines = {std::move(found.others[nearest])};
    found.others.erase(found.others.begin() + nearest);
    if (nearby == 0) return;
    found.report.warnings.push_back(
        {CutConcern::lines_nearby,
         "the plane crosses the mesh in " + std::to_string(nearby) +
             " more lines that are nearly as near to the picked point; check that the right one "
             "was cut, or pick a point on it",
         {ElementKind::vertex, 1, {lines[0].crossings[0].positive}}});
}

LevelSet checked_levels(const Mesh& mesh, const CutPlane& plane, const CutOptions& options) {
    require_cuttable(mesh, options);
    require_plane(plane);
    return distances_from(mesh, plane);
}

CutLines lines_of(const Mesh& mesh, const CutPlane& plane, const LevelSet& levels,
                  const CutOptions& options, const Context& context) {
    CutLines found{trace_contours(mesh, levels, context), {}, {}};
    if (found.lines.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    "the plane does not cross the mesh; move its point into the mesh");
    }
    if (options.loops == CutLoops::nearest) {
        keep_nearest(mesh, plane.near.value_or(plane.point), found);
    }
    return found;
}

CutSides sides_by(const Mesh& mesh, const CutPlane& plane, const LevelSet& levels,
                  const std::vector<ContourLine>& lines) {
    CutSides sides{sides_of(mesh, lines)};
    sides.named = plane.seed.has_value();
    if (plane.seed) sides.kept = side_near(mesh, sides.side, *plane.seed);
    const auto side_of = [&](const std::vector<Index>& component) -> signed char {
        double sum = 0.0;
        for (const Index v : component) sum += levels.value[v];
        return sum >= 0.0 ? 1 : -1;
    };
    sides.whole_components = assign_whole_components(mesh, sides.side, side_of);
    return sides;
}

}  // namespace

Cut cut(const Mesh& mesh, const CutPlane& plane, const CutOptions& options,
        const Context& context) try {
    Progress progress(context, "cut");
    progress.step(0.4);
    const LevelSet levels = checked_levels(mesh, plane, options);
    CutLines found = lines_of(mesh, plane, levels, options, context);
    CutSides sides = sides_by(mesh, plane, levels, found.lines);
    progress.step(0.6);
    return cut_along(mesh, std::move(found), std::move(sides), options, context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

CutPreview preview_cut(const Mesh& mesh, const CutPlane& plane, const CutOptions& options,
                       const Context& context) try {
    const LevelSet levels = checked_levels(mesh, plane, options);
    const CutLines found = lines_of(mesh, plane, levels, options, context);
    return preview_along(mesh, found, [&] { return sides_by(mesh, plane, levels, found.lines); });
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
