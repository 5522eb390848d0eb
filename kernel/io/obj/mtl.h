/// Material libraries of OBJ files (MTL); private to kernel/io.
#pragma once

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"

namespace lissom {

/// Reads the libraries that `data` names from the folder of the file, and keeps their materials as
/// an asset of `data`, so that formats which describe materials can save them. Kd and d become the
/// base colour, or map_Kd its texture; Ke and map_Ke what shines; norm the normal texture; Pm and
/// Pr, or Ns, metalness and roughness. Libraries and textures that are not there, or that are not
/// inside the folder, are in the report, and so are textures that are neither PNG nor JPEG. Where
/// the file has no folder nothing is read.
/// Errors: file_too_large; memory_limit; cancelled.
void read_material_libraries(const FileInput& file, MeshData& data, const Context& context);

}  // namespace lissom
