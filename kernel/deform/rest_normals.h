/// Custom normals of the rest shape, which turn with the surface; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// The values of the attribute "normal" at the vertices of a region, or at their corners.
class RestNormals {
  public:
    RestNormals(const Mesh& mesh, const Region& region);

    bool empty() const { return value_.empty(); }
    /// Writes each normal, turned by the rotation of its vertex's deformation gradient; gradients
    /// come in the region's order. Does nothing where `mesh` has no such attribute any more.
    void apply_to(Mesh& mesh, std::span<const Mat3> gradients) const;

  private:
    Domain domain_ = Domain::vertex;
    /// Element of the attribute and row of the region, for each value.
    std::vector<Index> element_, row_;
    std::vector<Vec3> value_;
};

}  // namespace lissom
