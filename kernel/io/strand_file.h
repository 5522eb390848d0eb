/// Hair files: loading and saving strands by extension. .hair (Cem Yuksel), .data (HairSalon,
/// HairNet), .usda (BasisCurves), .tfx (TressFX), .ply (points and edges, as HairStep's), .glb and
/// .gltf (lines) are read and written; .rib (a scene for RenderMan) and .obj (lines) are written.
/// Each format has a file of its own, which documents its contents.
///
/// In the kernel hair is in metres, y up, widths are diameters. Strands are checked before they are
/// written: the report names the findings, the changes for the file, and the omissions; so does the
/// Context's log.
///
/// All functions may throw, besides their own errors: cancelled, memory_limit. Messages begin with
/// the file's path, and with the line if there is one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/hair/rib_options.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/strand_report.h"

namespace lissom {

/// Reads strands; the extension, in any case, names the format. Files are read within memory and
/// time in proportion to their size. Errors: unknown_format; file_not_found, file_is_directory,
/// file_empty, file_unreadable; file_syntax, file_truncated, file_too_large, unsupported;
/// not_finite; invalid_argument for a bad unit. If they concern a strand, its number is among their
/// elements.
Strands load_strands(const std::filesystem::path& path, const StrandLoadOptions& options = {},
                     const Context& context = {});

/// Checks strands and writes them, whole or not at all; the extension, in any case, names the
/// format. The strands stay as they are. Errors: unknown_format; file_write_failed,
/// file_is_directory; file_too_large if the format cannot count as many; not_finite if values
/// exceed the range of 32-bit numbers; invalid_argument for a bad unit, and, with mend false, for
/// each needed change.
StrandReport save_strands(const Strands& strands, const std::filesystem::path& path,
                          const StrandSaveOptions& options = {}, const Context& context = {});

/// Saves as `save_strands` does to a .rib file, with this scene. Errors: also invalid_argument for
/// another extension, an archive with head or camera, or a scene out of range.
StrandReport save_rib(const Strands& strands, const std::filesystem::path& path,
                      const RibScene& scene, const StrandSaveOptions& options = {},
                      const Context& context = {});

/// Loads as `load_strands` does, from the content of a file in memory. `extension` as in
/// `readable_strand_extensions`.
Strands decode_strands(std::string_view bytes, std::string_view extension,
                       const StrandLoadOptions& options = {}, const Context& context = {});

/// The content of a file and the report of its check.
struct EncodedStrands {
    std::string bytes;
    StrandReport report;
};

/// Saves as `save_strands` does, into memory. `extension` as in `writable_strand_extensions`.
EncodedStrands encode_strands(const Strands& strands, std::string_view extension,
                              const StrandSaveOptions& options = {}, const Context& context = {});

/// Saves as `save_rib` does, into memory.
EncodedStrands encode_rib(const Strands& strands, const RibScene& scene,
                          const StrandSaveOptions& options = {}, const Context& context = {});

/// Extensions that `load_strands` knows: lower case, without the dot.
const std::vector<std::string>& readable_strand_extensions();

/// Extensions that `save_strands` knows: lower case, without the dot.
const std::vector<std::string>& writable_strand_extensions();

}  // namespace lissom
