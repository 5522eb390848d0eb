#include "kernel/deform/poses/edge_surface.h"

#include <algorithm>
#include <array>

namespace lissom {
namespace {

// use(from, to, edge, weight) for each edge of a triangle that counts.
template <typename Use>
void for_each_side(const Triangle& triangle, const std::array<double, 3>& weight,
                   const TriangleEdges& edges, const Use& use) {
    const std::array<Vec3, 3> sides{edges.first, edges.second, -(edges.first + edges.second)};
    for (std::size_t k = 0; k < 3; ++k) {
        if (weight[k] > 0.0) use(triangle[k], triangle[(k + 1) % 3], sides[k], weight[k]);
    }
}

}  // namespace

EdgeSurface::EdgeSurface(const Mesh& rest, const PoseTriangles& triangles, std::vector<char> holds,
                         const Context& context)
    : origin_(rest.position(0)), rest_(rest.positions().begin(), rest.positions().end()) {
    const Topology& topology = rest.topology();
    std::vector<Index> first(at(topology.component_count()), kNoIndex);
    floats_.assign(first.size(), 0);
    std::vector<char> is_held(first.size(), 0);
    for (Index v = 0; v < rest.vertex_count(); ++v) {
        const std::size_t component = at(topology.components()[at(v)]);
        const bool stays = holds[at(v)] || topology.is_isolated(v);
        row_.push_back(stays ? kNoIndex : rows_++);
        if (stays) is_held[component] = 1;
        if (first[component] == kNoIndex) first[component] = v;
    }
    for (std::size_t c = 0; c < first.size(); ++c) {
        floats_[c] = !is_held[c] && triangles.base[c] == index_of(c);
    }
    if (rows_ > 0) assemble(triangles, first, context);
}

void EdgeSurface::assemble(const PoseTriangles& triangles,
                           const std::vector<Index>& first_of_component, const Context& context) {
    std::vector<Triplet> entries;
    for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
        for_each_side(triangles.triangles[t], triangles.weight[t], {},
                      [&](Index from, Index to, const Vec3&, double weight) {
                          const Index a = row_[at(from)], b = row_[at(to)];
                          if (a != kNoIndex) entries.push_back({a, a, weight});
                          if (b != kNoIndex) entries.push_back({b, b, weight});
                          if (a == kNoIndex || b == kNoIndex) return;
                          entries.push_back({std::max(a, b), std::min(a, b), -weight});
                      });
    }
    // One vertex of a floating component is drawn to its rest, which strains nothing.
    for (std::size_t c = 0; c < floats_.size(); ++c) {
        const Index row = row_[at(first_of_component[c])];
        if (floats_[c] && row != kNoIndex) entries.push_back({row, row, 1.0});
    }
    const SymmetricMatrix matrix = symmetric_from_triplets(rows_, entries);
    system_.analyze(matrix, context);
    system_.factor(matrix, context);
}

void EdgeSurface::solve(const PoseTriangles& triangles, std::span<const TriangleEdges> edges,
                        std::vector<double>& values, std::vector<Vec3>& positions) const {
    positions = rest_;
    if (rows_ == 0) return;
    values.assign(3 * at(rows_), 0.0);
    const auto add = [&](Index row, const Vec3& value) {
        for (Index c = 0; c < 3; ++c) values[at(c * rows_ + row)] += value[c];
    };
    for (std::size_t t = 0; t < triangles.triangles.size(); ++t) {
        for_each_side(triangles.triangles[t], triangles.weight[t], edges[t],
                      [&](Index from, Index to, const Vec3& edge, double weight) {
                          const Index a = row_[at(from)], b = row_[at(to)];
                          if (a != kNoIndex) add(a, -weight * edge);
                          if (b != kNoIndex) add(b, weight * edge);
                          if (a != kNoIndex && b == kNoIndex) add(a, weight * rest_of(to));
                          if (b != kNoIndex && a == kNoIndex) add(b, weight * rest_of(from));
                      });
    }
    system_.solve(values, values, 3);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (row_[v] == kNoIndex) continue;
        for (Index c = 0; c < 3; ++c) {
            positions[v][c] = origin_[c] + values[at(c * rows_ + row_[v])];
        }
    }
}

std::size_t EdgeSurface::memory_bytes() const {
    return rest_.size() * (sizeof(Vec3) + sizeof(Index)) + system_.stats().factor_bytes;
}

}  // namespace lissom
