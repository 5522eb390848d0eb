/// DistanceGrid: the signed distance to a head at the points of a uniform grid, negative inside.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct DistanceGridOptions {
    /// Points nearer to the surface than this many steps get their exact distance (as float); those
    /// beyond one that is interpolated between points four steps apart, within the bounds that
    /// those set. 0 to 1e6; with the default, far distances are off by a sixth of a step in the
    /// mean and by less than two.
    double band = 4.0;
};

/// A head that is open at the neck or has eye holes is closed by cones over its holes, which count
/// as surface (closed_surface.h). Overlapping components are one solid.
class DistanceGrid {
  public:
    /// Takes the present shape of `head`, which may change or die afterwards.
    /// Errors: mesh_empty without faces; invalid_argument for a grid with fewer than two points or
    /// no step along an axis, or a bad option; memory_limit; cancelled.
    DistanceGrid(const Mesh& head, const GridLayout& layout,
                 const DistanceGridOptions& options = {}, const Context& context = {});

    const GridLayout& layout() const { return layout_; }
    /// Returns one distance a grid point, in the mesh's unit, x fastest.
    std::span<const float> values() const { return values_; }
    float at(Index i, Index j, Index k) const {
        return values_[lissom::at(layout_.index(i, j, k))];
    }

    /// Distance at a point, trilinear between grid points. Outside the grid: that of the nearest
    /// point of its box, plus the distance to it. NaN for a point that is.
    double value(const Vec3& point) const { return sample(point).value; }
    bool inside(const Vec3& point) const { return value(point) < 0.0; }

    struct Sample {
        double value = 0.0;
        /// Derivative of `value`; near the surface about the outward normal, of length about 1.
        Vec3 gradient = Vec3::Zero();
    };
    Sample sample(const Vec3& point) const;

    std::size_t memory_bytes() const { return values_.size() * sizeof(float); }

  private:
    GridLayout layout_;
    std::vector<float> values_;
    MemoryCharge charge_;
};

}  // namespace lissom
