/// Triangles in place of polygons.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Splits every polygon, or those among `faces`, into triangles (triangulation.h), in place;
/// vertices stay. The triangles of a face follow each other and take its labels and attributes. If
/// nothing is to be split the mesh is left as it is, topology included; else the topology is a new
/// one, to which named regions move. If two polygons would be split along the same diagonal, or one
/// along an existing edge of the mesh, another diagonal is taken. Errors: out_of_range naming faces
/// that do not exist; nonmanifold_edge if no other diagonal is found; cancelled.
void triangulate(Mesh& mesh, const Context& context = {});
void triangulate(Mesh& mesh, std::span<const Index> faces, const Context& context = {});

}  // namespace lissom
