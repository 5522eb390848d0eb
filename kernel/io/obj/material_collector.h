/// MaterialCollector: materials and textures of files beside a mesh file, kept as an asset of the
/// kind that glTF files have; private to kernel/io and not installed.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/io/gltf/asset.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/uri.h"
#include "kernel/io/obj/mtl.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// The member of a material's extras with the statements of MTL that glTF has no place for.
inline constexpr const char* kMtlExtras = "mtl";

/// Returns the media type of a PNG or JPEG picture, "" for other bytes.
std::string picture_type(std::string_view bytes);

/// Returns the relative URI of a file of this name.
std::string uri_of_name(const std::string& name);

/// Reads the files of one folder.
class MaterialCollector {
  public:
    MaterialCollector(const std::filesystem::path& folder, Report& report, const Context& context);

    /// Adds the materials of a library; the first of a name counts. Errors: file_too_large;
    /// memory_limit; cancelled.
    void add_library(const std::string& file_name);
    /// Adds a material, whose textures are read.
    void add(const MtlMaterial& material);

    /// Returns the materials, or null if there are none.
    std::shared_ptr<const GltfAsset> asset() const;

  private:
    SharedBytes find(const std::string& name);
    void add_emission(const MtlMaterial& material, Json& json);
    int texture(const std::string& name);

    GltfFolder folder_;
    Report& report_;
    std::shared_ptr<GltfAsset> asset_;
    std::map<std::string, int> texture_of_name_;
};

/// Reads the libraries that `data` names from the folder of the file, and keeps their materials as
/// an asset of `data`, so that formats which describe materials can save them. Kd and d become the
/// base colour, or map_Kd its texture; Ke and map_Ke emission; norm the normal texture; Pm and
/// Pr, or Ns, metalness and roughness; other statements stay in extras. Libraries and textures that
/// are not there, or that are not inside the folder, are in the report, and so are textures that
/// are neither PNG nor JPEG. If the file has no folder nothing is read.
/// Errors: file_too_large; memory_limit; cancelled.
void read_material_libraries(const FileInput& file, MeshData& data, const Context& context);

}  // namespace lissom
