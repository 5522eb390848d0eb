#include "kernel/io/gltf/textured.h"

#include <memory>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/gltf/asset.h"

namespace lissom {
namespace {

void add_picture(GltfAsset& asset, const char* name, const std::string& png) {
    asset.json["images"].push_back({{"name", name}, {"mimeType", "image/png"}});
    asset.json["textures"].push_back(
        {{"name", name}, {"sampler", 0}, {"source", asset.images.size()}});
    asset.images.push_back(std::make_shared<const std::string>(png));
}

}  // namespace

void set_material(Mesh& mesh, const TexturedMaterial& material) {
    require(!mesh.asset(), "the mesh has materials of a file already", ErrorCode::unsupported);
    const auto asset = std::make_shared<GltfAsset>();
    // Linear, with smaller pictures; nothing repeats.
    asset->json["samplers"] = Json::array(
        {{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}});
    asset->json["images"] = Json::array();
    asset->json["textures"] = Json::array();
    add_picture(*asset, "color", material.color_png);
    Json made = {{"name", material.name},
                 {"doubleSided", true},
                 {"alphaMode", "MASK"},
                 {"alphaCutoff", material.cutoff}};
    made["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                    {"metallicFactor", 0.0},
                                    {"roughnessFactor", material.roughness}};
    if (!material.flow_png.empty()) {
        add_picture(*asset, "flow", material.flow_png);
        made["extras"] = {{"flow", 1}};
    }
    if (material.anisotropy > 0.0) {
        made["extensions"]["KHR_materials_anisotropy"] = {
            {"anisotropyStrength", material.anisotropy}};
    }
    asset->json["materials"] = Json::array({std::move(made)});
    asset->material_of_label[material.name] = 0;
    mesh.set_asset(asset);
}

}  // namespace lissom
