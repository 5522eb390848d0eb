/// BodyGrid: the distance to a body at the points of a uniform grid, for quick and many questions;
/// private to kernel/hair.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/hair/operators/strand_collision.h"

namespace lissom {

class BodyGrid {
  public:
    /// No body: all places are far from it.
    BodyGrid() = default;
    /// Asks `distance` at all grid points near the body in `box`, and at every fourth elsewhere.
    /// Errors: memory_limit, cancelled.
    BodyGrid(const BodyDistance& distance, const Box& box, const Context& context);

    bool empty() const { return values_.empty(); }

    struct Sample {
        /// Infinite outside of the box.
        double distance = 0.0;
        /// Derivative of it, about the outward normal near the surface.
        Vec3 gradient = Vec3::Zero();
    };
    /// Trilinear between grid points.
    Sample sample(const Vec3& place) const;
    std::size_t memory_bytes() const { return values_.size() * sizeof(float); }

  private:
    void ask_coarse(const BodyDistance& distance, const Context& context);
    void ask_near(const BodyDistance& distance, const Context& context);
    double between_coarse(Index i, Index j, Index k) const;
    Index coarse_number(Index i, Index j, Index k) const;

    GridLayout layout_;
    std::array<Index, 3> coarse_counts_{0, 0, 0};
    std::vector<float> values_, coarse_;
    MemoryCharge charge_;
};

}  // namespace lissom
