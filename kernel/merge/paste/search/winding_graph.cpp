#include "kernel/merge/paste/search/winding_graph.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <unordered_map>

namespace lissom {
namespace {

constexpr double kUnsettled = std::numeric_limits<double>::infinity();
// Sheets of the covering that a walk may visit: -1, 0 and 1.
constexpr int kSheets = 3;

Index node_of(Index vertex, int sheet) {
    return vertex * kSheets + sheet + 1;
}
Index vertex_of(Index node) {
    return node / kSheets;
}
int sheet_of(Index node) {
    return node % kSheets - 1;
}
bool is_sheet(int sheet) {
    return sheet >= -1 && sheet <= 1;
}

// Sheets of bounds: one more to either side, since walks begin and end a sheet apart.
constexpr int kBoundSheets = 5;
// Bounds are sums in another order than walks.
constexpr double kBoundRounding = 1.0 + 1e-12;

std::size_t bound_of(Index vertex, int sheet) {
    return at(vertex) * kBoundSheets + static_cast<std::size_t>(sheet + kBoundSheets / 2);
}

}  // namespace

WindingGraph::WindingGraph(Index vertex_count, std::span<const WindingEdge> edges)
    : begin_(at(vertex_count) + 1, 0) {
    for (const WindingEdge& edge : edges) {
        if (edge.a == kNoIndex) continue;
        ++begin_[at(edge.a) + 1];
        ++begin_[at(edge.b) + 1];
    }
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    arcs_.resize(at(begin_.back()));
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto [a, b, turns] = edges[e];
        if (a == kNoIndex) continue;
        arcs_[at(next[at(a)]++)] = {b, index_of(e), turns};
        arcs_[at(next[at(b)]++)] = {a, index_of(e), -turns};
    }
}

WindingSearch::WindingSearch(const WindingGraph& graph, std::span<const double> cost)
    : graph_(graph),
      distance_(at(graph.vertex_count()) * kSheets, kUnsettled),
      from_(distance_.size(), kNoIndex) {
    cost_.reserve(graph.arcs_.size());
    for (const WindingGraph::Arc& arc : graph.arcs_) cost_.push_back(cost[at(arc.edge)]);
}

void WindingSearch::clear() {
    for (const Index node : touched_) distance_[at(node)] = kUnsettled;
    touched_.clear();
    heap_.clear();
    least_ = kUnsettled;
    forward_ = backward_ = kNoIndex;
}

