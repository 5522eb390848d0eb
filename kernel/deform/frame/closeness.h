/// Distances of parts of a surface that lie apart at rest; private to
/// kernel/deform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Samples of a mesh at rest; those at `moving` vertices may move.
class Closeness {
  public:
    /// `moving` is ascending. Samples are spread evenly, so that the time does not depend on the
    /// number of vertices.
    Closeness(const Mesh& rest, std::span<const Index> moving);

    /// Returns the distance of the two samples of `shape`, the positions of all vertices, that have
    /// come nearest to one another, as a share of half their distance at rest, or of the reach if
    /// they lay further apart: 1 if no two have come so near, 0 if two meet. Samples that lie
    /// within the reach at rest do not count. It is continuous in the positions. Takes no memory
    /// after the first.
    double operator()(std::span<const Vec3> shape);

  private:
    double of_pair(std::size_t i, std::size_t j, std::span<const Vec3> shape) const;
    void sort_along(std::span<const Vec3> shape, int axis);

    const Mesh& rest_;
    double reach_ = 0.0;
    std::vector<Index> samples_;
    std::vector<char> moves_;
    // Samples by a coordinate of the last shape.
    std::vector<std::size_t> order_;
};

}  // namespace lissom
