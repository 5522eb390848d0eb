/// Hair as lines of glTF 2.0; private to kernel/io and not installed.
#pragma once

#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/record/file_hair.h"

namespace lissom {

/// Numbers of strands are in the extras of their mesh, each with the accessor of its values; glTF
/// demands floats or 16 bits of the attributes of points:
///
///     "lissom_strands": {"count": 20000, "face": 3, "weights": 4, "vertices": 5, "id": 6,
///                        "guide": 7, "guide_arc": 8, "group": 9, "group_names": ["fringe"],
///                        "comment": ""}
///
/// 2^32 - 1 is no face, guide or group.
inline constexpr const char* kStrandTables = "lissom_strands";

/// Reads the lines and line strips of the default scene, with node transforms applied: COLOR_0,
/// "_WIDTH" (metres), "_TRANSPARENCY" (else the alpha of COLOR_0), "_ROOT_UV" of the first point.
/// Closed strips are read as open ones. Lines of several nodes are groups of their names. Numbers
/// of strands, if the file has one primitive of lines that has as many. Primitives that are none
/// are left out, with a warning of the log. Errors: as read_gltf and strands_of_links; unsupported
/// for files of other primitives alone; file_syntax for numbers that do not fit; not_finite naming
/// the strand; unsafe_path for files with others beside them.
FileHair read_gltf_strands(std::string_view bytes, const Context& context);

/// Writes one mesh "Hair" of one LINES primitive with 32-bit indices, "_WIDTH" and what else there
/// is, as a text with all data inside. Colours above 1 become 1, and profiles of widths become
/// widths of the points.
void write_gltf_strands(const Strands& strands, std::string& bytes, const Context& context);

/// Writes as `write_gltf_strands` does, as one binary file. Errors: file_too_large beyond 4 GiB.
void write_glb_strands(const Strands& strands, std::string& bytes, const Context& context);

}  // namespace lissom
