/// Stanford PLY; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/saved_parts.h"

namespace lissom {

/// Reads text and binary of both byte orders. Known properties are, of the element "vertex": x y z
/// in any number type, nx ny nz as "normal", red green blue [alpha], r g b [a] or diffuse_red ...
/// as "color" (integers scaled to 0..1), s t, u v or texture_u texture_v as "uv", texture_u2
/// texture_v2 as "uv2" and so on, bytes region_<name> as regions; of "face": vertex_indices or
/// vertex_index, the lists texcoord, texcoord2, ... as corner attributes "uv", "uv2", ..., lists
/// corner_<width>_<name> as other attributes of corners, red green blue [alpha] as "color" and nx
/// ny nz as "normal" ("face_color" and "face_normal" if the vertices have such); of "tristrips":
/// vertex_indices. Face labels and material files are in comments of the header, see PlyHeader; for
/// the pictures that others name there see read_ply_textures. Other numbers of vertices and faces
/// are attributes of their name, see PlyLayout. Any other content is skipped and named in the
/// report; so are infinite values of attributes. Numbers in text keep all their digits, for any
/// type in the header. Errors: file_syntax, file_truncated, file_too_large, face_index, cancelled.
MeshData read_ply(std::string_view bytes, const Context& context);

/// Writes the data that `read_ply` reads: all of a mesh but its asset. Positions are "float" if
/// each coordinate is exactly a 32-bit number, as in a file that was read with such, and "double"
/// otherwise, so that nothing is lost. Attributes have the type that they remember, or double if
/// that is an integer that cannot hold their values.
void write_ply(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context);

}  // namespace lissom
