/// Surfaces of which the edges of every triangle are given: Poisson's equation, with a factor that
/// is kept (Yu et al., "Mesh editing with Poisson-based gradient field manipulation", 2004);
/// private to kernel/deform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/poses/pose_triangles.h"
#include "kernel/mesh/mesh.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// A system for the vertices of one mesh.
class EdgeSurface {
  public:
    /// `holds` flags the vertices that stay at rest; vertices without faces stay as well. A
    /// component that has none and no link floats. Errors: memory_limit; cancelled.
    EdgeSurface(const Mesh& rest, const PoseTriangles& triangles, std::vector<char> holds,
                const Context& context);

    /// Finds the positions whose edges differ least from those given, by weighted squares; edges
    /// of one surface give that surface. A floating component is anywhere. The memory of
    /// `positions` and of `values`, which are the unknowns, is used again.
    void solve(const PoseTriangles& triangles, std::span<const TriangleEdges> edges,
               std::vector<double>& values, std::vector<Vec3>& positions) const;

    /// Flags of components that float.
    const std::vector<char>& floats() const { return floats_; }
    std::size_t memory_bytes() const;

  private:
    Vec3 rest_of(Index v) const { return rest_[at(v)] - origin_; }
    void assemble(const PoseTriangles& triangles, const std::vector<Index>& first_of_component,
                  const Context& context);

    Vec3 origin_;
    std::vector<Vec3> rest_;
    // Row of each vertex that moves, or kNoIndex.
    std::vector<Index> row_;
    Index rows_ = 0;
    std::vector<char> floats_;
    SparseSystem system_;
};

}  // namespace lissom
