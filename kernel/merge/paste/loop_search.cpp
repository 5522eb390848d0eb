#include "kernel/merge/paste/loop_search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "kernel/merge/paste/face_set.h"

namespace lissom {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();
// Sheets of the ring's covering that a loop may visit: -1, 0 and 1.
constexpr int kSheets = 3;

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
    arcs_.resize(vertices_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const Index a = local(edges_[e].first), b = local(edges_[e].second);
        arcs_[at(a)].push_back({b, index_of(e), 0});
        arcs_[at(b)].push_back({a, index_of(e), 0});
    }
    find_cut(source, regions);
    label(source, regions);
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
void LoopSearch::find_cut(const Mesh& source, const PasteRegions& regions) {
    std::vector<double> distance(vertices_.size(), kUnreached);
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
        for (const Arc& arc : arcs_[at(v)]) {
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
void LoopSearch::label(const Mesh& source, const PasteRegions& regions) {
    const Topology& topology = source.topology();
    const FaceSet ring(topology, regions.ring);
    std::vector<char> on_cut(vertices_.size(), 0);
    for (const Index v : cut_) on_cut[at(v)] = 1;
    const auto mark = [&](Index v, Index neighbor) {
        const Index w = local(neighbor);
        for (Arc& arc : arcs_[at(v)]) {
            if (arc.to == w && !on_cut[at(w)]) arc.turns = 1;
        }
        for (Arc& arc : arcs_[at(w)]) {
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
        std::erase_if(arcs_[at(v)], [&](const Arc& arc) {
            if (!on_cut[at(arc.to)]) return false;
            const auto a = std::find(cut_.begin(), cut_.end(), v) - cut_.begin();
            const auto b = std::find(cut_.begin(), cut_.end(), arc.to) - cut_.begin();
            return a - b != 1 && b - a != 1;
        });
    }
}

double LoopSearch::search_from(Index start, std::span<const double> cost, double limit,
                               std::vector<Index>& loop) const {
    const auto node = [](Index v, int sheet) { return v * kSheets + sheet + 1; };
    std::vector<double> distance(vertices_.size() * kSheets, kUnreached);
    std::vector<Index> from(distance.size(), kNoIndex);
    NearestFirst queue;
    distance[at(node(start, 0))] = 0.0;
    queue.push({0.0, node(start, 0)});
    const Index goal = node(start, 1);
    while (!queue.empty()) {
        const auto [length, here] = queue.top();
        queue.pop();
        if (length >= limit) return kUnreached;
        if (length > distance[at(here)]) continue;
        if (here == goal) break;
        const int sheet = here % kSheets - 1;
        for (const Arc& arc : arcs_[at(here / kSheets)]) {
            const int next = sheet + arc.turns;
            const double reached = length + cost[at(arc.edge)];
            if (next < -1 || next > 1) continue;
            const Index there = node(arc.to, next);
            if (!(reached < distance[at(there)])) continue;
            distance[at(there)] = reached;
            from[at(there)] = here;
            queue.push({reached, there});
        }
    }
    if (!(distance[at(goal)] < limit)) return kUnreached;
    loop.clear();
    for (Index step = from[at(goal)]; step != kNoIndex; step = from[at(step)]) {
        loop.push_back(vertices_[at(step / kSheets)]);
    }
    std::reverse(loop.begin(), loop.end());
    return distance[at(goal)];
}

std::vector<Index> LoopSearch::cheapest(std::span<const double> cost,
                                        const Context& context) const {
    std::vector<Index> best, loop;
    double least = kUnreached;
    for (const Index start : cut_) {
        context.checkpoint();
        const double found = search_from(start, cost, least, loop);
        if (!(found < least)) continue;
        least = found;
        best = loop;
    }
    return best;
}

}  // namespace lissom
