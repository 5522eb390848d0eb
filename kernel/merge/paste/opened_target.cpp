#include "kernel/merge/paste/opened_target.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/error.h"
#include "kernel/mesh/cut/cut.h"

namespace lissom {
namespace {

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

// Distance to the loop, above 0 inside.
double signed_distance(std::span<const Vec2> loop, const Vec2& p) {
    double least = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
        const Vec2 along = b - a;
        const double square = along.squaredNorm();
        const double t = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, (p - a - t * along).norm());
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / along.y() * along.x()) inside = !inside;
    }
    return inside ? least : -least;
}

// Vertices of one sign in connected sets, the largest first.
std::vector<std::vector<Index>> sets_of_sign(const Topology& topology,
                                             const std::vector<double>& value, bool positive) {
    std::vector<std::vector<Index>> sets;
    std::vector<char> seen(value.size(), 0);
    for (Index start = 0; start < topology.vertex_count(); ++start) {
        std::vector<Index> set;
        const auto reach = [&](Index v) {
            if (seen[at(v)] || (value[at(v)] > 0.0) != positive) return;
            seen[at(v)] = 1;
            set.push_back(v);
        };
        reach(start);
        for (std::size_t i = 0; i < set.size(); ++i) {
            for (const Index n : topology.neighbors(set[i])) reach(n);
        }
        if (!set.empty()) sets.push_back(std::move(set));
    }
    std::stable_sort(sets.begin(), sets.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return sets;
}

// One connected hole without islands: specks that a coarse target cannot show change their sign.
void leave_one_hole(const Topology& topology, const PasteChart& chart, double step,
                    std::vector<double>& value) {
    const auto inside = sets_of_sign(topology, value, true);
    for (std::size_t k = 1; k < inside.size(); ++k) {
        for (const Index v : inside[k]) value[at(v)] = -step;
    }
    const auto outside = sets_of_sign(topology, value, false);
    for (std::size_t k = 1; k < outside.size(); ++k) {
        const bool in_chart = std::all_of(outside[k].begin(), outside[k].end(),
                                          [&](Index v) { return chart.place_of(v) != kNoIndex; });
        if (!in_chart) continue;
        for (const Index v : outside[k]) value[at(v)] = step;
    }
}

}  // namespace

bool crosses_itself(std::span<const Vec2> loop) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = loop[i], &b = loop[(i + 1) % n];
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j + 1 == n) continue;
            const Vec2 &c = loop[j], &d = loop[(j + 1) % n];
            const double at_c = cross(b - a, c - a), at_d = cross(b - a, d - a);
            const double at_a = cross(d - c, a - c), at_b = cross(d - c, b - c);
            if (at_c * at_d < 0.0 && at_a * at_b < 0.0) return true;
        }
    }
    return false;
}

OpenedTarget open_target(const Mesh& target, const PasteChart& chart, std::span<const Vec2> loop,
                         const Context& context) {
    if (crosses_itself(loop)) {
        throw Error(ErrorCode::boundary_conflict,
                    "the boundary of the paste crosses itself on the target; choose a smaller "
                    "scale, a smoother place, or another angle");
    }
    CutContour contour;
    contour.value.assign(at(target.vertex_count()), -1.0);
    double step = 0.0;
    bool any = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        step += (loop[(i + 1) % loop.size()] - loop[i]).norm() / static_cast<double>(loop.size());
    }
    for (std::size_t i = 0; i < chart.map.vertex.size(); ++i) {
        double& value = contour.value[at(chart.map.vertex[i])];
        value = signed_distance(loop, chart.map.uv[i]);
        any = any || value > 0.0;
    }
    if (!any) {
        throw Error(ErrorCode::boundary_conflict,
                    "the target has no vertex under the part; subdivide the target there, or make "
                    "the part larger");
    }
    leave_one_hole(target.topology(), chart, 1e-3 * step, contour.value);
    Cut parts = cut(target, contour, {CutLoops::all, 0.25}, context);
    if (parts.lines.size() != 1 || !parts.lines.front().rest.closed()) {
        throw Error(ErrorCode::boundary_conflict,
                    "the target is too coarse under the part to be opened along one line; "
                    "subdivide it there, or make the part larger");
    }
    return {std::move(parts.rest.mesh), std::move(parts.rest.map),
            parts.lines.front().rest.vertices()};
}

}  // namespace lissom
