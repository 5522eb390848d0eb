#include "kernel/io/obj/material_collector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/io/record/file_rules.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

// A Blinn-Phong lobe of exponent n is about as wide as one of this roughness (Karis 2013).
double roughness_of(const MtlMaterial& m) {
    if (m.roughness) return *m.roughness;
    return m.shininess ? std::pow(2.0 / (std::max(*m.shininess, 0.0) + 2.0), 0.25) : 1.0;
}

}  // namespace

std::string picture_type(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    return bytes.starts_with("\xff\xd8\xff") ? "image/jpeg" : "";
}

std::string uri_of_name(const std::string& name) {
    std::string uri;
    for (const char c : name) uri += c == '%' ? "%25" : std::string(1, c);
    return uri;
}

MaterialCollector::MaterialCollector(const std::filesystem::path& folder, Report& report,
                                     const Context& context)
    : folder_(folder, context), report_(report), asset_(std::make_shared<GltfAsset>()) {
    asset_->from_libraries = true;
}

void MaterialCollector::add_library(const std::string& file_name) {
    const SharedBytes content = find(file_name);
    if (!content) return;
    for (const MtlMaterial& material : read_mtl(without_byte_order_mark(*content))) add(material);
}

std::shared_ptr<const GltfAsset> MaterialCollector::asset() const {
    return asset_->material_of_label.empty() ? nullptr : asset_;
}

// The content of a file in the folder; null, with a finding, if it is not there.
SharedBytes MaterialCollector::find(const std::string& name) {
    SharedBytes content;
    std::string why;
    try {
        content = folder_.read_if_there(uri_of_name(name));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::unsafe_path) throw;
        why = " (outside the folder of the file)";
    }
    if (!content) report_.add(FindingKind::files_missing, 1, in_quotes(name) + why);
    return content;
}

void MaterialCollector::add(const MtlMaterial& m) {
    Json& materials = asset_->json["materials"];
    if (!asset_->material_of_label.emplace(m.name, materials.size()).second) return;
    Json surface =
        json_object({{"metallicFactor", m.metalness}, {"roughnessFactor", roughness_of(m)}});
    const int diffuse = texture(m.diffuse_map);
    // The colour of a material with a texture is a stand-in for programs that show none.
    const std::array<double, 3> color =
        diffuse < 0 ? m.diffuse : std::array<double, 3>{1.0, 1.0, 1.0};
    surface["baseColorFactor"] = {color[0], color[1], color[2], m.opacity};
    if (diffuse >= 0) surface["baseColorTexture"] = json_object({{"index", diffuse}});
    Json json = json_object({{"name", m.name}, {"pbrMetallicRoughness", std::move(surface)}});
    if (m.opacity < 1.0) json["alphaMode"] = "BLEND";
    add_emission(m, json);
    if (const int normal = texture(m.normal_map); normal >= 0)
        json["normalTexture"] = json_object({{"index", normal}});
    if (!m.others.empty()) json["extras"][kMtlExtras] = m.others;
    materials.push_back(std::move(json));
}

void MaterialCollector::add_emission(const MtlMaterial& m, Json& json) {
    const int map = texture(m.emissive_map);
    if (map >= 0) json["emissiveTexture"] = json_object({{"index", map}});
    const bool shines = m.emissive != std::array<double, 3>{};
    if (shines || map >= 0)
        json["emissiveFactor"] = shines ? m.emissive : std::array<double, 3>{1.0, 1.0, 1.0};
}

// The number of the texture, or -1 if there is none that can be kept.
int MaterialCollector::texture(const std::string& name) {
    if (name.empty()) return -1;
    const auto [entry, is_new] = texture_of_name_.emplace(name, -1);
    if (!is_new) return entry->second;
    const SharedBytes content = find(name);
    if (!content) return -1;
    const std::string type = picture_type(*content);
    if (type.empty()) {
        report_.add(FindingKind::content_skipped, 1,
                    "texture " + in_quotes(name) + ", which is neither PNG nor JPEG");
        return -1;
    }
    Json& images = asset_->json["images"];
    Json& textures = asset_->json["textures"];
    textures.push_back(json_object({{"source", images.size()}}));
    images.push_back(json_object({{"name", name}, {"mimeType", type}}));
    asset_->images.push_back(content);
    return entry->second = count_of(textures) - 1;
}

void read_material_libraries(const FileInput& file, MeshData& data, const Context& context) {
    if (file.folder.empty()) return;
    MaterialCollector collector(file.folder, data.report, context);
    for (const std::string& name : data.material_libraries) {
        context.checkpoint();
        collector.add_library(name);
    }
    data.asset = collector.asset();
}

}  // namespace lissom
