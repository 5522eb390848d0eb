#include "kernel/mesh/fill/hole_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace lissom {
namespace {

// A triangle is large if its corners are farther from its center than this many spacings: one over
// Liepa's density factor, the square root of 2, with room for rounding.
constexpr double kFarthest = 0.70710678 * (1.0 + 1e-6);
// A new vertex remembers this many sources at most.
constexpr std::size_t kMaximumSources = 16;
constexpr std::size_t kFlipsPerEdge = 20;

double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - apex, v = b - apex;
    return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
}

}  // namespace

void HolePatch::set_triangle(Index triangle, const Triangle& vertices) {
    triangles_[triangle] = vertices;
    for (int k = 0; k < 3; ++k) left_[key(vertices[k], vertices[(k + 1) % 3])] = triangle;
}

void HolePatch::add_triangle(Index a, Index b, Index c) {
    triangles_.emplace_back();
    set_triangle(count_of(triangles_) - 1, {a, b, c});
}

Index HolePatch::add_middle_vertex(std::span<const Index> around) {
    Vec3 middle = Vec3::Zero();
    std::map<Index, double> weights;
    const double share = 1.0 / around.size();
    for (const Index v : around) {
        middle += share * position(v);
        if (v < mesh_.vertex_count()) {
            weights[v] += share;
        } else {
            for (const auto& [source, weight] : sources_[v - mesh_.vertex_count()]) {
                weights[source] += share * weight;
            }
        }
    }
    std::vector<ElementMap::Source> sources;
    for (const auto& [source, weight] : weights) sources.push_back({source, weight});
    std::stable_sort(sources.begin(), sources.end(),
                     [](const auto& a, const auto& b) { return a.weight > b.weight; });
    if (sources.size() > kMaximumSources) sources.resize(kMaximumSources);
    new_positions_.push_back(middle);
    around_.emplace_back(around.begin(), around.end());
    sources_.push_back(std::move(sources));
    return mesh_.vertex_count() + new_vertex_count() - 1;
}

std::vector<Vec3> HolePatch::with_middles(std::vector<Vec3> x) const {
    x.reserve(x.size() + around_.size());
    for (const std::vector<Index>& around : around_) {
        Vec3 middle = Vec3::Zero();
        const double share = 1.0 / static_cast<double>(around.size());
        for (const Index v : around) middle += share * x[at(v)];
        x.push_back(middle);
    }
    return x;
}

Index HolePatch::triangle_at(Index from, Index to) const {
    const auto found = left_.find(key(from, to));
    return found == left_.end() ? kNoIndex : found->second;
}

bool HolePatch::has_edge(Index a, Index b) const {
    if (triangle_at(a, b) != kNoIndex || triangle_at(b, a) != kNoIndex) return true;
    if (a >= mesh_.vertex_count() || b >= mesh_.vertex_count()) return false;
    // A hub of very many neighbours is met from the other end.
    const Topology& topology = mesh_.topology();
    const bool from_a = topology.valence(a) <= topology.valence(b);
    const std::span<const Index> ring = topology.neighbors(from_a ? a : b);
    return std::find(ring.begin(), ring.end(), from_a ? b : a) != ring.end();
}

Vec3 HolePatch::normal(Index triangle) const {
    const auto [a, b, c] = triangles_[triangle];
    return (position(b) - position(a)).cross(position(c) - position(a));
}

double HolePatch::mean_edge_length(Index v) const {
    const std::span<const Index> ring = mesh_.topology().neighbors(v);
    double sum = 0.0;
    for (const Index n : ring) sum += (mesh_.position(n) - mesh_.position(v)).norm();
    return sum / ring.size();
}

