/// Nearest points of a surface in one chart, as sources of attributes. Private to kernel/mesh.
#pragma once

#include <memory>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

class SurfaceSamples {
  public:
    struct Sample {
        Vec3 position = Vec3::Zero();
        std::vector<ElementMap::Source> vertices, corners;
    };

    /// `mesh`, of triangles, must outlive it; `charts` numbers the part of each face. Trees are
    /// made for all charts. Errors: memory_limit; cancelled.
    SurfaceSamples(const Mesh& mesh, const std::vector<Index>& charts, const Context& context);

    /// Returns the nearest point in the chart of `face`.
    Sample nearest(Index face, const Vec3& point) const;

  private:
    struct Chart {
        std::vector<Index> faces;
        std::unique_ptr<SpatialTree> tree;
    };

    const Mesh& mesh_;
    const std::vector<Index>& chart_of_;
    std::vector<Chart> charts_;
};

}  // namespace lissom
