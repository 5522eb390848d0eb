#include "kernel/merge/paste/search/loop_search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

#include "kernel/merge/piece/face_set.h"

namespace lissom {
namespace {

constexpr double kNoLoop = std::numeric_limits<double>::infinity();

using Reached = std::pair<double, Index>;
using NearestFirst = std::priority_queue<Reached, std::vector<Reached>, std::greater<>>;

std::vector<std::pair<Index, Index>> edges_of(const Mesh& mesh, std::span<const Index> faces) {
    std::vector<std::pair<Index, Index>> edges;
    for (const Index f : faces) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            edges.push_back(std::minmax(face[k], face[(k + 1) % face.size()]));
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

std::size_t place_in(std::span<const Index> ring, Index v) {
    return at(std::find(ring.begin(), ring.end(), v) - ring.begin());
}

}  // namespace

LoopSearch::LoopSearch(const Mesh& source, const PasteRegions& regions, const Context& context)
    : edges_(edges_of(source, regions.ring)) {
    context.checkpoint();
    for (const auto& [a, b] : edges_) {
        vertices_.push_back(a);
        vertices_.push_back(b);
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    Arcs arcs(vertices_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const Index a = local(edges_[e].first), b = local(edges_[e].second);
        arcs[at(a)].push_back({b, index_of(e), 0});
        arcs[at(b)].push_back({a, index_of(e), 0});
    }
    find_cut(source, regions, arcs);
    label(source, regions, arcs);
    find_faces(source, regions);
}

Index LoopSearch::local(Index vertex) const {
    return index_of(std::lower_bound(vertices_.begin(), vertices_.end(), vertex) -
                    vertices_.begin());
}

Index LoopSearch::edge_between(Index a, Index b) const {
    const std::pair<Index, Index> edge = std::minmax(a, b);
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge);
    return found != edges_.end() && *found == edge ? index_of(found - edges_.begin()) : kNoIndex;
}

// The shortest way from the outer boundary to the inner one that touches each only at its end.
void LoopSearch::find_cut(const Mesh& source, const PasteRegions& regions, const Arcs& arcs) {
    std::vector<double> distance(vertices_.size(), kNoLoop);
    std::vector<Index> from(vertices_.size(), kNoIndex);
    std::vector<char> last(vertices_.size(), 0);
    for (const Index v : regions.inner) last[at(local(v))] = 1;
    NearestFirst queue;
    for (const Index v : regions.outer) {
        distance[at(local(v))] = 0.0;
        queue.push({0.0, local(v)});
    }
    while (!queue.empty()) {
        const auto [length, v] = queue.top();
        queue.pop();
        if (length > distance[at(v)]) continue;
        if (last[at(v)]) {
            for (Index step = v; step != kNoIndex; step = from[at(step)]) cut_.push_back(step);
            break;
        }
        for (const Arc& arc : arcs[at(v)]) {
            const double reached =
                length +
                (source.position(vertices_[at(v)]) - source.position(vertices_[at(arc.to)])).norm();
            if (reached >= distance[at(arc.to)]) continue;
            distance[at(arc.to)] = reached;
            from[at(arc.to)] = v;
            queue.push({reached, arc.to});
        }
    }
    std::reverse(cut_.begin(), cut_.end());
}

// Edges that leave the cut to its right, seen from the outer boundary, cross it.
void LoopSearch::label(const Mesh& source, const PasteRegions& regions, Arcs& arcs) {
    const Topology& topology = source.topology();
    const FaceSet ring(topology, regions.ring);
    std::vector<char> on_cut(vertices_.size(), 0);
    for (const Index v : cut_) on_cut[at(v)] = 1;
    const auto mark = [&](Index v, Index neighbor) {
        const Index w = local(neighbor);
        for (Arc& arc : arcs[at(v)]) {
            if (arc.to == w && !on_cut[at(w)]) arc.turns = 1;
        }
        for (Arc& arc : arcs[at(w)]) {
            if (arc.to == v && !on_cut[at(w)]) arc.turns = -1;
        }
    };
    for (std::size_t i = 0; i < cut_.size(); ++i) {
        const Index v = vertices_[at(cut_[i])];
        const auto around = topology.neighbors(v);
        const auto fan = topology.faces_around(v);
        const std::size_t n = around.size();
        const auto in_ring = [&](std::size_t k) { return k < fan.size() && ring.contains(fan[k]); };
        const bool first = i == 0;
        const Index along = vertices_[at(first ? cut_[1] : cut_[i - 1])];
        const Index stop = first || i + 1 == cut_.size() ? kNoIndex : vertices_[at(cut_[i + 1])];
        // Right of the cut: clockwise from its next edge, counter-clockwise from the one before.
        std::size_t k = place_in(around, along);
        for (std::size_t step = 0; step < n; ++step) {
            const std::size_t face = first ? (k + n - 1) % n : k;
            if (!in_ring(face)) break;
            k = first ? face : (k + 1) % n;
            if (around[k] == stop || around[k] == along) break;
            mark(cut_[i], around[k]);
        }
    }
    // A chord of the cut belongs to no side.
    for (const Index v : cut_) {
        std::erase_if(arcs[at(v)], [&](const Arc& arc) {
            if (!on_cut[at(arc.to)]) return false;
            const auto a = std::find(cut_.begin(), cut_.end(), v) - cut_.begin();
            const auto b = std::find(cut_.begin(), cut_.end(), arc.to) - cut_.begin();
            return a - b != 1 && b - a != 1;
        });
    }
    std::vector<WindingEdge> edges(edges_.size());
    for (std::size_t v = 0; v < arcs.size(); ++v) {
        for (const Arc& arc : arcs[v]) {
            if (index_of(v) > arc.to) continue;
            edges[at(arc.edge)] = {index_of(v), arc.to, arc.turns};
        }
    }
    graph_ = WindingGraph(count_of(vertices_), edges);
}

void LoopSearch::find_faces(const Mesh& source, const PasteRegions& regions) {
    beside_.assign(edges_.size(), {kNoIndex, kNoIndex});
    face_begin_.assign(1, 0);
    for (std::size_t f = 0; f < regions.ring.size(); ++f) {
        const std::span<const Index> face = source.topology().face(regions.ring[f]);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            face_edges_.push_back(edge_between(a, b));
            beside_[at(face_edges_.back())][a < b ? 0 : 1] = index_of(f);
        }
        face_begin_.push_back(count_of(face_edges_));
    }
}

/// The search in parts of a ring that loops divide.
class RingDivision {
  public:
    RingDivision(const LoopSearch& ring, std::span<const double> cost, const Context& context)
        : ring_(ring),
          cost_(cost),
          context_(context),
          search_(ring.graph_, cost),
          usable_(ring.edges_.size(), 0),
          place_in_cut_(ring.vertices_.size(), kNoIndex),
          inside_(ring.face_begin_.size() - 1, 0) {
        for (std::size_t k = 0; k < ring.cut_.size(); ++k) {
            place_in_cut_[at(ring.cut_[k])] = index_of(k);
        }
    }

