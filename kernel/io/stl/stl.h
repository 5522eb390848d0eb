/// STL; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/saved_parts.h"

namespace lissom {

/// Reads text and binary; which of them is told by the size, for binary files may begin with
/// "solid" too. Each triangle has three vertices of its own (MeshData::faces_are_separate). The
/// names of solids in text are face labels "object"; normals and attribute bytes are skipped. If a
/// binary header announces no triangles, or the largest number, the triangles after it are read,
/// with a warning of the log. Errors: file_syntax, file_truncated, file_too_large, cancelled.
MeshData read_stl(std::string_view bytes, const Context& context);

/// Returns true if the size of the data is exactly that of the binary STL which they would be.
bool is_binary_stl(std::string_view bytes);

/// Writes triangles (polygons are triangulated) with their normals; text has one solid for each run
/// of faces of one object. Binary has 32-bit numbers. A warning of the log counts the vertices
/// without faces, which are not written. Errors: unsupported if there are only vertices; not_finite
/// naming the vertices that are beyond the range of 32-bit numbers; unsupported if these numbers
/// would join vertices or flatten faces.
void write_stl(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context);

}  // namespace lissom
