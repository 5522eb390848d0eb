#include "kernel/hair/field/winding_rows.h"

#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

struct Crossing {
    double x = 0.0;
    Index winding = 0;
};

// Triangles by the planes of constant z that they may meet: those of plane k are
// list[begin[k]] .. list[begin[k + 1] - 1].
struct Planes {
    std::vector<std::size_t> begin;
    std::vector<Index> list;
};

// First and last grid plane within [low, high], clamped to the grid; none if first > last.
std::pair<Index, Index> plane_range(double low, double high, double origin, double step,
                                    Index count) {
    const double first = std::floor((low - origin) / step);
    const double last = std::ceil((high - origin) / step);
    return {static_cast<Index>(std::clamp(first, 0.0, static_cast<double>(count))),
            static_cast<Index>(std::clamp(last, -1.0, count - 1.0))};
}

Planes sort_into_planes(const ClosedSurface& surface, const GridLayout& grid) {
    const std::size_t count = grid.counts[2];
    std::vector<std::pair<Index, Index>> ranges;
    Planes planes;
    planes.begin.assign(count + 1, 0);
    for (const Triangle& t : surface.triangles) {
        const double a = surface.positions[t[0]].z(), b = surface.positions[t[1]].z(),
                     c = surface.positions[t[2]].z();
        ranges.push_back(plane_range(std::min({a, b, c}), std::max({a, b, c}), grid.origin.z(),
                                     grid.step, grid.counts[2]));
        for (Index k = ranges.back().first; k <= ranges.back().second; ++k) ++planes.begin[k + 1];
    }
    for (std::size_t k = 0; k < count; ++k) planes.begin[k + 1] += planes.begin[k];
    planes.list.resize(planes.begin.back());
    std::vector<std::size_t> end = planes.begin;
    for (std::size_t t = 0; t < ranges.size(); ++t) {
        for (Index k = ranges[t].first; k <= ranges[t].second; ++k) {
            planes.list[end[k]++] = index_of(t);
        }
    }
    return planes;
}

// Whether the edge crosses the half line from (y, z) towards +y: 1 upward in z, -1 downward. The
// lower end decides the order of the arithmetic, so that both directions see the same.
int edge_crossing(const Vec3& a, const Vec3& b, double y, double z) {
    if ((a.z() > z) == (b.z() > z)) return 0;
    const bool upward = b.z() > z;
    const Vec3 &low = upward ? a : b, &high = upward ? b : a;
    const double side = (high.y() - low.y()) * (z - low.z()) - (y - low.y()) * (high.z() - low.z());
    if (!(side > 0.0)) return 0;
    return upward ? 1 : -1;
}

// Returns the crossing of the triangle's plane and the line along x through (y, z).
double crossing_x(const Vec3& a, const Vec3& b, const Vec3& c, double y, double z) {
    const double area = (b.y() - a.y()) * (c.z() - a.z()) - (c.y() - a.y()) * (b.z() - a.z());
    const double v = ((y - a.y()) * (c.z() - a.z()) - (c.y() - a.y()) * (z - a.z())) / area;
    const double w = ((b.y() - a.y()) * (z - a.z()) - (y - a.y()) * (b.z() - a.z())) / area;
    const double x = a.x() + v * (b.x() - a.x()) + w * (c.x() - a.x());
    const auto [low, high] = std::minmax({a.x(), b.x(), c.x()});
    return std::isfinite(x) ? std::clamp(x, low, high) : 0.5 * (low + high);
}

// The crossings of all rows of plane k.
std::vector<std::vector<Crossing>> crossings_of_plane(const ClosedSurface& surface,
                                                      const GridLayout& grid, const Planes& planes,
                                                      Index k) {
    std::vector<std::vector<Crossing>> rows(grid.counts[1]);
    const double z = grid.origin.z() + grid.step * k;
    for (std::size_t i = planes.begin[k]; i < planes.begin[k + 1]; ++i) {
        const Triangle& t = surface.triangles[planes.list[i]];
        const Vec3 &a = surface.positions[t[0]], &b = surface.positions[t[1]],
                   &c = surface.positions[t[2]];
        const auto [first, last] =
            plane_range(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}),
                        grid.origin.y(), grid.step, grid.counts[1]);
        for (Index j = first; j <= last; ++j) {
            const double y = grid.origin.y() + grid.step * j;
            const int winding =
                edge_crossing(a, b, y, z) + edge_crossing(b, c, y, z) + edge_crossing(c, a, y, z);
            if (winding != 0) rows[j].push_back({crossing_x(a, b, c, y, z), winding});
        }
    }
    return rows;
}

}  // namespace

std::vector<std::uint8_t> inside_flags(const ClosedSurface& surface, const GridLayout& grid,
                                       const Context& context) {
    const Planes planes = sort_into_planes(surface, grid);
    std::vector<std::uint8_t> inside(grid.size(), 0);
    // A row that enters an outward triangle (its normal against +x) sees it clockwise.
    const Index direction = surface.volume < 0.0 ? 1 : -1;
    context.parallel_for(0, grid.counts[2], 1, [&](Index from, Index to) {
        for (Index k = from; k < to; ++k) {
            auto rows = crossings_of_plane(surface, grid, planes, k);
            for (Index j = 0; j < grid.counts[1]; ++j) {
                auto& row = rows[j];
                std::sort(row.begin(), row.end(),
                          [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
                Index winding = 0;
                auto next = row.begin();
                for (Index i = 0; i < grid.counts[0] && !row.empty(); ++i) {
                    const double x = grid.origin.x() + grid.step * i;
                    for (; next != row.end() && next->x < x; ++next) winding += next->winding;
                    inside[grid.index(i, j, k)] = winding * direction > 0;
                }
            }
        }
    });
    return inside;
}

}  // namespace lissom
