/// Texture coordinates of roots; private to kernel/hair.
#pragma once

#include <span>
#include <vector>

#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the attribute "uv" of the head at the roots, which are those of this mesh. A head
/// without it gives the direction of each root from the center of the scalp's frame: azimuth and
/// elevation, 0 to 1 each, with the seam behind.
std::vector<Eigen::Vector2f> root_uvs(const Mesh& head, const Scalp& scalp,
                                      std::span<const Root> roots);

}  // namespace lissom
