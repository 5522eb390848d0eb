/// Cheapest loops around a ring in any graph that is drawn on it; private to kernel/merge.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// An edge of a graph on a ring, and how often it crosses a cut of the ring from right to left on
/// its way from `a` to `b`.
struct WindingEdge {
    Index a = kNoIndex, b = kNoIndex;
    int turns = 0;
};

struct WindingLoop {
    /// Each once, in order; empty if there is no loop.
    std::vector<Index> vertices;
    /// Cost of the whole walk that it was found in.
    double cost = std::numeric_limits<double>::infinity();
};

class WindingGraph {
  public:
    WindingGraph() = default;
    /// Edges without ends are left out, and keep their numbers.
    WindingGraph(Index vertex_count, std::span<const WindingEdge> edges);

    Index vertex_count() const { return count_of(begin_) - 1; }

  private:
    friend class WindingSearch;
    struct Arc {
        Index to, edge;
        int turns;
    };
    // Arcs of vertex v: begin_[v] to begin_[v + 1].
    std::vector<Index> begin_{0};
    std::vector<Arc> arcs_;
};

/// Dijkstra's method on the covering of a graph, whose nodes are vertices with the number of times
/// that the cut was crossed. Keeps its memory from one search to the next.
class WindingSearch {
  public:
    /// Both must outlive it. Costs are above 0, or infinite for edges that must not be used.
    WindingSearch(const WindingGraph& graph, std::span<const double> cost);

    /// Finds lower bounds of the costs of walks through vertices, if all loops around the ring pass
    /// one of `starts`, so that `through` leaves out vertices without a walk below `limit`.
    void bound(std::span<const Index> starts, double limit);
    /// Returns the lower bound of closed walks through one of those: infinite for the limit or
    /// more.
    double min_through(Index start) const;
    /// Returns the cheapest closed walk through `start` once around the ring, counter-clockwise, or
    /// the loop in it if it visits a vertex twice: a loop with a tail to the start. `usable`, one
    /// flag an edge, may leave edges out; walks that cost `limit` or more are not found.
    WindingLoop through(Index start, std::span<const char> usable = {},
                        double limit = std::numeric_limits<double>::infinity());
    /// Whether the last search came to a vertex.
    bool reached(Index vertex) const;

  private:
    struct Step {
        Index vertex;
        int sheet;
    };
    void clear();
    void reach(Index node, Index from, double distance);
    bool leads_nowhere(Index vertex, int sheet, double distance, double limit) const;
    void settle(Index node, double distance, std::span<const char> usable, double limit);
    void meet(Index forward, Index backward, double cost);
    std::vector<Step> walk() const;

    const WindingGraph& graph_;
    // Costs of arcs.
    std::vector<double> cost_;
    std::vector<double> distance_;
    std::vector<Index> from_, touched_;
    std::vector<std::pair<double, Index>> heap_;
    // Least costs from the starts on sheet 0 to each vertex on the sheets -2 to 2, if they are
    // known.
    std::vector<double> bound_;
    // The cheapest walk so far: to a node, over an edge or none, and back from another one.
    double least_ = std::numeric_limits<double>::infinity();
    Index forward_ = kNoIndex, backward_ = kNoIndex;
};

}  // namespace lissom
