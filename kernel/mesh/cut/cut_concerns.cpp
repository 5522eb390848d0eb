#include "kernel/mesh/cut/cut_concerns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

namespace lissom {
namespace {

// A line that encloses less than this part of its convex outline is called folded.
constexpr double kFolded = 0.72;

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

double polygon_area(const std::vector<Vec2>& p) {
    double twice = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
    return 0.5 * std::abs(twice);
}

// Andrew's monotone chain.
std::vector<Vec2> convex_hull(std::vector<Vec2> p) {
    std::sort(p.begin(), p.end(), [](const Vec2& a, const Vec2& b) {
        return std::tie(a.x(), a.y()) < std::tie(b.x(), b.y());
    });
    std::vector<Vec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Vec2& point : p) {
            while (hull.size() >= start + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(p.begin(), p.end());
    }
    return hull;
}

// The points in a frame of the plane at right angles to their vector area; none without area.
std::vector<Vec2> flattened(const std::vector<Vec3>& points) {
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        normal += (points[i] - points[0]).cross(points[i + 1] - points[0]);
    }
    std::vector<Vec2> flat;
    if (!(normal.norm() > 0.0)) return flat;
    const Vec3 x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
    for (const Vec3& p : points) {
        flat.emplace_back((p - points[0]).dot(x), (p - points[0]).dot(y));
    }
    return flat;
}

Elements vertices_of(const ContourLine& line) {
    std::set<Index> vertices;
    for (const Crossing& c : line.crossings) vertices.insert(c.positive);
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : vertices) elements.add(v);
    return elements;
}

// Number of the open boundary that `v` lies on.
Index boundary_of(const Topology& topology, Index v) {
    const auto& loops = topology.boundary_loops();
    for (std::size_t i = 0; i < loops.size(); ++i) {
        if (std::find(loops[i].begin(), loops[i].end(), v) != loops[i].end()) {
            return static_cast<Index>(i);
        }
    }
    return kNoIndex;
}

void add_touched_boundaries(const Mesh& mesh, const std::vector<ContourLine>& lines,
                            CutReport& report) {
    Elements ends{ElementKind::vertex, 0, {}};
    std::set<Index> touched;
    for (const ContourLine& line : lines) {
        if (line.closed) continue;
        for (const Crossing& c : {line.crossings.front(), line.crossings.back()}) {
            ends.add(c.positive);
            touched.insert(boundary_of(mesh.topology(), c.positive));
        }
    }
    if (touched.empty()) return;
    report.touched_boundaries.assign(touched.begin(), touched.end());
    report.warnings.push_back(
        {CutConcern::touches_boundary,
         "the cut ends at an open boundary of the mesh, so that its line is not a closed loop; "
         "move it away from the boundary, or fill that first, where a loop is needed",
         std::move(ends)});
}

}  // namespace

double fullness(const std::vector<Vec3>& points) {
    const std::vector<Vec2> flat = flattened(points);
    if (flat.empty()) return 0.0;
    const double outline = polygon_area(convex_hull(flat));
    return outline > 0.0 ? polygon_area(flat) / outline : 0.0;
}

void add_concerns(const Mesh& mesh, const std::vector<ContourLine>& lines, CutReport& report) {
    add_touched_boundaries(mesh, lines, report);
    for (const ContourLine& line : lines) {
        if (!line.closed || fullness(line.points(mesh)) >= kFolded) continue;
        report.warnings.push_back(
            {CutConcern::folded_line,
             "the cut is much more folded than its convex outline: it seems to run over a fin or "
             "a limb; move or turn it so that it runs around one part only",
             vertices_of(line)});
    }
}

}  // namespace lissom
