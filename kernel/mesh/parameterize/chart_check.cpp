#include "kernel/mesh/parameterize/chart_check.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/mesh/directed_edges.h"

namespace lissom {
namespace {

// Sets of vertices that edges have joined; the lowest vertex stands for its set.
class JoinedVertices {
  public:
    explicit JoinedVertices(Index count) : parent_(at(count)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    void join(Index a, Index b) {
        a = first(a);
        b = first(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    std::vector<Index> firsts() {
        std::vector<Index> result;
        for (Index v = 0; v < count_of(parent_); ++v) {
            if (first(v) == v) result.push_back(v);
        }
        return result;
    }

  private:
    Index first(Index v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }

    std::vector<Index> parent_;
};

class ChartCheck {
  public:
    ChartCheck(std::span<const Triangle> triangles, std::span<const Index> id)
        : id_(id), joined_(count_of(id)), next_(id.size(), kNoIndex) {
        for (const Triangle& t : triangles) faces_.add(t);
        const DirectedEdges edges(count_of(id), faces_);
        edges.for_each_edge([&](std::span<const Index> corners) { take_edge(edges, corners); });
    }

    std::vector<std::vector<Index>> boundaries() {
        refuse_if(edges_.count > 0, ErrorCode::nonmanifold_edge, edges_,
                  "the triangles do not form a surface at ",
                  "; close a hole with triangles that turn as the faces around it and use no edge "
                  "that these have inside");
        refuse_if(vertices_.count > 0, ErrorCode::nonmanifold_vertex, vertices_,
                  "faces to be laid out meet only at ",
                  "; grow or shrink the region by a ring, or smooth its outline");
        require_one_part();
        require_genus_zero();
        return loops();
    }

  private:
    // The two triangles at an edge run along it in opposite directions.
    void take_edge(const DirectedEdges& edges, std::span<const Index> corners) {
        ++edge_count_;
        const Index low = edges.low(corners[0]), high = edges.high(corners[0]);
        joined_.join(low, high);
        const bool pair =
            corners.size() == 2 && edges.ascending(corners[0]) != edges.ascending(corners[1]);
        if (corners.size() > 1) {
            if (!pair) edges_.add_edge(id_[low], id_[high]);
            return;
        }
        const bool ascending = edges.ascending(corners[0]);
        const Index from = ascending ? low : high, to = ascending ? high : low;
        if (next_[from] != kNoIndex) vertices_.add(id_[from]);
        next_[from] = to;
        ++border_count_;
    }

    void require_one_part() {
        const std::vector<Index> parts = joined_.firsts();
        if (parts.size() == 1) return;
        Elements elements{ElementKind::vertex, 0, {}};
        for (const Index v : parts) elements.add(id_[v]);
        refuse_if(true, ErrorCode::not_a_disk, elements,
                  "the faces fall into " + std::to_string(parts.size()) + " parts, which begin at ",
                  "; lay out one part at a time");
    }

    // Euler's characteristic is 2 - 2 genus - boundaries.
    void require_genus_zero() {
        Elements lowest{ElementKind::vertex, 0, {}};
        lowest.add(id_[0]);
        refuse_if(border_count_ == 0, ErrorCode::not_a_disk, lowest,
                  "the surface to be laid out is closed around ",
                  "; leave a part of it out of the region");
        const Index characteristic = count_of(id_) - edge_count_ + faces_.size();
        const Index genus = (2 - count_of(loops()) - characteristic) / 2;
        refuse_if(genus > 0, ErrorCode::not_a_disk, lowest,
                  "the surface to be laid out has " + std::to_string(genus) +
                      (genus == 1 ? " handle around " : " handles around "),
                  "; choose a region that goes around none, such as half of it");
    }

    std::vector<std::vector<Index>> loops() const {
        std::vector<std::vector<Index>> result;
        std::vector<char> seen(next_.size(), 0);
        for (Index v = 0; v < count_of(next_); ++v) {
            if (seen[v] || next_[v] == kNoIndex) continue;
            std::vector<Index>& loop = result.emplace_back();
            for (Index w = v; !seen[w]; w = next_[w]) {
                seen[w] = 1;
                loop.push_back(w);
            }
        }
        return result;
    }

    static void refuse_if(bool wrong, ErrorCode code, const Elements& elements,
                          const std::string& what, const char* remedy) {
        if (wrong) throw Error(code, what + describe(elements) + remedy, elements);
    }

    std::span<const Index> id_;
    FaceList faces_;
    JoinedVertices joined_;
    // The vertex after each on a boundary.
    std::vector<Index> next_;
    Index edge_count_ = 0, border_count_ = 0;
    Elements edges_{ElementKind::edge, 0, {}}, vertices_{ElementKind::vertex, 0, {}};
};

}  // namespace

std::vector<std::vector<Index>> boundaries_of_chart(std::span<const Triangle> triangles,
                                                    std::span<const Index> id) {
    return ChartCheck(triangles, id).boundaries();
}

}  // namespace lissom
