/// Points of two meshes that correspond by parts; private to kernel/deform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/poses/pose_triangles.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Points with several coordinates each, one after another.
struct PartCoordinates {
    std::size_t width = 0;
    std::vector<double> values;

    std::span<const double> at(Index i) const {
        return {values.data() + lissom::at(i) * width, width};
    }
    Index count() const { return width == 0 ? 0 : index_of(values.size() / width); }
};

/// Returns coordinates of the triangles' centres that meshes in other shapes share: for each part
/// a harmonic function, 1 there and 0 on the other parts; and, with small weights, the normal and
/// the place in the mesh. Errors: unconstrained, naming a vertex, for a component without a part;
/// memory_limit; cancelled.
PartCoordinates part_coordinates(const Mesh& mesh, const PoseTriangles& triangles,
                                 const std::vector<const Region*>& parts, const Context& context);

/// A tree of points, for the nearest ones to others.
class NearestParts {
  public:
    /// Refers to `points`.
    explicit NearestParts(const PartCoordinates& points);

    /// A point and its squared distance.
    struct Hit {
        double squared_distance;
        Index point;
        bool operator<(const Hit& other) const { return squared_distance < other.squared_distance; }
    };

    /// Returns the `count` nearest points, or all if there are fewer, in no order.
    std::vector<Hit> nearest(std::span<const double> place, std::size_t count) const;

  private:
    void build(Index begin, Index end);
    std::size_t widest(Index begin, Index end) const;
    void search(Index begin, Index end, std::span<const double> place, std::size_t count,
                std::vector<Hit>& hits) const;

    const PartCoordinates& points_;
    // Points in the order of the tree: the middle of a range divides it along its axis.
    std::vector<Index> order_;
    std::vector<std::size_t> axis_;
};

}  // namespace lissom
