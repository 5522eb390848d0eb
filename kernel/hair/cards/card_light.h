/// Light from all around within hair, and the way out of the head; private to kernel/hair.
#pragma once

#include <functional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Returns the unit direction away from the head at `p`: the differences of its `distance` over
/// `step` metres; without a distance, away from `middle`.
Vec3 away_from_head(const std::function<double(const Vec3&)>& distance, const Vec3& middle,
                    const Vec3& p, double step);

/// The optical density of hair on a grid of cells of about 5 mm.
class HairDensity {
  public:
    explicit HairDensity(const Strands& strands);

    /// Returns the light from all around that reaches a point, over 26 directions, as a part of
    /// the light on an open surface, 0 to 1; hair further than 8 cm counts no more.
    double openness(const Vec3& point) const;

  private:
    Index cell_of(const Vec3& point) const;

    Box box_;
    double cell_ = 0.005;
    Eigen::Array3i counts_ = Eigen::Array3i::Zero();
    /// Part of the light that a metre through the cell holds back.
    std::vector<float> density_;
};

}  // namespace lissom
