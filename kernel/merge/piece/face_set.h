/// Sets of faces that become disks and rings; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// One flag a face of a topology.
class FaceSet {
  public:
    FaceSet(const Topology& topology, std::span<const Index> faces);

    bool contains(Index face) const { return inside_[at(face)] != 0; }
    Index size() const { return size_; }
    /// Ascending.
    std::vector<Index> faces() const;
    void add(Index face);
    void remove(Index face);

    /// Faces connected through common edges, each part ascending; the largest part first.
    std::vector<std::vector<Index>> parts() const;
    /// Returns the same of the faces outside, as far as they lie in `bounds` (null: all faces).
    std::vector<std::vector<Index>> outside_parts(const FaceSet* bounds) const;

    /// Adds all faces of `bounds` around vertices at which the faces meet in more than one fan,
    /// until there is none.
    void grow_at_bow_ties(const FaceSet* bounds);
    /// Loops of vertices around the faces, in their direction, the longest by count first. The set
    /// must have no bow-ties.
    std::vector<std::vector<Index>> loops() const;
    /// V - E + F of the faces.
    Index euler_characteristic() const;

    const Topology& topology() const { return *topology_; }

  private:
    template <typename Predicate>
    std::vector<std::vector<Index>> connected(const Predicate& is_member) const;
    bool is_bow_tie(Index vertex) const;

    const Topology* topology_;
    std::vector<char> inside_;
    Index size_ = 0;
};

}  // namespace lissom
