#include "kernel/mesh/edit/polygon_splitter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lissom {
namespace {

// The best triangles of a polygon are found in time that grows as the cube of its corners.
constexpr std::size_t kMaxCorners = 320;

// Ways around a larger polygon that are tried.
constexpr std::size_t kTurns = 16;

// How far a search may reach, so that the stack holds it.
constexpr int kDeepest = 2000;

constexpr double kForbidden = std::numeric_limits<double>::infinity();

// A triangle that is flat or turned over is worse than any shape, a diagonal that another polygon
// has to give up worse still.
constexpr double kTurnedOver = 1e3, kTaken = 1e6;

Vec3 vector_area_of(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        sum += (points[i] - points[0]).cross(points[i + 1] - points[0]);
    }
    return sum;
}

// Perimeter squared over area, which is least for an equilateral triangle.
double triangle_cost(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    const double perimeter = (b - a).norm() + (c - b).norm() + (a - c).norm();
    const double area = (b - a).cross(c - a).dot(normal), square = perimeter * perimeter;
    return area > 1e-9 * square ? std::min(square / area, kTurnedOver) : kTurnedOver;
}

}  // namespace

PolygonSplitter::PolygonSplitter(const Topology& topology, std::span<const Vec3> positions,
                                 std::span<const Index> polygons)
    : topology_(topology), positions_(positions), polygons_(polygons) {
    for (std::size_t n = 0; n < polygons.size(); ++n) {
        splits_.emplace_back();
        triangulate_polygon(points_of(n), splits_.back());
    }
    const std::vector<std::size_t> conflicts = polygons_in_conflict();
    if (conflicts.empty()) return;
    for (std::size_t n = 0; n < polygons.size(); ++n) {
        if (std::binary_search(conflicts.begin(), conflicts.end(), n)) continue;
        for_each_diagonal(n, splits_[n], [&](Key diagonal) { owner_[diagonal] = n; });
    }
    for (const std::size_t n : conflicts) {
        visited_.clear();
        place(n, 0);
    }
}

PolygonSplitter::Key PolygonSplitter::key_of(std::size_t polygon, Index a, Index b) const {
    const std::span<const Index> face = topology_.face(polygons_[polygon]);
    const auto [low, high] = std::minmax(face[a], face[b]);
    return pair_key(low, high);
}

// Calls use(key) for the sides of triangles that are not sides of the polygon, once each.
template <typename Use>
void PolygonSplitter::for_each_diagonal(std::size_t polygon, const Split& split,
                                        const Use& use) const {
    const auto corners = count_of(topology_.face(polygons_[polygon]));
    for (const Triangle& t : split) {
        for (int s = 0; s < 3; ++s) {
            const Index from = t[s], to = t[(s + 1) % 3];
            const bool is_side = (from + 1) % corners == to;
            if (!is_side && from < to) use(key_of(polygon, from, to));
        }
    }
}

bool PolygonSplitter::is_edge(Key diagonal) const {
    const auto low = index_of(diagonal >> 32), high = index_of(diagonal & 0xffffffffU);
    const std::span<const Index> ring = topology_.neighbors(low);
    return std::find(ring.begin(), ring.end(), high) != ring.end();
}

std::vector<Vec3> PolygonSplitter::points_of(std::size_t polygon) const {
    std::vector<Vec3> points;
    for (const Index v : topology_.face(polygons_[polygon])) points.push_back(positions_[v]);
    return points;
}

// Polygons with a diagonal that others have, or that is an edge of the mesh, ascending.
std::vector<std::size_t> PolygonSplitter::polygons_in_conflict() const {
    std::vector<std::pair<Key, std::size_t>> all;
    std::vector<std::size_t> found;
    for (std::size_t n = 0; n < splits_.size(); ++n) {
        for_each_diagonal(n, splits_[n], [&](Key diagonal) {
            all.emplace_back(diagonal, n);
            if (is_edge(diagonal)) found.push_back(n);
        });
    }
    std::sort(all.begin(), all.end());
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].first != all[i - 1].first) continue;
        found.push_back(all[i - 1].second);
        found.push_back(all[i].second);
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