bool HolePatch::refine(std::span<const Index> loop, double density, Index maximum_vertices,
                       const Context& context) {
    for (const Index v : loop) spacing(v) = mean_edge_length(v) / density;
    for (Index v = mesh_.vertex_count(); v < mesh_.vertex_count() + new_vertex_count(); ++v) {
        spacing(v) = 0.0;
        for (const auto& [source, weight] : sources(v - mesh_.vertex_count())) {
            spacing(v) += weight * spacing(source);
        }
    }
    std::vector<std::pair<Index, Index>> all;
    for (const Triangle& t : triangles_) {
        for (int k = 0; k < 3; ++k) all.emplace_back(t[k], t[(k + 1) % 3]);
    }
    relax(std::move(all), context);
    while (split_large_triangles(maximum_vertices, context)) {
        context.checkpoint();
        if (new_vertex_count() >= maximum_vertices) return false;
    }
    return true;
}

// One pass over the triangles; true if one was split.
bool HolePatch::split_large_triangles(Index maximum_vertices, const Context& context) {
    std::vector<std::pair<Index, Index>> dirty;
    const auto count = count_of(triangles_);
    bool any = false;
    for (Index t = 0; t < count && new_vertex_count() < maximum_vertices; ++t) {
        const Triangle corners = triangles_[t];
        Vec3 center = Vec3::Zero();
        double wanted = 0.0;
        for (const Index v : corners) {
            center += position(v) / 3.0;
            wanted += spacing(v) / 3.0;
        }
        const bool large = std::all_of(corners.begin(), corners.end(), [&](Index v) {
            return (position(v) - center).norm() > kFarthest * std::max(wanted, spacing(v));
        });
        if (!large) continue;
        split(t);
        any = true;
        for (int k = 0; k < 3; ++k) dirty.emplace_back(corners[k], corners[(k + 1) % 3]);
    }
    relax(std::move(dirty), context);
    return any;
}

void HolePatch::split(Index triangle) {
    const auto [a, b, c] = triangles_[triangle];
    const Index middle = add_middle_vertex(triangles_[triangle]);
    spacing(middle) = (spacing(a) + spacing(b) + spacing(c)) / 3.0;
    set_triangle(triangle, {a, b, middle});
    add_triangle(b, c, middle);
    add_triangle(c, a, middle);
}

// Flips edges until none is better flipped.
void HolePatch::relax(std::vector<std::pair<Index, Index>> edges, const Context& context) {
    std::size_t flips_left = kFlipsPerEdge * triangles_.size();
    while (!edges.empty() && flips_left > 0) {
        context.checkpoint();
        const auto [a, b] = edges.back();
        edges.pop_back();
        const Index t = triangle_at(a, b), u = triangle_at(b, a);
        if (t == kNoIndex || u == kNoIndex || !flip_if_better(a, b)) continue;
        --flips_left;
        for (const Triangle& around : {triangles_[t], triangles_[u]}) {
            for (int k = 0; k < 3; ++k) edges.emplace_back(around[k], around[(k + 1) % 3]);
        }
    }
}

// Flips an edge if the angles opposite to it sum to more than pi and the new triangles face as the
// old ones do.
bool HolePatch::flip_if_better(Index a, Index b) {
    const Index t = triangle_at(a, b), u = triangle_at(b, a);
    const auto apex = [](const Triangle& triangle, Index from, Index to) {
        return triangle[0] + triangle[1] + triangle[2] - from - to;
    };
    const Index c = apex(triangles_[t], a, b), d = apex(triangles_[u], a, b);
    const Vec3 &pa = position(a), &pb = position(b), &pc = position(c), &pd = position(d);
    if (cotangent(pc, pa, pb) + cotangent(pd, pa, pb) >= -1e-9 || c == d || has_edge(c, d)) {
        return false;
    }
    const Vec3 before = normal(t).normalized() + normal(u).normalized();
    const Vec3 first = (pd - pa).cross(pc - pa), second = (pb - pd).cross(pc - pd);
    if (first.dot(before) <= 0.0 || second.dot(before) <= 0.0) return false;
    left_.erase(key(a, b));
    left_.erase(key(b, a));
    set_triangle(t, {a, d, c});
    set_triangle(u, {d, b, c});
    return true;
}

}  // namespace lissom
