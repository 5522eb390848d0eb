#include "kernel/merge/paste/winding_graph.h"

#include <algorithm>
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
      cost_(cost),
      distance_(at(graph.vertex_count()) * kSheets, kUnsettled),
      from_(distance_.size(), kNoIndex) {}

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

void WindingSearch::meet(Index forward, Index backward, double cost) {
    if (!(cost < least_)) return;
    least_ = cost;
    forward_ = forward;
    backward_ = backward;
}

// The way back from the end of a walk, which is the start one sheet above, is the way forward one
// sheet below: one search from the start does for both, and needs to go half the way only.
void WindingSearch::settle(Index node, double distance, std::span<const char> usable) {
    const Index v = vertex_of(node);
    const int sheet = sheet_of(node);
    for (Index k = graph_.begin_[at(v)]; k < graph_.begin_[at(v) + 1]; ++k) {
        const auto& [to, edge, turns] = graph_.arcs_[at(k)];
        const double reached = distance + cost_[at(edge)];
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
        if (reached < distance_[at(there)]) reach(there, node, reached);
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
        settle(node, distance, usable);
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