void PolygonSplitter::assign(std::size_t polygon, Split split) {
    for_each_diagonal(polygon, splits_[polygon], [&](Key diagonal) {
        const auto at = owner_.find(diagonal);
        if (at != owner_.end() && at->second == polygon) owner_.erase(at);
    });
    splits_[polygon] = std::move(split);
    for_each_diagonal(polygon, splits_[polygon], [&](Key diagonal) { owner_[diagonal] = polygon; });
}

// Gives the polygon unused diagonals; polygons using them find others first.
bool PolygonSplitter::place(std::size_t polygon, int depth) {
    if (depth > kDeepest) return false;
    while (true) {
        Split split = best_split(polygon);
        if (split.empty()) return false;
        std::vector<std::size_t> others;
        for_each_diagonal(polygon, split, [&](Key diagonal) {
            visited_.insert(diagonal);
            const auto at = owner_.find(diagonal);
            if (at != owner_.end() && at->second != polygon) others.push_back(at->second);
        });
        std::sort(others.begin(), others.end());
        others.erase(std::unique(others.begin(), others.end()), others.end());
        const bool is_free = std::all_of(others.begin(), others.end(), [&](std::size_t other) {
            return place(other, depth + 1);
        });
        if (!is_free) continue;
        assign(polygon, std::move(split));
        return true;
    }
}

double PolygonSplitter::diagonal_cost(std::size_t polygon, Index a, Index b) const {
    const Key diagonal = key_of(polygon, a, b);
    if (visited_.count(diagonal) > 0 || is_edge(diagonal)) return kForbidden;
    const auto at = owner_.find(diagonal);
    return at != owner_.end() && at->second != polygon ? kTaken : 0.0;
}

// The cheapest triangles without forbidden diagonals, by dynamic programming over chains of
// corners; none if there are none.
PolygonSplitter::Split PolygonSplitter::best_split(std::size_t polygon) const {
    const std::vector<Vec3> points = points_of(polygon);
    const std::size_t n = points.size();
    if (n > kMaxCorners) return turned_split(polygon);
    const Vec3 area = vector_area_of(points);
    const Vec3 normal = area.isZero(0.0) ? area : Vec3(area.normalized());
    // For the corners from i to j: the cost of closing them, and the third corner of the triangle
    // on the chord.
    std::vector<double> cost(n * n, 0.0);
    std::vector<std::size_t> apex(n * n, 0);
    for (std::size_t length = 2; length < n; ++length) {
        for (std::size_t i = 0; i + length < n; ++i) {
            const std::size_t j = i + length;
            const bool is_side = length == n - 1;
            const double chord = is_side ? 0.0 : diagonal_cost(polygon, index_of(i), index_of(j));
            double best = kForbidden;
            for (std::size_t k = i + 1; k < j && chord < kForbidden; ++k) {
                const double sum = cost[i * n + k] + cost[k * n + j] +
                                   triangle_cost(points[i], points[k], points[j], normal);
                if (sum >= best) continue;
                best = sum;
                apex[i * n + j] = k;
            }
            cost[i * n + j] = best + chord;
        }
    }
    Split split;
    if (!(cost[n - 1] < kForbidden)) return split;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
    while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        if (j - i < 2) continue;
        const std::size_t k = apex[i * n + j];
        split.push_back({index_of(i), index_of(k), index_of(j)});
        open.emplace_back(i, k);
        open.emplace_back(k, j);
    }
    return split;
}

// For large polygons: the first of several ways around that needs no forbidden diagonal.
PolygonSplitter::Split PolygonSplitter::turned_split(std::size_t polygon) const {
    const std::vector<Vec3> points = points_of(polygon);
    const std::size_t n = points.size();
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
        const std::size_t start = turn * n / kTurns;
        std::vector<Vec3> turned(points);
        std::rotate(turned.begin(), turned.begin() + start, turned.end());
        Split split;
        triangulate_polygon(turned, split);
        for (Triangle& t : split) {
            for (Index& corner : t) {
                corner = index_of((corner + start) % n);
            }
        }
        bool allowed = true;
        for_each_diagonal(polygon, split, [&](Key diagonal) {
            allowed = allowed && visited_.count(diagonal) == 0 && !is_edge(diagonal);
        });
        if (allowed) return split;
    }
    return {};
}

}  // namespace lissom
