/// Files beside an OBJ file that define its materials; private to kernel/io.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A file that is written together with another.
struct SideFile {
    std::filesystem::path path;
    std::string bytes;
};

/// Library files that define the materials of an OBJ file.
struct MaterialFiles {
    /// Names for "mtllib", relative to the OBJ file.
    std::vector<std::string> libraries;
    /// Files to write beside it: textures, then the library.
    std::vector<SideFile> files;
    /// Whether `files` has the materials of the mesh's asset.
    bool holds_asset = false;
};

/// Returns the library files for the materials of `mesh` if it is saved as the OBJ file `path`: the
/// libraries that it names, if they lie beside the file and say the same; else one that is called
/// as the file, with the textures that they use, a file that exists with another content never
/// being replaced by a texture. Warnings of the log name materials without a definition, and
/// contents that MTL cannot hold. Errors: file_too_large; memory_limit; cancelled.
MaterialFiles material_files(const Mesh& mesh, const std::filesystem::path& path,
                             const Context& context);

}  // namespace lissom
