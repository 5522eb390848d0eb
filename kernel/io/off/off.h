/// Geomview's OFF; private to kernel/io.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/saved_parts.h"

namespace lissom {

/// Reads OFF, NOFF (normals: vertex attribute "normal"), COFF (colours: vertex attribute "color"),
/// STOFF (texture coordinates: vertex attribute "uv") and their combinations, and colours of faces
/// (face attribute "color", or "face_color" if the vertices have colours too). The keyword may be
/// absent, and so may the number of edges. A vertex and a face are a line each, or lines mean
/// nothing and the counts of the header delimit them; data that are neither, or that go on after
/// the last face with more than the edges, are refused. Colours are bytes if all in the file are
/// whole numbers and one is above 1, else they are between 0 and 1. A plain OFF with three or four
/// numbers more a vertex has colours. Indices into a colour map and lists of edges are skipped and
/// counted in the report. Binary data are Geomview's (big endian) or, with the same keyword, little
/// endian and without colours of faces, as some libraries write them. Errors: file_syntax,
/// file_truncated, file_too_large, face_index, cancelled; unsupported for points of other than
/// three coordinates (4OFF, nOFF).
MeshData read_off(std::string_view bytes, const Context& context);

/// Writes text with the vertex attributes "uv" (width 2), "normal" (3) and "color" (3 or 4), and
/// with colours of faces.
void write_off(SavedParts& parts, const SaveOptions& options, std::string& text,
               const Context& context);

}  // namespace lissom
