/// The search for faces that run through one another, with the memory that it takes; private to the
/// kernel.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/measure/triangulation_room.h"
#include "kernel/mesh/query/pair_tree.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Searches shapes of one topology, one after another, as `self_intersections` does.
class CrossingSearch {
  public:
    /// Holds the memory of a search, on the account of `context`. Errors: as self_intersections;
    /// memory_limit.
    CrossingSearch(std::shared_ptr<const Topology> topology, const SelfIntersectionOptions& options,
                   const Context& context);

    /// Returns the pairs of faces that meet at `positions`, ascending. Errors: cancelled.
    std::vector<FacePair> find(std::span<const Vec3> positions, const Context& context);

    /// Returns whether other pairs meet than those of `known`, which is ascending. Takes no memory
    /// after the first shape. Errors: cancelled.
    bool finds_others(std::span<const Vec3> positions, std::span<const FacePair> known,
                      const Context& context);

  private:
    std::vector<char> flags(const std::optional<std::vector<Index>>& faces) const;
    void reserve();
    void prepare(std::span<const Vec3> positions);
    Box box_of(std::span<const Index> vertices) const;
    double longest_side_of(const Triangle& t) const;
    void find_faces_that_may_meet();
    void choose(const std::vector<char>& face_chosen, std::vector<Index>& triangles) const;
    FacePair pair_if_they_meet(Index t, Index u) const;

    std::shared_ptr<const Topology> topology_;
    double tolerance_;
    std::vector<char> in_faces_, in_against_;
    MemoryCharge charge_;
    // Of the shape that is searched.
    std::span<const Vec3> positions_;
    std::vector<Box> face_boxes_, boxes_;
    std::vector<double> longest_;
    std::vector<Index> near_, asked_, in_tree_;
    Triangulation triangulation_;
    TriangulationRoom triangulation_room_;
    PairTree tree_;
};

}  // namespace lissom
