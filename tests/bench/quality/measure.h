/// How well a deformed surface keeps the shape of its parts: measures that belong to no method.
#pragma once

#include <span>
#include <vector>

#include "kernel/mesh/mesh.h"

namespace lissom::bench {

struct Quality {
    /// As-rigid-as-possible energy over the whole mesh: the sum over vertices i of the least
    /// sum_j w_ij |R e_ij - e'_ij|^2 over rotations R, relative to the sum of w_ij |e_ij|^2; with
    /// cotangent weights, clamped at 0.
    double energy = 0.0;
    /// Ratio of the singular values of each triangle's deformation, over triangles with a free
    /// vertex.
    double anisotropy_median = 1.0, anisotropy_p99 = 1.0, anisotropy_max = 1.0;
    /// Enclosed volume relative to that at rest.
    double volume = 1.0;
    /// Change of the dihedral angle, in degrees, over edges at the border of handles: one end at
    /// least is held, and a face beside it has a free vertex.
    double crease_p99 = 0.0, crease_max = 0.0;
};

/// Measures deformed copies of one triangle mesh whose `held` vertices belong to handles.
class QualityMeasure {
  public:
    QualityMeasure(const Mesh& rest, const std::vector<Index>& held);

    Quality of(const std::vector<Vec3>& positions) const;

  private:
    struct Edge {
        Index a, b, left, right;
        double weight, length_squared;
        bool at_border;
    };

    double energy(std::span<const Vec3> positions) const;
    std::vector<double> anisotropies(std::span<const Vec3> positions) const;
    std::vector<double> creases(std::span<const Vec3> positions) const;

    Mesh rest_;
    std::vector<Edge> edges_;
    /// Faces with a free vertex.
    std::vector<Index> free_faces_;
    double rest_energy_ = 0.0, rest_volume_ = 0.0;
};

}  // namespace lissom::bench
