/// Wavefront OBJ; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/io/mesh_data.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/saved_parts.h"

namespace lissom {

/// Reads polygons with their texture coordinates (corner attribute "uv"), normals (corner attribute
/// "normal"), the colours of vertices (vertex attribute "color") and the names of objects, groups,
/// materials and smoothing groups (face labels). Several group names on one line are one label.
/// Values that an element lacks are NaN. Colours are bytes where all in the file are whole numbers
/// and one is above 1, and else fractions. Weights, third texture coordinates, points, lines,
/// free-form geometry and unknown statements are skipped and counted in the log. A comment starts
/// at a '#' where a statement or a number could; in names it is a character as any. Errors:
/// file_syntax, face_index, file_too_large, cancelled.
MeshData read_obj(std::string_view text, const Context& context);

/// Writes all that `read_obj` reads. Attributes "uv" and "normal" may be of vertices or of corners.
void write_obj(SavedParts& parts, const SaveOptions& options, std::string& text,
               const Context& context);

}  // namespace lissom
