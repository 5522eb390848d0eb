/// The surface on which values of a grid are 0; private to kernel/hair.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Nodes at equal steps along the axes, x first.
struct NodeGrid {
    Vec3 origin = Vec3::Zero();
    double step = 1.0;
    Eigen::Array3i counts = Eigen::Array3i::Ones();

    std::size_t size() const { return at(counts[0]) * at(counts[1]) * at(counts[2]); }
    std::size_t place(const Eigen::Array3i& node) const {
        return (at(node[2]) * at(counts[1]) + at(node[1])) * at(counts[0]) + at(node[0]);
    }
    Vec3 position(const Eigen::Array3i& node) const {
        return origin + step * node.cast<double>().matrix();
    }
    /// Returns the value at a point between nodes; points outside take that of the border.
    double interpolated(const std::vector<float>& values, const Vec3& point) const;
};

/// Triangles with shared vertices, which face where values are below 0.
struct LevelSurface {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

/// Returns the surface between values above 0 and others, by six tetrahedra in each cell (Doi and
/// Koide 1991): closed but for the border of the grid, and a manifold. Errors: memory_limit;
/// cancelled.
LevelSurface level_surface(const NodeGrid& grid, const std::vector<float>& values,
                           const Context& context);

}  // namespace lissom
