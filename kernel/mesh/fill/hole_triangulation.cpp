#include "kernel/mesh/fill/hole_triangulation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/mesh/edges.h"
#include "kernel/mesh/fill/minimum_area.h"

namespace lissom {
namespace {

constexpr Index kMaximumLoop = 300;
// Ends of chords that are tried when a loop is divided.
constexpr Index kMaximumChordEnds = 2000;
// Angles that differ by less are equal: an arc cosine near 0 has no more digits.
constexpr double kAngleTolerance = 1e-6;
// Areas that differ by a smaller fraction are equal, so that the first of symmetric solutions is
// taken in every frame.
constexpr double kAreaTolerance = 1e-9;

// A polygon in the direction of the triangles that will close it. Edge i runs from vertex i to the
// next; `normals[i]` is that of the face behind it, zero if it is not known.
struct Polygon {
    std::vector<Index> vertices;
    std::vector<Vec3> normals;

    Index size() const { return count_of(vertices); }
};

struct Weight {
    double angle = std::numeric_limits<double>::infinity();
    double area = std::numeric_limits<double>::infinity();

    bool operator<(const Weight& other) const {
        if (std::abs(angle - other.angle) > kAngleTolerance) return angle < other.angle;
        return area < other.area * (1.0 - kAreaTolerance);
    }
    bool possible() const { return std::isfinite(area); }
};

// Returns the dihedral angle at an edge; pi if a triangle has no area.
double turn(const Vec3& a, const Vec3& b) {
    const double lengths = a.norm() * b.norm();
    return lengths > 0.0 ? std::acos(std::clamp(a.dot(b) / lengths, -1.0, 1.0)) : kPi;
}

// The dynamic programme over sub-polygons i .. k, each closed by the chord from k to i.
class MinimumWeight {
  public:
    MinimumWeight(const HolePatch& patch, const Polygon& polygon, const Context& context)
        : patch_(patch), polygon_(polygon), n_(polygon.size()), cells_(at(n_) * n_) {
        for (Index i = 0; i + 1 < n_; ++i) {
            cell(i, i + 1).weight = {0.0, 0.0};
            cell(i, i + 1).normal = polygon.normals[i];
        }
        for (Index length = 2; length < n_; ++length) {
            context.checkpoint();
            for (Index i = 0; i + length < n_; ++i) close(i, i + length);
        }
    }

    bool possible() const { return cell(0, n_ - 1).weight.possible(); }

    std::vector<Triangle> triangles() const {
        std::vector<Triangle> result;
        std::vector<std::pair<Index, Index>> open{{0, n_ - 1}};
        while (!open.empty()) {
            const auto [i, k] = open.back();
            open.pop_back();
            if (k - i < 2) continue;
            const Index m = cell(i, k).middle;
            result.push_back({polygon_.vertices[i], polygon_.vertices[m], polygon_.vertices[k]});
            open.emplace_back(i, m);
            open.emplace_back(m, k);
        }
        return result;
    }

  private:
    struct Cell {
        Weight weight;
        Vec3 normal = Vec3::Zero();
        Index middle = kNoIndex;
    };

    Cell& cell(Index i, Index k) { return cells_[at(i) * n_ + k]; }
    const Cell& cell(Index i, Index k) const { return cells_[at(i) * n_ + k]; }
    const Vec3& point(Index i) const { return patch_.position(polygon_.vertices[i]); }

    // Finds the best triangle (i, m, k) on the chord from k to i.
    void close(Index i, Index k) {
        const bool whole = i == 0 && k == n_ - 1;
        if (!whole && patch_.has_edge(polygon_.vertices[i], polygon_.vertices[k])) return;
        Cell& best = cell(i, k);
        for (Index m = i + 1; m < k; ++m) {
            const Cell &left = cell(i, m), &right = cell(m, k);
            if (!left.weight.possible() || !right.weight.possible()) continue;
            const Vec3 normal = (point(m) - point(i)).cross(point(k) - point(i));
            Weight weight;
            weight.area = left.weight.area + right.weight.area + 0.5 * normal.norm();
            weight.angle =
                std::max({left.weight.angle, right.weight.angle, turn_over(normal, left.normal),
                          turn_over(normal, right.normal)});
            if (whole)
                weight.angle = std::max(weight.angle, turn_over(normal, polygon_.normals[k]));
            if (weight < best.weight) best = {weight, normal, m};
        }
    }

    // An edge of the outline whose face is not known does not count.
    static double turn_over(const Vec3& normal, const Vec3& behind) {
        return behind.isZero(0.0) && !normal.isZero(0.0) ? 0.0 : turn(normal, behind);
    }

