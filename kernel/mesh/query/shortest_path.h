/// Shortest ways along the edges of a mesh (Dijkstra); private to kernel/mesh.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Searches from vertices outward. One object serves many searches; each costs as much as the
/// vertices it visits.
class ShortestPaths {
  public:
    explicit ShortestPaths(const Mesh& mesh);

    /// Lengths of the shortest ways from `sources`, infinity beyond `limit`.
    const std::vector<double>& from(std::span<const Index> sources, double limit,
                                    const Context& context);
    /// Vertices of the shortest way, both ends included. The one found through smaller vertices
    /// among equally short ways. Errors: invalid_argument if there is none.
    std::vector<Index> between(Index from, Index to, const Context& context);

  private:
    void clear();
    void reach(Index v, double distance, Index from);
    void run(double limit, Index target, const Context& context);

    const Mesh& mesh_;
    std::vector<double> distance_;
    std::vector<Index> previous_;
    std::vector<Index> visited_;
    std::vector<std::pair<double, Index>> queue_;
};

}  // namespace lissom
