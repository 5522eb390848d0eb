/// Mesh files: loading and saving by extension. OBJ, PLY, OFF, STL and glTF 2.0 (.gltf, .glb); each
/// format has a file of its own, which documents its contents.
///
/// Meshes are checked and repaired when read (repair.h); the mesh's report() names the changes, and
/// so does the Context's log. A warning of the log names contents lost in a format when a mesh is
/// saved.
///
/// All functions may throw, besides their own errors: cancelled, memory_limit. Messages begin with
/// the file's path, and with the line if there is one: "cup.obj:12: ...". The ids of an error with
/// ElementKind::line are 0-based as all ids.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/io/record/options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Result of saving a mesh.
struct SavedFile {
    /// The point of the mesh that is the origin of the file. Zero but for FileOrigin::automatic.
    Vec3 origin = Vec3::Zero();
};

/// Reads a mesh; the extension, in any case, names the format. A byte order mark is passed over.
/// Other files that a glTF or OBJ file refers to are read from its own folder and nowhere else.
/// Errors: unknown_format; file_not_found, file_is_directory, file_empty, file_unreadable;
/// file_syntax (also if the content is of another format than the extension says), file_truncated,
/// file_too_large, face_index, unsupported, unsafe_path; not_finite; without options.repair those
/// of `repair`; invalid_argument for a bad unit.
Mesh load_mesh(const std::filesystem::path& path, const LoadOptions& options = {},
               const Context& context = {});

/// Writes a mesh, whole or not at all; the extension, in any case, names the format. Errors:
/// unknown_format; file_write_failed, file_is_directory; not_finite if positions exceed the
/// format's number range; unsupported if its 32-bit numbers (glTF, binary STL) would join vertices
/// that it does not number or flatten more than one face in a thousand, and for points alone as
/// STL; invalid_argument for a bad unit or attributes that do not fit the mesh.
SavedFile save_mesh(const Mesh& mesh, const std::filesystem::path& path,
                    const SaveOptions& options = {}, const Context& context = {});

/// Loads as `load_mesh` does, from the content of a file in memory, which can refer to no other.
/// `extension` as in `readable_extensions`.
Mesh decode_mesh(std::string_view bytes, std::string_view extension,
                 const LoadOptions& options = {}, const Context& context = {});

/// Saves as `save_mesh` does, into memory. `extension` as in `writable_extensions`.
std::string encode_mesh(const Mesh& mesh, std::string_view extension,
                        const SaveOptions& options = {}, const Context& context = {});

/// Extensions that `load_mesh` knows: lower case, without the dot.
const std::vector<std::string>& readable_extensions();

/// Extensions that `save_mesh` knows: lower case, without the dot.
const std::vector<std::string>& writable_extensions();

/// Logs the findings of a repair: changes are warnings, and so is a mesh that is wholly inside out,
/// which has a message; closed seams and poor faces are not.
void log_findings(const Report& report, const Context& context);

}  // namespace lissom
