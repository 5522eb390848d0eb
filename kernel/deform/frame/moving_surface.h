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
#include "kernel/mesh/query/crossing_search.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// The faces of the mesh that a preparation may move, with all others around them. It keeps its
/// memory, so that measures take none after the first. A shape is the positions of all vertices of
/// the mesh.
class MovingSurface {
  public:
    /// Errors: cancelled; memory_limit.
    MovingSurface(const Preparation& prepared, const Context& context);
    MovingSurface(const MovingSurface&) = delete;
    MovingSurface& operator=(const MovingSurface&) = delete;

    /// Makes `shape` that of the mesh with the region at `positions`: one for each of its vertices,
    /// in its order. Errors: not_finite naming the vertices.
    void place(std::span<const Vec3> positions, std::vector<Vec3>& shape) const;
    /// Returns the greatest factor by which an edge that moves is longer or shorter than at rest.
    double stretch(std::span<const Vec3> shape) const;
    /// Returns how near parts come that lie apart at rest: 1 not at all, 0 if they meet.
    double closeness(std::span<const Vec3> shape) { return closeness_(shape); }
    /// Returns whether faces run through one another that did not at rest. Errors: cancelled.
    bool crosses(std::span<const Vec3> shape, const Context& context) {
        return search_.finds_others(shape, crossings_, context);
    }

  private:
    std::vector<Index> region_, moving_;
    Mesh rest_;
    CrossingSearch search_;
    std::vector<FacePair> crossings_;
    Closeness closeness_;
};

}  // namespace lissom
