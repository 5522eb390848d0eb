#include "kernel/mesh/cut/cut_concerns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

// A line that encloses less than this part of its convex outline is called folded.
constexpr double kFolded = 0.72;

// Who keeps more than this fraction of the area by a plane may have meant the other part.
constexpr double kMost = 0.8;

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
            return index_of(i);
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
         "move it away from the boundary, or fill that first, if a loop is needed",
         std::move(ends)});
}

double triangle_area(const Mesh& mesh, const Triangle& t) {
    const Vec3& a = mesh.position(t[0]);
    return 0.5 * (mesh.position(t[1]) - a).cross(mesh.position(t[2]) - a).norm();
}

// Fraction of a triangle's area on the positive side, which a line enters and leaves by two edges.
double positive_fraction(const Crossing& enter, const Crossing& leave) {
    if (enter.positive == leave.positive) return enter.t * leave.t;
    return 1.0 - (1.0 - enter.t) * (1.0 - leave.t);
}

std::vector<Index> crossed_faces(const std::vector<ContourLine>& lines) {
    std::set<Index> faces;
    for (const ContourLine& line : lines) faces.insert(line.faces.begin(), line.faces.end());
    return {faces.begin(), faces.end()};
}

// Area on the positive side of the lines.
double positive_area(const Mesh& mesh, const std::vector<ContourLine>& lines,
                     const std::vector<signed char>& side) {
    double sum = 0.0;
    const std::vector<double> areas = face_areas(mesh);
    const std::vector<Index> crossed = crossed_faces(lines);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const bool whole = !std::binary_search(crossed.begin(), crossed.end(), f);
        if (whole && side[mesh.topology().face(f)[0]] > 0) sum += areas[f];
    }
    const auto positive = [&](Index v) { return side[v] > 0; };
    const Triangulation parts = triangulate_faces(mesh.topology(), mesh.positions(), crossed);
    for (const Triangle& t : parts.triangles) {
        if (std::all_of(t.begin(), t.end(), positive)) sum += triangle_area(mesh, t);
    }
    for (const ContourLine& line : lines) {
        const std::size_t n = line.crossings.size();
        for (std::size_t i = 0; i < line.triangles.size(); ++i) {
            sum += positive_fraction(line.crossings[i], line.crossings[(i + 1) % n]) *
                   triangle_area(mesh, line.triangles[i]);
        }
    }
    return sum;
}

// Number of pieces on one side of the lines that touch a line.
std::size_t cut_pieces(const Mesh& mesh, const std::vector<ContourLine>& lines,
                       const std::vector<signed char>& side, signed char counted) {
    std::vector<char> seen(side.size(), 0);
    std::vector<Index> queue;
    std::size_t pieces = 0;
    const auto reach = [&](Index v) {
        if (seen[v] || side[v] != counted) return false;
        seen[v] = 1;
        queue.push_back(v);
        return true;
    };
    for (const ContourLine& line : lines) {
        for (const Crossing& c : line.crossings) {
            if (!reach(counted > 0 ? c.positive : c.negative)) continue;
            ++pieces;
            while (!queue.empty()) {
                const Index v = queue.back();
                queue.pop_back();
                for (const Index n : mesh.topology().neighbors(v)) reach(n);
            }
        }
    }
    return pieces;
}

}  // namespace

void add_kept_fraction(const Mesh& mesh, const std::vector<ContourLine>& lines,
                       const CutSides& sides, CutReport& report) {
    const double all = area(mesh), positive = positive_area(mesh, lines, sides.side);
    if (!(all > 0.0)) return;
    report.kept_fraction = (sides.kept > 0 ? positive : all - positive) / all;
    if (sides.named || report.kept_fraction <= kMost) return;
    const auto percent = static_cast<int>(std::floor(100.0 * report.kept_fraction));
    report.warnings.push_back({CutConcern::keeps_most,
                               "the cut keeps " + std::to_string(percent) +
                                   " % of the mesh's area; to keep the small part, turn the normal "
                                   "or path around, or give a seed on it; a seed on the large one "
                                   "says that it is meant",
                               {}});
}

void add_outlines(const Mesh& mesh, const std::vector<ContourLine>& lines, const CutSides& sides,
                  CutReport& report) {
    if (!sides.outlined || lines.size() < 2) return;
    const auto count = [](std::size_t n) {
        return std::to_string(n) + (n == 1 ? " piece" : " pieces");
    };
    Elements starts{ElementKind::vertex, 0, {}};
    for (const ContourLine& line : lines) starts.add(line.crossings.front().positive);
    report.warnings.push_back(
        {CutConcern::several_outlines,
         "the region has " + std::to_string(lines.size()) +
             " outlines and was cut along all: " + count(cut_pieces(mesh, lines, sides.side, 1)) +
             " kept, " + count(cut_pieces(mesh, lines, sides.side, -1)) +
             " left; for one loop take one part of the region (region:connected), fill its holes "
             "(region:invert, connected, invert) or smooth it",
         std::move(starts)});
}

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