    std::vector<Index> cheapest(std::span<const Index> known) {
        std::vector<Index> faces(inside_.size()), candidates(ring_.cut_.size());
        std::iota(faces.begin(), faces.end(), 0);
        std::iota(candidates.begin(), candidates.end(), 0);
        for (const Index v : known) best_.push_back(ring_.local(v));
        if (known.empty()) {
            find_first(candidates);
        } else {
            least_ = cost_of(best_);
        }
        search_.bound(ring_.cut_, least_);
        divide(faces, {}, std::move(candidates));
        for (Index& v : best_) v = ring_.vertices_[at(v)];
        return std::move(best_);
    }

  private:
    struct Halves {
        /// Faces, and the edges of the loop between them.
        std::vector<Index> outer, inner, rim;
    };
    struct Parts {
        Halves halves;
        /// Places in the cut that are left to seek through in either half.
        std::vector<Index> before, behind;
    };

    // The edges of faces may be used and those of `rim`, and no others: there are no faces between
    // the loops around a half at points at which these touch.
    void use(const std::vector<Index>& faces, const std::vector<Index>& rim, char flag) {
        for (const Index f : faces) {
            for (Index k = ring_.face_begin_[at(f)]; k < ring_.face_begin_[at(f) + 1]; ++k) {
                usable_[at(ring_.face_edges_[at(k)])] = flag;
            }
        }
        for (const Index e : rim) usable_[at(e)] = flag;
    }

    Index edge_of(const std::vector<Index>& loop, std::size_t k) const {
        return ring_.edge_between(ring_.vertices_[at(loop[k])],
                                  ring_.vertices_[at(loop[(k + 1) % loop.size()])]);
    }