    const HolePatch& patch_;
    const Polygon& polygon_;
    Index n_;
    std::vector<Cell> cells_;
};

// Ends of the chord that is shortest for the part of the outline it cuts off, at least a quarter of
// it on each side; none if all such chords are edges already.
std::pair<Index, Index> best_chord(const HolePatch& patch, const Polygon& polygon) {
    const Index n = polygon.size(), step = std::max<Index>(1, n / kMaximumChordEnds);
    std::pair<Index, Index> best{kNoIndex, kNoIndex};
    double shortest = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < n; i += step) {
        for (Index j = i + n / 4; j < n && j - i <= n - n / 4; j += step) {
            const Index a = polygon.vertices[i], b = polygon.vertices[j];
            const double length = (patch.position(a) - patch.position(b)).norm();
            if (length >= shortest || patch.has_edge(a, b)) continue;
            shortest = length;
            best = {i, j};
        }
    }
    return best;
}

Polygon part(const Polygon& polygon, Index from, Index to, const Vec3& closing_normal) {
    const Index n = polygon.size();
    Polygon result;
    for (Index i = from; i != to; i = (i + 1) % n) {
        result.vertices.push_back(polygon.vertices[i]);
        result.normals.push_back(polygon.normals[i]);
    }
    result.vertices.push_back(polygon.vertices[to]);
    result.normals.push_back(closing_normal);
    return result;
}

void close_by_fan(HolePatch& patch, const Polygon& polygon) {
    const Index middle = patch.add_middle_vertex(polygon.vertices);
    for (Index i = 0; i < polygon.size(); ++i) {
        patch.add_triangle(polygon.vertices[i], polygon.vertices[(i + 1) % polygon.size()], middle);
    }
}

// Closes a polygon and returns the normal of the triangle at its last edge, and the number of
// parts.
std::pair<Vec3, Index> close(HolePatch& patch, const Polygon& polygon, const Context& context) {
    context.checkpoint();
    const Index n = polygon.size();
    if (n > kMaximumLoop) {
        const auto [i, j] = best_chord(patch, polygon);
        if (i != kNoIndex) {
            // The part without the last edge goes first, so that the other knows the face at the
            // chord.
            const auto [normal, parts] = close(patch, part(polygon, i, j, Vec3::Zero()), context);
            Polygon rest = part(polygon, j, i, normal);
            // The last edge of the polygon stays the last one.
            const std::ptrdiff_t last = n - j;
            std::rotate(rest.vertices.begin(), rest.vertices.begin() + last, rest.vertices.end());
            std::rotate(rest.normals.begin(), rest.normals.begin() + last, rest.normals.end());
            const auto [last_normal, rest_parts] = close(patch, rest, context);
            return {last_normal, parts + rest_parts};
        }
    }
    const Index first = count_of(patch.triangles());
    if (n <= kMaximumLoop) {
        const MinimumWeight solution(patch, polygon, context);
        if (solution.possible()) {
            for (const auto& [a, b, c] : solution.triangles()) patch.add_triangle(a, b, c);
            return {patch.normal(first), 1};
        }
    }
    close_by_fan(patch, polygon);
    return {patch.normal(count_of(patch.triangles()) - 1), 1};
}

// Vector area of a face.
Vec3 area_of(const Mesh& mesh, Index f) {
    const std::span<const Index> face = mesh.topology().face(f);
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        area += (mesh.position(face[i]) - mesh.position(face[0]))
                    .cross(mesh.position(face[i + 1]) - mesh.position(face[0]));
    }
    return area;
}

}  // namespace

Index triangulate_hole(HolePatch& patch, std::span<const Index> loop, const Context& context) {
    Polygon polygon{{loop.begin(), loop.end()}, {}};
    // A polygon of many corners may lie behind many edges that follow one another.
    Index last = kNoIndex;
    Vec3 area = Vec3::Zero();
    for (Index i = 0; i < polygon.size(); ++i) {
        const Index behind =
            face_left_of(patch.mesh().topology(), polygon.vertices[(i + 1) % polygon.size()],
                         polygon.vertices[i]);
        if (behind == kNoIndex) area = Vec3::Zero();
        if (behind != kNoIndex && behind != last) area = area_of(patch.mesh(), behind);
        last = behind;
        polygon.normals.push_back(area);
    }
    return close(patch, polygon, context).second;
}

void triangulate_hole_by_area(HolePatch& patch, std::span<const Index> loop,
                              const Context& context) {
    std::vector<Vec3> points;
    for (const Index v : loop) points.push_back(patch.position(v));
    const auto taken = [&](Index i, Index k) { return patch.has_edge(loop[at(i)], loop[at(k)]); };
    const std::vector<Triangle> triangles = minimum_area_triangles(points, taken, context);
    for (const auto& [a, b, c] : triangles) {
        patch.add_triangle(loop[at(a)], loop[at(b)], loop[at(c)]);
    }
    if (triangles.empty()) close_by_fan(patch, {{loop.begin(), loop.end()}, {}});
}

}  // namespace lissom
