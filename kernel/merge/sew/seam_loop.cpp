#include "kernel/merge/sew/seam_loop.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// For each vertex of an open boundary, which one, and the vertex after it.
class BoundaryIndex {
  public:
    explicit BoundaryIndex(const Topology& topology)
        : loops_(topology.boundary_loops()),
          loop_of_(topology.vertex_count(), kNoIndex),
          place_of_(loop_of_) {
        for (std::size_t l = 0; l < loops_.size(); ++l) {
            for (std::size_t k = 0; k < loops_[l].size(); ++k) {
                loop_of_[loops_[l][k]] = index_of(l);
                place_of_[loops_[l][k]] = index_of(k);
            }
        }
    }

    Index loop_of(Index v) const { return loop_of_[v]; }

    // 1 if `vertices` are one whole boundary in its direction, -1 against it, 0 otherwise.
    int direction(std::span<const Index> vertices) const {
        const Index loop = loop_of_[vertices[0]];
        if (loop == kNoIndex || loops_[loop].size() != vertices.size()) return 0;
        const auto n = count_of(vertices);
        const auto step = [&](Index k) {
            const Index from = vertices[k], to = vertices[(k + 1) % n];
            if (loop_of_[to] != loop) return 0;
            const Index turn = (place_of_[to] - place_of_[from] + n) % n;
            return turn == 1 ? 1 : turn == n - 1 ? -1 : 0;
        };
        const int first = step(0);
        for (Index k = 1; k < n; ++k) {
            if (step(k) != first) return 0;
        }
        return first;
    }

  private:
    const std::vector<std::vector<Index>>& loops_;
    std::vector<Index> loop_of_, place_of_;
};

[[noreturn]] void fail(ErrorCode code, const std::string& what, std::span<const Index> vertices) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : vertices) elements.add(v);
    throw Error(code, what, elements);
}

void require_loop(const Topology& topology, const BoundaryIndex& boundaries,
                  std::span<const Index> loop, int wanted, const std::string& side) {
    require_vertices(topology, loop);
    if (loop.size() < 3) {
        fail(ErrorCode::not_a_boundary, "a loop of the " + side + " has fewer than 3 vertices",
             loop);
    }
    const int direction = boundaries.direction(loop);
    if (direction == wanted) return;
    if (direction == 0) {
        fail(ErrorCode::not_a_boundary,
             "a loop of the " + side + " is not a whole open boundary of it", loop);
    }
    fail(ErrorCode::not_a_boundary,
         wanted > 0 ? "a loop of the target runs against its boundary: the faces would not be "
                      "oriented alike; reverse it"
                    : "a loop of the source runs along its boundary, not against it: the faces "
                      "would not be oriented alike; reverse it",
         loop);
}

void require_places(std::span<const LoopPoint> places, std::span<const Index> loop,
                    std::size_t other_size) {
    for (std::size_t k = 0; k < places.size(); ++k) {
        const LoopPoint& place = places[k];
        const bool inside =
            place.segment >= 0 && at(place.segment) < other_size && place.t >= 0.0 && place.t < 1.0;
        if (!inside) {
            fail(ErrorCode::out_of_range, "the place of a vertex is not on the other loop",
                 loop.subspan(k, 1));
        }
    }
}

bool before(const LoopPoint& a, const LoopPoint& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.t < b.t;
}

// Once around, places grow except past the start.
void require_cyclic(std::span<const LoopPoint> places, std::span<const Index> loop) {
    Index passes = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const std::size_t next = (k + 1) % places.size();
        if (before(places[k], places[next])) continue;
        if (places[k] == places[next] || ++passes > 1) {
            const Index pair[] = {loop[k], loop[next]};
            fail(ErrorCode::boundary_conflict,
                 "two neighbours on a loop do not follow each other on the other loop; correct the "
                 "correspondence there",
                 pair);
        }
    }
}

// The places on both loops must tell the same story: each target vertex lies after the same source
// vertex on both.
void require_consistent(const LoopPair& join) {
    const std::vector<SeamVertex> seam = seam_loop(join);
    const std::size_t n = seam.size();
    std::size_t first = 0;
    while (!seam[first].of_source) ++first;
    Index last_source = kNoIndex;
    for (std::size_t i = 0; i < n; ++i) {
        const SeamVertex& v = seam[(first + i) % n];
        if (v.of_source) last_source = v.on_source.segment;
        const LoopPoint& place = v.on_source;
        const bool sound = v.of_source || (place.segment == last_source && place.t > 0.0);
        if (sound) continue;
        fail(ErrorCode::boundary_conflict,
             "the places of a vertex of the target and of its neighbours on the source contradict "
             "each other",
             std::span(&join.target[v.on_target.segment], 1));
    }
}

