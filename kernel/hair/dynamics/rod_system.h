/// RodSystem: a symmetric positive definite system of the points of a rod, of which each meets the
/// two before and the two behind it; private to kernel/hair.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

class RodSystem {
  public:
    /// A system of zeros.
    explicit RodSystem(std::size_t points);

    /// Adds a block at the row of a point and the column of that one or of one of the two before.
    void add(std::size_t row, std::size_t column, const Mat3& block);
    /// Adds to the right side.
    void push(std::size_t row, const Vec3& value);
    /// Solves it, by Cholesky's method within the band.
    void solve();
    /// Returns the solution at a point.
    Vec3 result(std::size_t point) const;

  private:
    // Entries of a row up to its diagonal.
    static constexpr std::size_t kBand = 9;

    double& entry(std::size_t row, std::size_t column) {
        return band_[kBand * row + column + kBand - 1 - row];
    }
    void factor();

    std::size_t size_ = 0;
    std::vector<double> band_, right_;
};

}  // namespace lissom
