/// Region: a set of vertices of one topology. Its faces are those with all vertices inside. Its
/// memory counts on the account of its topology: making one may throw memory_limit. Constructors
/// from geometry (spheres, boxes, distances, labels) are in region_select.h.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/core/memory_hold.h"
#include "kernel/mesh/topology.h"

namespace lissom {

class Region {
  public:
    /// The set of `vertices`, in any order, repeats allowed.
    /// Errors: out_of_range naming the vertices that do not exist.
    Region(std::shared_ptr<const Topology> topology, std::vector<Index> vertices);

    /// All vertices, or none.
    static Region all(std::shared_ptr<const Topology> topology);
    static Region none(std::shared_ptr<const Topology> topology);

    /// Vertices in ascending order.
    const std::vector<Index>& vertices() const& { return vertices_; }
    std::vector<Index> vertices() && { return std::move(vertices_); }
    Index size() const { return count_of(vertices_); }
    bool empty() const { return vertices_.empty(); }
    bool contains(Index v) const;
    /// Faces with all vertices inside, ascending.
    std::vector<Index> faces() const;
    /// Loops of vertices around the region's faces, each in the direction of those faces.
    std::vector<std::vector<Index>> boundaries() const;

    /// Set operations. Errors: topology_mismatch if `other` belongs to another topology.
    Region united(const Region& other) const;
    Region minus(const Region& other) const;
    Region intersected(const Region& other) const;
    Region inverted() const;
    /// Adds `rings` one-rings. Errors: invalid_argument if negative.
    Region grown(Index rings) const;
    /// Removes vertices within `rings` edges of a vertex outside; open mesh boundaries do not count
    /// as outside.
    Region shrunk(Index rings) const;
    /// Smooths the outline: majority vote over one-rings, `iterations` times. Isolated specks and
    /// pinholes go; a region never becomes empty.
    Region smoothed(Index iterations = 3) const;

    const std::shared_ptr<const Topology>& topology() const { return topology_; }
    /// Returns one flag a vertex of the topology.
    std::vector<char> mask() const;

    bool operator==(const Region& other) const {
        return topology_ == other.topology_ && vertices_ == other.vertices_;
    }

  private:
    std::shared_ptr<const Topology> topology_;
    MemoryHold hold_;
    std::vector<Index> vertices_;
};

}  // namespace lissom
