/// The cheapest loop around a point of the plane by brute force, for comparison.
#pragma once

#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom::test {

/// How often a straight way crosses the ray to the right of `middle`, counter-clockwise.
inline int crossing(const Vec2& from, const Vec2& to, const Vec2& middle) {
    const Vec2 p = from - middle, q = to - middle;
    if ((p.y() <= 0.0) == (q.y() <= 0.0)) return 0;
    if (p.x() + p.y() / (p.y() - q.y()) * (q.x() - p.x()) <= 0.0) return 0;
    return q.y() > p.y() ? 1 : -1;
}

inline int winding_of(std::span<const Vec2> plane, const Vec2& middle,
                      std::span<const Index> loop) {
    int sum = 0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        sum += crossing(plane[at(loop[k])], plane[at(loop[(k + 1) % loop.size()])], middle);
    }
    return sum;
}

/// Dijkstra's method on nine sheets from every end of an edge that crosses the ray.
inline double cheapest_by_force(std::span<const std::pair<Index, Index>> edges,
                                std::span<const Vec2> plane, const Vec2& middle,
                                std::span<const double> cost) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    constexpr int kSheets = 9, kFirst = 4;
    struct Way {
        Index to;
        int turns;
        double cost;
    };
    std::vector<std::vector<Way>> ways(plane.size());
    std::vector<char> starts(plane.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto& [a, b] = edges[e];
        const int turns = crossing(plane[at(a)], plane[at(b)], middle);
        if (!(cost[e] < kFar)) continue;
        ways[at(a)].push_back({b, turns, cost[e]});
        ways[at(b)].push_back({a, -turns, cost[e]});
        if (turns != 0) starts[at(turns > 0 ? a : b)] = 1;
    }
    double least = kFar;
    for (Index start = 0; start < count_of(plane); ++start) {
        if (!starts[at(start)]) continue;
        std::vector<double> distance(plane.size() * kSheets, kFar);
        using Reached = std::pair<double, Index>;
        std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
        const auto reach = [&](Index v, int sheet, double d) {
            if (sheet < 0 || sheet >= kSheets) return;
            double& known = distance[at(v * kSheets + sheet)];
            if (d >= known) return;
            known = d;
            queue.push({d, v * kSheets + sheet});
        };
        reach(start, kFirst, 0.0);
        while (!queue.empty()) {
            const auto [d, node] = queue.top();
            queue.pop();
            if (d > distance[at(node)] || d >= least) continue;
            for (const Way& way : ways[at(node / kSheets)]) {
                reach(way.to, node % kSheets + way.turns, d + way.cost);
            }
        }
        least = std::min(least, distance[at(start * kSheets + kFirst + 1)]);
    }
    return least;
}

}  // namespace lissom::test
