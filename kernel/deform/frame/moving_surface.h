/// Quality of a frame's surface, compared with the rest shape; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/frame/closeness.h"
#include "kernel/deform/preparation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// The faces of the mesh that a preparation may move, with all others around them. The shapes to
/// measure have the positions of a frame: one for each vertex of the region, in its order.
class MovingSurface {
  public:
    /// Errors: cancelled; memory_limit.
    MovingSurface(const Preparation& prepared, const Context& context);
    MovingSurface(const MovingSurface&) = delete;
    MovingSurface& operator=(const MovingSurface&) = delete;

    /// Returns the mesh with the region at `positions`.
    Mesh shape(std::span<const Vec3> positions) const;
    /// Returns the greatest factor by which an edge that moves is longer or shorter than at rest.
    double stretch(const Mesh& shape) const;
    /// Returns how near parts come that lie apart at rest: 1 not at all, 0 if they meet.
    double closeness(const Mesh& shape) const { return closeness_(shape); }
    /// Returns the number of pairs of faces that run through one another, and did not at rest.
    /// Errors: cancelled; memory_limit.
    Index crossings(const Mesh& shape, const Context& context) const;

  private:
    std::vector<FacePair> pairs_of(const Mesh& shape, const Context& context) const;

    std::vector<Index> region_, moving_, faces_;
    Mesh rest_;
    std::vector<FacePair> crossings_;
    Closeness closeness_;
};

}  // namespace lissom
