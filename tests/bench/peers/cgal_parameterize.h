/// CGAL's least-squares conformal maps on our meshes, as a rival for the benchmark of pasting.
#pragma once

#include <memory>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"

namespace lissom::bench {

/// A triangle mesh with one boundary.
class CgalParameterizer {
  public:
    explicit CgalParameterizer(const Mesh& mesh);
    ~CgalParameterizer();

    /// Lays the mesh out with two vertices pinned, as CGAL does by default.
    std::vector<Vec2> lay_out();

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace lissom::bench
