#include "kernel/deform/patch/patch_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "kernel/core/roots.h"

namespace lissom {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Triangles around each vertex of a surface, as flat arrays.
struct Fans {
    std::vector<Index> begin, triangle;

    explicit Fans(const Patch& patch) : begin(at(patch.surface_count) + 1, 0) {
        const std::vector<Triangle>& triangles = patch.split_triangles.triangle;
        for (const Triangle& t : triangles) {
            for (const Index v : t) ++begin[v + 1];
        }
        for (Index v = 0; v < patch.surface_count; ++v) begin[v + 1] += begin[v];
        triangle.resize(3 * triangles.size());
        std::vector<Index> fill(begin.begin(), begin.end() - 1);
        for (std::size_t n = 0; n < triangles.size(); ++n) {
            for (const Index v : triangles[n]) triangle[fill[v]++] = index_of(n);
        }
    }
};

// Distance at c of a front that reached a after `at_a` and b after `at_b`. It comes to c after
// both: else a distance would jump if a rounding error swapped two vertices in the front.
double across(const Vec3& a, const Vec3& b, const Vec3& c, double at_a, double at_b) {
    const double along_edges = std::min(at_a + (c - a).norm(), at_b + (c - b).norm());
    const auto later = [&](double d) { return std::min(along_edges, std::max({d, at_a, at_b})); };
    const double length = (b - a).norm();
    if (!(length > 0.0) || at_b == kFar) return along_edges;
    const double x = (c - a).dot(b - a) / length;
    const double y = std::sqrt(std::max(0.0, (c - a).squaredNorm() - x * x));
    // Starts from a point below the edge, with the triangle unfolded above it.
    const double sx = (at_a * at_a - at_b * at_b + length * length) / (2.0 * length);
    const double sy_squared = at_a * at_a - sx * sx;
    if (sy_squared >= 0.0) {
        const double sy = std::sqrt(sy_squared);
        const double crossing = y + sy > 0.0 ? sx + (x - sx) * sy / (y + sy) : -1.0;
        if (crossing < 0.0 || crossing > length) return along_edges;
        return later(hypotenuse(x - sx, y + sy));
    }
    const double sine = (at_b - at_a) / length;
    if (std::abs(sine) >= 1.0) return along_edges;
    const double cosine = std::sqrt(1.0 - sine * sine);
    const double crossing = x - y * sine / cosine;
    if (crossing < 0.0 || crossing > length) return along_edges;
    return later(at_a + sine * x + cosine * y);
}

}  // namespace

std::vector<double> patch_distances(const Patch& patch,
                                    const std::vector<std::pair<Index, double>>& sources,
                                    double limit) {
    const Fans fans(patch);
    std::vector<double> distance(patch.surface_count, kFar);
    std::vector<char> done(distance.size(), 0);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer = [&](Index v, double d) {
        if (done[v] || !(d < distance[v]) || d > limit) return;
        distance[v] = d;
        queue.emplace(d, v);
    };
    for (const auto& [v, d] : sources) offer(v, d);
    while (!queue.empty()) {
        const Index v = queue.top().second;
        queue.pop();
        if (std::exchange(done[v], 1)) continue;
        for (Index e = fans.begin[v]; e < fans.begin[v + 1]; ++e) {
            const Triangle& t = patch.split_triangles.triangle[fans.triangle[e]];
            for (const Index c : t) {
                if (c == v) continue;
                const Index other = t[0] + t[1] + t[2] - v - c;
                const double at_other = done[other] ? distance[other] : kFar;
                offer(c, across(patch.rest[v], patch.rest[other], patch.rest[c], distance[v],
                                at_other));
            }
        }
    }
    return distance;
}

}  // namespace lissom
