/// Normals in memory of the caller, for frames; private to the kernel and bindings/c.
#pragma once

#include <span>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Unit normal of a face, as face_normals has it.
Vec3 normal_of_face(const Mesh& mesh, Index f);

/// Writes the normals of vertex_normals into `normals`, one for each vertex. Takes no memory.
void find_vertex_normals(const Mesh& mesh, std::span<Vec3> normals);

}  // namespace lissom