void WindingSearch::reach(Index node, Index from, double distance) {
    if (distance_[at(node)] == kUnsettled) touched_.push_back(node);
    distance_[at(node)] = distance;
    from_[at(node)] = from;
    heap_.emplace_back(distance, node);
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

void WindingSearch::bound(std::span<const Index> starts, double limit) {
    bound_.assign(at(graph_.vertex_count()) * kBoundSheets, kUnsettled);
    std::vector<std::pair<double, std::size_t>> heap;
    const auto reach_bound = [&](std::size_t node, double distance) {
        if (!(distance < bound_[node])) return;
        bound_[node] = distance;
        heap.emplace_back(distance, node);
        std::push_heap(heap.begin(), heap.end(), std::greater<>());
    };
    for (const Index start : starts) reach_bound(bound_of(start, 0), 0.0);
    while (!heap.empty()) {
        const auto [distance, node] = heap.front();
        std::pop_heap(heap.begin(), heap.end(), std::greater<>());
        heap.pop_back();
        if (distance > bound_[node]) continue;
        const Index v = index_of(node / kBoundSheets);
        const int sheet = static_cast<int>(node % kBoundSheets) - kBoundSheets / 2;
        for (Index k = graph_.begin_[at(v)]; k < graph_.begin_[at(v) + 1]; ++k) {
            const auto& [to, edge, turns] = graph_.arcs_[at(k)];
            const double reached = distance + cost_[at(k)];
            if (reached >= limit || std::abs(sheet + turns) > kBoundSheets / 2) continue;
            reach_bound(bound_of(to, sheet + turns), reached);
        }
    }
}

double WindingSearch::min_through(Index start) const {
    return bound_[bound_of(start, 1)];
}

// Whether no walk that costs less than the limit goes on from here: neither to a start one sheet
// above, nor, as the way back, to one a sheet below.
bool WindingSearch::leads_nowhere(Index vertex, int sheet, double distance, double limit) const {
    if (bound_.empty()) return false;
    const double rest =
        std::min(bound_[bound_of(vertex, sheet - 1)], bound_[bound_of(vertex, sheet + 1)]);
    return distance + rest > limit * kBoundRounding;
}

void WindingSearch::meet(Index forward, Index backward, double cost) {
    if (!(cost < least_)) return;
    least_ = cost;
    forward_ = forward;
    backward_ = backward;
}

// The way back from the end of a walk, which is the start one sheet above, is the way forward one
// sheet below: one search from the start does for both, and needs to go half the way only.
void WindingSearch::settle(Index node, double distance, std::span<const char> usable,
                           double limit) {
    const Index v = vertex_of(node);
    const int sheet = sheet_of(node);
    for (Index k = graph_.begin_[at(v)]; k < graph_.begin_[at(v) + 1]; ++k) {
        const auto& [to, edge, turns] = graph_.arcs_[at(k)];
        const double reached = distance + cost_[at(k)];
        if (!(reached < kUnsettled) || (!usable.empty() && !usable[at(edge)])) continue;
        const int next = sheet + turns;
        if (is_sheet(next - 1)) {
            const Index other = node_of(to, next - 1);
            meet(node, other, reached + distance_[at(other)]);
        }
        if (is_sheet(next + 1)) {
            const Index other = node_of(to, next + 1);
            meet(other, node, reached + distance_[at(other)]);
        }
        if (!is_sheet(next)) continue;
        const Index there = node_of(to, next);
        if (!(reached < distance_[at(there)])) continue;
        if (!leads_nowhere(to, next, reached, std::min(least_, limit))) reach(there, node, reached);
    }
}

std::vector<WindingSearch::Step> WindingSearch::walk() const {
    std::vector<Step> steps;
    for (Index node = forward_; node != kNoIndex; node = from_[at(node)]) {
        steps.push_back({vertex_of(node), sheet_of(node)});
    }
    std::reverse(steps.begin(), steps.end());
    // All but the last, which is the start again.
    for (Index node = backward_; from_[at(node)] != kNoIndex; node = from_[at(node)]) {
        steps.push_back({vertex_of(node), sheet_of(node) + 1});
    }
    return steps;
}

WindingLoop WindingSearch::through(Index start, std::span<const char> usable, double limit) {
    clear();
    reach(node_of(start, 0), kNoIndex, 0.0);
    while (!heap_.empty()) {
        const auto [distance, node] = heap_.front();
        if (2.0 * distance >= std::min(least_, limit)) break;
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        heap_.pop_back();
        if (distance > distance_[at(node)]) continue;
        settle(node, distance, usable, limit);
    }
    WindingLoop loop;
    if (!(least_ < limit)) return loop;
    loop.cost = least_;
    const std::vector<Step> steps = walk();
    std::unordered_map<Index, std::size_t> seen;
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const auto [place, fresh] = seen.emplace(steps[k].vertex, k);
        if (fresh) continue;
        // Between the first two visits of one vertex is a loop that visits no other one twice.
        for (std::size_t i = place->second; i < k; ++i) loop.vertices.push_back(steps[i].vertex);
        if (steps[k].sheet < steps[place->second].sheet) {
            std::reverse(loop.vertices.begin(), loop.vertices.end());
        }
        return loop;
    }
    for (const Step& step : steps) loop.vertices.push_back(step.vertex);
    return loop;
}

bool WindingSearch::reached(Index vertex) const {
    for (int sheet = -1; sheet <= 1; ++sheet) {
        if (distance_[at(node_of(vertex, sheet))] < kUnsettled) return true;
    }
    return false;
}

}  // namespace lissom
