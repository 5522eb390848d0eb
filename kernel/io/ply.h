/// Stanford PLY; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/io/mesh_data.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/saved_parts.h"

namespace lissom {

/// Reads text and binary of both byte orders. Of the element "vertex": x y z in any number type,
/// nx ny nz as "normal", red green blue [alpha] as "color" (integers scaled to 0..1), s t, u v or
/// texture_u texture_v as "uv"; of "face": vertex_indices or vertex_index, the list texcoord as
/// corner attribute "uv", red green blue [alpha] as "color" and nx ny nz as "normal" ("face_color"
/// and "face_normal" where the vertices have such); of "tristrips": vertex_indices. Other numbers
/// of vertices and faces are attributes of their name; consecutive names ending in _0, _1, ... are
/// one of that width. Other lists and elements are skipped and named in the log. Numbers in text
/// keep all their digits, whatever type the header gives them. Errors: file_syntax, file_truncated,
/// file_too_large, face_index, cancelled.
MeshData read_ply(std::string_view bytes, const Context& context);

/// Writes what `read_ply` reads. Positions are "float" where each coordinate is exactly a 32-bit
/// number, as in a file that was read with such, and "double" otherwise, so that nothing is lost.
/// Attributes have the type that they remember, or double where that is an integer that cannot hold
/// their values.
void write_ply(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context);

}  // namespace lissom
