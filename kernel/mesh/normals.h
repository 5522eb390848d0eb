/// Custom normals of a mesh while its shape changes; private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/mesh/mesh.h"

namespace lissom {

/// Turns the "normal" attribute of a mesh with its surface. Make it before the change of positions,
/// call `follow` after: each custom normal is rotated as the vertex's own normal was, by the
/// smallest rotation. Costs nothing where there is no such attribute.
class NormalCarrier {
  public:
    explicit NormalCarrier(const Mesh& mesh);
    void follow(Mesh& mesh) const;

  private:
    std::vector<Vec3> before_;
};

/// Multiplies every custom normal by `map` and makes it unit again.
void map_normals(Mesh& mesh, const Mat3& map);

/// Turns every custom normal the other way.
void negate_normals(Mesh& mesh);

}  // namespace lissom
