/// Custom normals, tangents and morph targets of the rest shape, which turn with the surface;
/// private to kernel/deform.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// The values of all attributes that are directions, at the vertices of a region or at their
/// corners.
class RestDirections {
  public:
    RestDirections(const Mesh& mesh, const Region& region);

    bool empty() const { return attributes_.empty(); }
    /// Writes each value, turned by the rotation of its vertex's deformation gradient; gradients
    /// come in the region's order. Attributes that `mesh` has no more are passed over.
    void apply_to(Mesh& mesh, std::span<const Mat3> gradients) const;
    /// Takes the values so turned as those of the rest shape.
    void rebase(std::span<const Mat3> gradients);

  private:
    static std::vector<Mat3> rotations_of(std::span<const Mat3> gradients);

    struct Values {
        std::string name;
        Domain domain;
        Index width;
        /// Element of the attribute and row of the region, for each value.
        std::vector<Index> element, row;
        std::vector<Vec3> value;
    };

    std::vector<Values> attributes_;
};

}  // namespace lissom
