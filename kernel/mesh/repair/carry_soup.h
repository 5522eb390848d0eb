/// From repaired faces to a mesh with everything that the soup held; private to kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/corner_faces.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/repair/welding.h"
#include "kernel/mesh/soup.h"

namespace lissom {

/// Errors: invalid_argument if an attribute, a list of labels or a region does not fit.
void require_attributes_fit(const Soup& soup);

/// Returns the mesh of the faces of `work` on the vertices of `fans`. `file_corners` are the
/// vertices at the corners of the file; `twin` pairs the corners of `work`. A vertex attribute
/// whose values differ at one vertex becomes one of corners, except that joints and weights of a
/// skin stay those of the first.
Mesh carry_soup(Soup soup, std::span<const Index> file_corners, CornerFaces work, FanVertices fans,
                const std::vector<Index>& twin, const Context& context);

}  // namespace lissom
