#include "kernel/deform/holds/boundary_refinement.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

namespace lissom {
namespace {

using Edge = std::pair<Index, Index>;

// Edges that differ by less count as equally long, so that rounding does not choose between them.
constexpr double kSameLength = 1e-9;

Edge edge_of(Index a, Index b) {
    return std::minmax(a, b);
}

// Whether the k-th edge of triangle t, from its k-th corner, is one of the surface rather than a
// diagonal of a quad.
bool is_side(const WeightedTriangles& triangles, std::size_t t, int k) {
    return triangles.weight[t] == 1.0 || k < 2;
}

// Edges between two vertices of one holder on triangles that it does not hold as a whole.
std::vector<Edge> border_edges(const Patch& patch, const HolderMap& holding) {
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const Triangle& corners = patch.triangles.triangle[t];
        for (int k = 0; k < 3; ++k) {
            const Index a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
            if (!is_side(patch.triangles, t, k) || holding.known.position[c]) continue;
            if (common_holder({{a, 0.5}, {b, 0.5}}, holding) != kFree) {
                edges.push_back(edge_of(a, b));
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

// Mean length of the edges of the surface with an end that moves.
double mean_free_length(const Patch& patch, const HolderMap& holding) {
    double sum = 0.0, count = 0.0;
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const Triangle& corners = patch.triangles.triangle[t];
        for (int k = 0; k < 3; ++k) {
            const Index a = corners[k], b = corners[(k + 1) % 3];
            if (!is_side(patch.triangles, t, k)) continue;
            if (holding.known.position[a] && holding.known.position[b]) continue;
            sum += patch.triangles.weight[t] * (patch.rest[a] - patch.rest[b]).norm();
            count += patch.triangles.weight[t];
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

// Those of `edges` whose connected piece has a mean length above `limit`.
std::vector<Edge> of_coarse_pieces(const Patch& patch, const std::vector<Edge>& edges,
                                   double limit) {
    std::map<Index, Index> parent;
    const auto root = [&](Index v) {
        while (parent.try_emplace(v, v).first->second != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const auto& [a, b] : edges) parent[root(a)] = root(b);
    std::map<Index, std::pair<double, double>> length;
    for (const auto& [a, b] : edges) {
        auto& [sum, count] = length[root(a)];
        sum += (patch.rest[a] - patch.rest[b]).norm();
        count += 1.0;
    }
    std::vector<Edge> coarse;
    for (const Edge& edge : edges) {
        const auto& [sum, count] = length[root(edge.first)];
        if (sum > limit * count) coarse.push_back(edge);
    }
    return coarse;
}

SparseRow mean_of(const std::vector<SparseRow>& rows) {
    std::map<Index, double> sum;
    for (const SparseRow& row : rows) {
        for (const auto& [v, c] : row) sum[v] += c / rows.size();
    }
    return {sum.begin(), sum.end()};
}

class Refiner {
  public:
    Refiner(Patch patch, const HolderMap& holding)
        : patch_(std::move(patch)), holding_(holding), around_(patch_.real_count) {
        for (std::size_t t = 0; t < triangles().size(); ++t) {
            for (const Index v : triangles().triangle[t]) around_[v].push_back(t);
        }
        for (Index v = 0; v < patch_.real_count; ++v) {
            held_.push_back(common_holder({{v, 1.0}}, holding) != kFree);
        }
        patch_.rest.resize(around_.size());
        patch_.in_region.resize(around_.size());
        patch_.on_boundary.resize(around_.size());
    }

    Patch refined(std::vector<Edge> edges, double limit) {
        while (!edges.empty()) {
            const auto [a, b] = edges.back();
            edges.pop_back();
            if (length(a, b) <= limit) continue;
            const Index middle = split(a, b);
            edges.push_back(edge_of(a, middle));
            edges.push_back(edge_of(middle, b));
        }
        insert_virtual_vertices(patch_);
        return std::move(patch_);
    }

  private:
    WeightedTriangles& triangles() { return patch_.triangles; }
    double length(Index a, Index b) const { return (patch_.rest[a] - patch_.rest[b]).norm(); }

    SparseRow row_of(Index v) const {
        if (v < patch_.mesh_count()) return {{v, 1.0}};
        return patch_.inserted[v - patch_.mesh_count()];
    }

    std::vector<std::size_t> triangles_at(Index a, Index b) {
        std::vector<std::size_t> found;
        for (const std::size_t t : around_[a]) {
            const Triangle& corners = triangles().triangle[t];
            if (std::find(corners.begin(), corners.end(), b) != corners.end()) found.push_back(t);
        }
        return found;
    }

    void put(std::size_t t, int corner, Index v) {
        std::vector<std::size_t>& left = around_[triangles().triangle[t][corner]];
        left.erase(std::find(left.begin(), left.end(), t));
        triangles().triangle[t][corner] = v;
        around_[v].push_back(t);
    }

    // A vertex is in the region if some of its parents are: between two outside it is pinned, as
    // they are.
    Index add_vertex(const std::vector<Index>& between, bool on_boundary) {
        std::vector<SparseRow> rows;
        Vec3 at = Vec3::Zero();
        char in_region = 0;
        for (const Index v : between) {
            rows.push_back(row_of(v));
            at += patch_.rest[v] / count_of(between);
            in_region = static_cast<char>(in_region | patch_.in_region[v]);
        }
        patch_.inserted.push_back(mean_of(rows));
        patch_.rest.push_back(at);
        patch_.in_region.push_back(in_region);
        patch_.on_boundary.push_back(on_boundary);
        held_.push_back(common_holder(patch_.inserted.back(), holding_) != kFree);
        around_.emplace_back();
        return patch_.real_count++;
    }

    // Makes the quad with triangle t four triangles around the mean of its corners.
    void open_quad(std::size_t t) {
        const std::size_t first = t - t % 4;
        std::vector<Index> corners;
        for (std::size_t k = 0; k < 4; ++k) corners.push_back(triangles().triangle[first + k][0]);
        const Index center = add_vertex(corners, false);
        for (std::size_t k = 0; k < 4; ++k) {
            put(first + k, 2, center);
            triangles().weight[first + k] = 1.0;
        }
    }

    // An edge of triangle t that is longer than `than`, the longest: none of a triangle that is
    // held, as it need not keep its angles.
    std::optional<Edge> longer_edge(std::size_t t, double than) {
        const Triangle& c = triangles().triangle[t];
        if (held_[c[0]] && held_[c[1]] && held_[c[2]]) return std::nullopt;
        std::optional<Edge> longest;
        for (int k = 0; k < 3; ++k) {
            const Index a = c[k], b = c[(k + 1) % 3];
            if (length(a, b) <= (1.0 + kSameLength) * than) continue;
            longest = edge_of(a, b);
            than = length(a, b);
        }
        return longest;
    }

    // Splits the edge once it is the longest of its triangles, and gives the vertex in its middle.
    Index split(Index a, Index b) {
        const auto done = middle_.find(edge_of(a, b));
        if (done != middle_.end()) return done->second;
        bool longest = false;
        while (!longest) {
            longest = true;
            for (const std::size_t t : triangles_at(a, b)) {
                if (triangles().weight[t] != 1.0) open_quad(t);
                const std::optional<Edge> longer = longer_edge(t, length(a, b));
                if (!longer) continue;
                split(longer->first, longer->second);
                longest = false;
                break;
            }
        }
        return bisect(a, b);
    }

    Index bisect(Index a, Index b) {
        const std::vector<std::size_t> both = triangles_at(a, b);
        const Index middle = add_vertex({a, b}, both.size() == 1);
        middle_[edge_of(a, b)] = middle;
        for (const std::size_t t : both) {
            Triangle second = triangles().triangle[t];
            const auto at_b = std::find(second.begin(), second.end(), b) - second.begin();
            *std::find(second.begin(), second.end(), a) = middle;
            put(t, index_of(at_b), middle);
            for (const Index v : second) around_[v].push_back(triangles().size());
            triangles().add(second, triangles().weight[t], triangles().face[t]);
        }
        return middle;
    }

    Patch patch_;
    const HolderMap& holding_;
    std::vector<std::vector<std::size_t>> around_;
    std::vector<char> held_;
    std::map<Edge, Index> middle_;
};

}  // namespace

Index common_holder(const SparseRow& row, const HolderMap& holding) {
    const Index holder = holding.owner[row.front().first];
    if (holder < 0 && holder != kPinned) return kFree;
    const bool common = std::all_of(row.begin(), row.end(), [&](const auto& entry) {
        return holding.owner[entry.first] == holder && holding.known.position[entry.first];
    });
    return common ? holder : kFree;
}

std::optional<Patch> refined_at_borders(const Patch& patch, const HolderMap& holding,
                                        double length) {
    const double spacing = mean_free_length(patch, holding);
    if (spacing == 0.0) return std::nullopt;
    std::vector<Edge> coarse =
        of_coarse_pieces(patch, border_edges(patch, holding), kCoarseBorder * spacing);
    if (coarse.empty()) return std::nullopt;
    return Refiner(patch, holding).refined(std::move(coarse), length * spacing);
}

}  // namespace lissom