void require_unused(const BoundaryIndex& boundaries, std::span<const Index> loop,
                    std::vector<Index>& used, const std::string& side) {
    const Index number = boundaries.loop_of(loop[0]);
    if (std::find(used.begin(), used.end(), number) != used.end()) {
        fail(ErrorCode::boundary_conflict, "two joins use one boundary of the " + side, loop);
    }
    used.push_back(number);
}

}  // namespace

void require_joins(const Topology& target, const Topology& source,
                   std::span<const LoopPair> joins) {
    if (joins.empty()) throw Error(ErrorCode::invalid_argument, "there is no join to sew");
    const BoundaryIndex target_boundaries(target), source_boundaries(source);
    std::vector<Index> target_used, source_used;
    for (const LoopPair& join : joins) {
        require_loop(target, target_boundaries, join.target, 1, "target");
        require_loop(source, source_boundaries, join.source, -1, "source");
        require_unused(target_boundaries, join.target, target_used, "target");
        require_unused(source_boundaries, join.source, source_used, "source");
        if (join.on_target.size() != join.source.size() ||
            join.on_source.size() != join.target.size()) {
            throw Error(ErrorCode::invalid_argument,
                        "a join needs one place for each vertex of its loops");
        }
        require_places(join.on_target, join.source, join.target.size());
        require_places(join.on_source, join.target, join.source.size());
        require_cyclic(join.on_target, join.source);
        require_cyclic(join.on_source, join.target);
        require_consistent(join);
    }
}

std::vector<SeamVertex> seam_loop(const LoopPair& join) {
    const auto n = count_of(join.target);
    const auto m = count_of(join.source);
    std::vector<SeamVertex> seam;
    seam.reserve(join.target.size() + join.source.size());
    // Source vertices by place, beginning with the first one after the target's first vertex.
    const auto first = std::min_element(join.on_target.begin(), join.on_target.end(), before) -
                       join.on_target.begin();
    Index done = 0;
    const auto source_at = [&] { return index_of((first + done) % m); };
    for (Index j = 0; j < n; ++j) {
        SeamVertex corner{{j, 0.0}, join.on_source[j], true, false};
        if (done < m && join.on_target[source_at()] == LoopPoint{j, 0.0}) {
            corner.on_source = {source_at(), 0.0};
            corner.of_source = true;
            ++done;
        }
        seam.push_back(corner);
        for (; done < m && join.on_target[source_at()].segment == j; ++done) {
            seam.push_back({join.on_target[source_at()], {source_at(), 0.0}, false, true});
        }
    }
    return seam;
}

Vec3 seam_point(std::span<const Vec3> points, const SeamVertex& vertex) {
    return point_of(points, vertex.on_target);
}

Index snap(std::vector<SeamVertex>& seam, std::span<const Vec3> target_points, double limit) {
    const std::size_t n = seam.size();
    std::vector<double> length(n);
    double mean = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        length[k] =
            (seam_point(target_points, seam[(k + 1) % n]) - seam_point(target_points, seam[k]))
                .norm();
        mean += length[k] / n;
    }
    if (!(mean > 0.0)) return 0;
    // In steps, so that rounding does not decide between equal lengths.
    for (double& l : length) l = std::floor(l / mean * 1e9 + 0.5) * 1e-9;
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < n; ++k) {
        if (length[k] < limit) order.push_back(k);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return length[a] < length[b]; });
    std::vector<char> gone(n, 0);
    for (const std::size_t k : order) {
        std::size_t kept = k, other = (k + 1) % n;
        if (!seam[kept].of_target) std::swap(kept, other);
        const bool mixed = seam[kept].of_target && !seam[kept].of_source && seam[other].of_source &&
                           !seam[other].of_target && !gone[other];
        if (!mixed) continue;
        seam[kept].of_source = true;
        seam[kept].on_source = seam[other].on_source;
        gone[other] = 1;
    }
    std::size_t left = 0;
    for (std::size_t k = 0; k < n; ++k) {
        if (!gone[k]) seam[left++] = seam[k];
    }
    seam.resize(left);
    return index_of(n - left);
}

}  // namespace lissom