    double cost_of(const std::vector<Index>& loop) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < loop.size(); ++k) sum += cost_[at(edge_of(loop, k))];
        return sum;
    }

    void keep(std::vector<Index> loop) {
        const double cost = cost_of(loop);
        if (!(cost < least_)) return;
        least_ = cost;
        best_ = std::move(loop);
    }

    // Any loop, whose cost is a limit for all others. Candidates without one go.
    void find_first(std::vector<Index>& candidates) {
        while (!candidates.empty() && best_.empty()) {
            const Index place = candidates[candidates.size() / 2];
            WindingLoop loop = search_.through(ring_.cut_[at(place)]);
            if (!loop.vertices.empty()) {
                keep(std::move(loop.vertices));
                return;
            }
            // Vertices connected with this one have no loop either.
            std::erase_if(candidates, [&](Index c) { return search_.reached(ring_.cut_[at(c)]); });
        }
    }

    double min_through(Index place) const { return search_.min_through(ring_.cut_[at(place)]); }

    // Seeks through vertices of the cut, given by their places in it, ascending. Only a loop that
    // is cheaper than all before is found, and divides the rest.
    void divide(const std::vector<Index>& faces, const std::vector<Index>& rim,
                std::vector<Index> candidates) {
        use(faces, rim, 1);
        WindingLoop loop;
        Index place = kNoIndex;
        while (loop.vertices.empty()) {
            context_.checkpoint();
            std::erase_if(candidates, [&](Index c) { return !(min_through(c) < least_); });
            const auto next =
                std::min_element(candidates.begin(), candidates.end(),
                                 [&](Index a, Index b) { return min_through(a) < min_through(b); });
            if (next == candidates.end()) break;
            place = *next;
            candidates.erase(next);
            loop = search_.through(ring_.cut_[at(place)], usable_, least_);
        }
        use(faces, rim, 0);
        if (loop.vertices.empty()) return;
        if (!candidates.empty()) {
            const Parts parts = parted(loop.vertices, place, faces, candidates);
            keep(std::move(loop.vertices));
            divide(parts.halves.outer, parts.halves.rim, parts.before);
            divide(parts.halves.inner, parts.halves.rim, parts.behind);
        } else {
            keep(std::move(loop.vertices));
        }
    }

    // A cheaper loop touches neither `loop` from across nor the way to it from vertex `place` of
    // the cut, which it was found through. So it meets the cut before the first place on that way
    // or on the loop, or behind the last.
    Parts parted(const std::vector<Index>& loop, Index place, const std::vector<Index>& faces,
                 const std::vector<Index>& candidates) {
        Index first = kNoIndex, last = kNoIndex;
        for (const Index v : loop) {
            const Index here = place_in_cut_[at(v)];
            if (here == kNoIndex) continue;
            first = first == kNoIndex ? here : std::min(first, here);
            last = std::max(last, here);
        }
        Parts parts{divided(loop, faces), {}, {}};
        const bool inward = holds(parts.halves.inner, place);
        const bool outward = holds(parts.halves.outer, place);
        if (inward && !outward) last = std::max(last, place);
        if (outward && !inward) first = std::min(first, place);
        for (const Index c : candidates) {
            if (c <= first) parts.before.push_back(c);
            if (c >= last) parts.behind.push_back(c);
        }
        return parts;
    }

    bool holds(const std::vector<Index>& faces, Index place) const {
        const Index v = ring_.vertices_[at(ring_.cut_[at(place)])];
        return std::any_of(faces.begin(), faces.end(), [&](Index f) {
            for (Index k = ring_.face_begin_[at(f)]; k < ring_.face_begin_[at(f) + 1]; ++k) {
                const auto& [a, b] = ring_.edges_[at(ring_.face_edges_[at(k)])];
                if (a == v || b == v) return true;
            }
            return false;
        });
    }

    // Faces to the left of a loop and those to its right.
    Halves divided(const std::vector<Index>& loop, const std::vector<Index>& faces) {
        for (const Index f : faces) inside_[at(f)] = 1;
        std::vector<Index> rim, inner;
        const auto reach = [&](Index f) {
            if (f == kNoIndex || inside_[at(f)] != 1) return;
            inside_[at(f)] = 2;
            inner.push_back(f);
        };
        for (std::size_t k = 0; k < loop.size(); ++k) rim.push_back(edge_of(loop, k));
        std::vector<Index> walls = rim;
        std::sort(walls.begin(), walls.end());
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const bool up = loop[k] < loop[(k + 1) % loop.size()];
            reach(ring_.beside_[at(rim[k])][up ? 0 : 1]);
        }
        for (std::size_t i = 0; i < inner.size(); ++i) {
            for (Index k = ring_.face_begin_[at(inner[i])]; k < ring_.face_begin_[at(inner[i]) + 1];
                 ++k) {
                const Index e = ring_.face_edges_[at(k)];
                if (std::binary_search(walls.begin(), walls.end(), e)) continue;
                for (const Index f : ring_.beside_[at(e)]) reach(f);
            }
        }
        Halves halves{{}, std::move(inner), std::move(rim)};
        for (const Index f : faces) {
            if (inside_[at(f)] == 1) halves.outer.push_back(f);
            inside_[at(f)] = 0;
        }
        return halves;
    }

    const LoopSearch& ring_;
    std::span<const double> cost_;
    const Context& context_;
    WindingSearch search_;
    std::vector<char> usable_;
    std::vector<Index> place_in_cut_;
    // 0: not of the faces at hand, 1: of them, 2: left of the loop.
    std::vector<char> inside_;
    double least_ = kNoLoop;
    std::vector<Index> best_;
};

std::vector<Index> LoopSearch::cheapest(std::span<const double> cost, std::span<const Index> known,
                                        const Context& context) const {
    return RingDivision(*this, cost, context).cheapest(known);
}

}  // namespace lissom
