/// Pictures that a PLY file names in its comments; private to kernel/io.
#pragma once

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"

namespace lissom {

/// Keeps the pictures of "comment TextureFile" as materials of that name: a face has the one that
/// its number "texnumber" counts, from 0, or the first. Pictures are read from the folder of the
/// file and nowhere else; the report names missing ones. Files without faces, or with materials of
/// their own, stay as they are. Errors: file_too_large; memory_limit; cancelled.
void read_ply_textures(const FileInput& file, MeshData& data, const Context& context);

}  // namespace lissom
