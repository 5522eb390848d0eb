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

// Another line is nearby where it is less than this many times as far from the picked point.
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
    value.reserve(static_cast<std::size_t>(mesh.vertex_count()));
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
void keep_nearest(const Mesh& mesh, const Vec3& picked, std::vector<ContourLine>& lines,
                  CutReport& report) {
    std::vector<double> distance;
    for (const ContourLine& line : lines) distance.push_back(distance_to(mesh, line, picked));
    const auto nearest = std::min_element(distance.begin(), distance.end()) - distance.begin();
    const auto nearby = std::count_if(distance.begin(), distance.end(),
                                      [&](double d) { return d <= kNearby * distance[nearest]; }) -
                        1;
    report.lines_left = static_cast<Index>(lines.size()) - 1;
    lines = {std::move(lines[nearest])};
    if (nearby == 0) return;
    report.warnings.push_back(
        {CutConcern::lines_nearby,
         "the plane crosses the mesh in " + std::to_string(nearby) +
             " more lines that are nearly as near to the picked point; check that the right one "
             "was cut, or pick a point on it",
         {ElementKind::vertex, 1, {lines[0].crossings[0].positive}}});
}

}  // namespace

Cut cut(const Mesh& mesh, const CutPlane& plane, const CutOptions& options,
        const Context& context) try {
    require_cuttable(mesh, options);
    require_plane(plane);
    Progress progress(context, "cut");
    progress.step(0.4);
    const LevelSet levels = distances_from(mesh, plane);
    std::vector<ContourLine> lines = trace_contours(mesh, levels, context);
    if (lines.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    "the plane does not cross the mesh; move its point into the mesh");
    }
    CutReport report;
    if (options.loops == CutLoops::nearest) {
        keep_nearest(mesh, plane.near.value_or(plane.point), lines, report);
    }
    std::vector<signed char> side = sides_of(mesh, lines);
    const signed char kept = plane.seed ? side_near(mesh, side, *plane.seed) : 1;
    const auto side_of = [&](const std::vector<Index>& component) -> signed char {
        double sum = 0.0;
        for (const Index v : component) sum += levels.value[v];
        return sum >= 0.0 ? 1 : -1;
    };
    report.whole_components = assign_whole_components(mesh, side, side_of);
    progress.step(0.6);
    return cut_along(mesh, std::move(lines), std::move(side), kept, options, std::move(report),
                     context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
