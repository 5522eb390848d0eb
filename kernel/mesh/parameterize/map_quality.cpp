#include "kernel/mesh/parameterize/map_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lissom {
namespace {

using Edge2 = std::pair<Index, Index>;

bool edges_cross(const Edge2& e, const Edge2& f, std::span<const Vec2> uv) {
    const auto [a, b] = e;
    const auto [c, d] = f;
    if (a == c || a == d || b == c || b == d) return false;
    const auto apart = [&](Index p, Index q, Index r, Index s) {
        const double left = doubled_area(uv[p], uv[q], uv[r]);
        const double right = doubled_area(uv[p], uv[q], uv[s]);
        return (left > 0.0) == (right > 0.0) || left == 0.0 || right == 0.0;
    };
    return !apart(a, b, c, d) && !apart(c, d, a, b);
}

// Edges of the loops in the order in which they begin along an axis.
std::vector<Edge2> edges_along(std::span<const std::vector<Index>> loops, std::span<const Vec2> uv,
                               int axis) {
    std::vector<Edge2> edges;
    for (const std::vector<Index>& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            edges.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
        }
    }
    const auto begin = [&](const Edge2& e) {
        return std::min(uv[e.first][axis], uv[e.second][axis]);
    };
    std::sort(edges.begin(), edges.end(), [&](const Edge2& e, const Edge2& f) {
        return std::pair(begin(e), e) < std::pair(begin(f), f);
    });
    return edges;
}

int longer_axis(std::span<const std::vector<Index>> loops, std::span<const Vec2> uv) {
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const std::vector<Index>& loop : loops) {
        for (const Index v : loop) {
            low = low.cwiseMin(uv[v]);
            high = high.cwiseMax(uv[v]);
        }
    }
    return high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
}

}  // namespace

std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Vec2> uv) {
    std::vector<Index> flipped;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = triangles[t];
        if (!(doubled_area(uv[a], uv[b], uv[c]) > 0.0)) flipped.push_back(index_of(t));
    }
    return flipped;
}

Index crossing_edges(std::span<const std::vector<Index>> loops, std::span<const Vec2> uv) {
    const int axis = longer_axis(loops, uv);
    const std::vector<Edge2> edges = edges_along(loops, uv, axis);
    Index count = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const double end = std::max(uv[edges[i].first][axis], uv[edges[i].second][axis]);
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            if (std::min(uv[edges[j].first][axis], uv[edges[j].second][axis]) > end) break;
            count += edges_cross(edges[i], edges[j], uv);
        }
    }
    return count;
}

ScaleRange scale_range(const Chart& chart, const std::vector<TriangleShape>& shapes,
                       std::span<const Vec2> uv) {
    ScaleRange range{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t t = 0; t < chart.face.size(); ++t) {
        if (shapes[t].degenerate) continue;
        const auto [a, b, c] = chart.triangles[t];
        const MapDerivative map = map_derivative(shapes[t], uv[a], uv[b], uv[c]);
        range = {std::min(range.least, map.least()), std::max(range.greatest, map.greatest())};
    }
    return range.greatest > 0.0 ? range : ScaleRange{};
}

void scale_to_area(const Chart& chart, const std::vector<TriangleShape>& shapes,
                   std::vector<Vec2>& uv) {
    double wanted = 0.0, found = 0.0;
    for (std::size_t t = 0; t < chart.face.size(); ++t) {
        const auto [a, b, c] = chart.triangles[t];
        wanted += shapes[t].area;
        found += std::abs(0.5 * doubled_area(uv[a], uv[b], uv[c]));
    }
    const double scale = std::sqrt(wanted / found);
    for (Vec2& p : uv) p *= scale;
}

void place_by_outline(const Chart& chart, std::vector<Vec2>& uv) {
    const std::vector<Index>& loop = chart.open_loops.front();
    const double total = loop_length(chart, loop);
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size()];
        const double length = (chart.positions[b] - chart.positions[a]).norm();
        mean += 0.5 * length / total * (uv[a] + uv[b]);
    }
    double farthest = 0.0;
    for (Vec2& p : uv) p -= mean;
    for (const Index v : loop) farthest = std::max(farthest, uv[v].norm());
    const auto first = std::find_if(loop.begin(), loop.end(),
                                    [&](Index v) { return uv[v].norm() >= 1e-3 * farthest; });
    if (first == loop.end() || !(farthest > 0.0)) return;
    const Vec2 axis = uv[*first].normalized();
    for (Vec2& p : uv) p = {axis.dot(p), axis.x() * p.y() - axis.y() * p.x()};
}

}  // namespace lissom
