/// Wavefront OBJ; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/saved_parts.h"

namespace lissom {

/// A group of this prefix and a name, percent-encoded, whose elements are points holds the vertices
/// of the region of that name: "g region:left%20hand", "p 1 2 3". Such a group labels no faces.
inline constexpr std::string_view kObjRegionPrefix = "region:";

/// Reads polygons with their texture coordinates (corner attribute "uv"), normals (corner attribute
/// "normal"), the colours of vertices (vertex attribute "color"), the names of objects, groups,
/// materials and smoothing groups (face labels) and regions. Several group names on one line are
/// one label. Colours are bytes if all in the file are whole numbers and one is above 1, and else
/// fractions; without any, those of comments "#MRGB" count (see polypaint.h). Values that an
/// element lacks are NaN, and so are those that are not finite and those of corners that refer to
/// texture coordinates or normals which do not exist: the report counts these. Weights, third
/// texture coordinates, other points, lines, free-form geometry and unknown statements are skipped
/// and counted in the report. A comment starts at a '#' in place of a statement or a number; in
/// names it is a character as any. Errors: file_syntax, face_index, file_too_large, cancelled.
MeshData read_obj(std::string_view text, const Context& context);

/// Writes all that `read_obj` reads. Attributes "uv" and "normal" may be of vertices or of corners;
/// other sets of texture coordinates have no place in the format.
void write_obj(SavedParts& parts, const SaveOptions& options, std::string& text,
               const Context& context);

}  // namespace lissom
