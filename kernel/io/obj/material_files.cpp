#include "kernel/io/obj/material_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "kernel/io/gltf/asset.h"
#include "kernel/io/obj/material_collector.h"
#include "kernel/io/obj/mtl.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/percent.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

namespace fs = std::filesystem;

// Pictures of any content and size are read; no other files are requested.
SharedBytes content_beside(GltfFolder& folder, const std::string& name) {
    if (name.empty()) return nullptr;
    try {
        return folder.read_if_there(uri_of_name(name));
    } catch (const Error& error) {
        const ErrorCode code = error.code();
        if (code == ErrorCode::cancelled || code == ErrorCode::memory_limit) throw;
        return nullptr;
    }
}

// ---- Values of a material's JSON, which may come from anywhere ----

double number_in(const Json* value, double fallback) {
    const bool is_number = value && value->is_number();
    return is_number && std::isfinite(value->get<double>()) ? value->get<double>() : fallback;
}

std::array<double, 3> color_in(const Json* list, double fallback) {
    std::array<double, 3> color{fallback, fallback, fallback};
    if (!list || !list->is_array()) return color;
    for (std::size_t i = 0; i < std::min<std::size_t>(3, list->size()); ++i) {
        color[i] = number_in(&(*list)[i], fallback);
    }
    return color;
}

// The number of an element of the array `list` that `json` refers to by `key`, or -1.
int reference_in(const Json* json, const char* key, const Json* list) {
    const Json* number = json ? member(*json, key) : nullptr;
    if (!number || !number->is_number_integer() || !list || !list->is_array()) return -1;
    const auto value = number->get<std::int64_t>();
    return value >= 0 && value < std::ssize(*list) ? static_cast<int>(value) : -1;
}

// The number of the image of a texture, or -1.
int image_of_texture(const GltfAsset& asset, const Json* texture_info) {
    const Json* textures = member(asset.json, "textures");
    const int texture = reference_in(texture_info, "index", textures);
    if (texture < 0) return -1;
    const int image = reference_in(&(*textures)[static_cast<std::size_t>(texture)], "source",
                                   member(asset.json, "images"));
    return image >= 0 && at(image) < asset.images.size() ? image : -1;
}

const Json* material_called(const GltfAsset* asset, const std::string& label) {
    if (!asset) return nullptr;
    const auto found = asset->material_of_label.find(label);
    const Json* materials = member(asset->json, "materials");
    if (found == asset->material_of_label.end() || !materials) return nullptr;
    return found->second < materials->size() ? &(*materials)[found->second] : nullptr;
}

// A material with the content of its textures in place of their numbers.
Json with_pictures(const GltfAsset& asset, Json material) {
    material.erase("name");
    for_each_object(material, [&](Json& object) {
        if (!object.contains("index")) return;
        const int image = image_of_texture(asset, &object);
        const SharedBytes bytes =
            image < 0 ? nullptr : asset.images[static_cast<std::size_t>(image)];
        object["index"] = bytes ? std::to_string(std::hash<std::string>()(*bytes)) : "";
    });
    return material;
}

// ---- Names of textures ----

std::string extension_of_type(const std::string& type) {
    return type == "image/png" ? ".png" : type == "image/jpeg" ? ".jpg" : "";
}

// The last part of a name, of characters that every system takes.
std::string plain_file_name(std::string_view name) {
    const std::size_t slash = name.find_last_of("/\\");
    if (slash != std::string_view::npos) name.remove_prefix(slash + 1);
    std::string plain(name);
    for (char& c : plain) {
        const bool is_plain = static_cast<unsigned char>(c) >= 0x80 || c == '.' || c == '-' ||
                              c == '_' || c == ' ' || (c >= '0' && c <= '9') ||
                              (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (!is_plain) c = '_';
    }
    constexpr std::size_t kLongest = 100;
    const std::size_t first = plain.find_first_not_of(" .-");
    return first == std::string::npos ? "" : plain.substr(first, kLongest);
}

bool has_extension(const std::string& name, const std::string& type) {
    const std::string extension = fs::path(name).extension().string();
    if (type == "image/png") return extension == ".png" || extension == ".PNG";
    return extension == ".jpg" || extension == ".jpeg" || extension == ".JPG" ||
           extension == ".JPEG";
}

// Gives the pictures of assets names beside a file.
class TextureNames {
  public:
    TextureNames(const fs::path& path, GltfFolder& folder)
        : folder_path_(path.parent_path()), stem_(display_name(path.stem())), folder_(folder) {}

    // The name of a file with this picture, or "" if MTL cannot use it.
    std::string name_of(const GltfAsset& asset, int image) {
        const auto number = static_cast<std::size_t>(image);
        const SharedBytes bytes = asset.images[number];
        const std::string type = bytes ? picture_type(*bytes) : "";
        if (type.empty()) return "";
        const auto known = name_of_bytes_.find(bytes.get());
        if (known != name_of_bytes_.end()) return known->second;
        return name_of_bytes_[bytes.get()] =
                   place(wanted_name(asset.json["images"][number]), type, bytes);
    }
    std::vector<SideFile> take_files() { return std::move(files_); }

  private:
    static std::string wanted_name(const Json& image) {
        const std::string name = text_member(image, "name");
        return name.empty() ? text_member(image, "uri") : name;
    }

    std::string place(const std::string& wanted, const std::string& type,
                      const SharedBytes& bytes) {
        const SharedBytes there = content_beside(folder_, wanted);
        if (there && *there == *bytes) return wanted;
        std::string stem = plain_file_name(wanted);
        if (stem.empty()) stem = plain_file_name(stem_ + " texture");
        std::string extension = extension_of_type(type);
        if (has_extension(stem, type)) {
            extension = fs::path(stem).extension().string();
            stem.resize(stem.size() - extension.size());
        }
        for (int i = 1;; ++i) {
            const std::string name = stem + (i == 1 ? "" : " " + std::to_string(i)) + extension;
            if (take_name(name, bytes)) return name;
        }
    }

    // False if another picture has the name.
    bool take_name(const std::string& name, const SharedBytes& bytes) {
        if (const SharedBytes there = content_beside(folder_, name)) return *there == *bytes;
        std::error_code error;
        const fs::path path = folder_path_ / fs::path(std::u8string(name.begin(), name.end()));
        if (fs::exists(path, error) || !taken_.insert(name).second) return false;
        files_.push_back({path, *bytes});
        return true;
    }

    fs::path folder_path_;
    std::string stem_;
    GltfFolder& folder_;
    std::map<const std::string*, std::string> name_of_bytes_;
    std::set<std::string> taken_;
    std::vector<SideFile> files_;
};

// ---- Materials ----

// The exponent of the lobe that is about as wide; see MaterialCollector.
double exponent_of(double roughness) {
    constexpr double kLargest = 1000.0;
    const double fourth = std::pow(std::max(roughness, 0.0), 4.0);
    return fourth <= 2.0 / (kLargest + 2.0) ? kLargest : std::max(0.0, 2.0 / fourth - 2.0);
}

std::vector<std::string> other_statements(const Json& material, GltfFolder& folder,
                                          std::set<std::string>& lost) {
    std::vector<std::string> kept;
    const Json* extras = member(material, "extras");
    const Json* list = extras ? member(*extras, kMtlExtras) : nullptr;
    if (!list || !list->is_array()) return kept;
    for (const Json& item : *list) {
        if (!item.is_string()) continue;
        const auto line = item.get<std::string>();
        if (!is_other_mtl_statement(line)) continue;
        const bool is_there =
            !names_file(line) || content_beside(folder, line.substr(line.find_last_of(' ') + 1));
        if (is_there) {
            kept.push_back(line);
        } else {
            lost.insert(in_quotes(line));
        }
    }
    return kept;
}

// Members of glTF materials that MTL has no place for.
void note_lost_members(const Json& material, std::set<std::string>& lost) {
    const Json* surface = member(material, "pbrMetallicRoughness");
    if (surface && surface->contains("metallicRoughnessTexture"))
        lost.insert("textures of metalness and roughness");
    if (material.contains("occlusionTexture")) lost.insert("occlusion");
    if (text_member(material, "alphaMode") == "MASK") lost.insert("alpha cut-off");
    if (const Json* extensions = member(material, "extensions");
        extensions && extensions->is_object()) {
        for (const auto& extension : extensions->items()) lost.insert(in_quotes(extension.key()));
    }
}

class LibraryWriter {
  public:
    LibraryWriter(const fs::path& path, GltfFolder& folder)
        : folder_(folder), textures_(path, folder) {}

    void add(const std::string& label, const GltfAsset& asset, const Json& material) {
        if (text_.empty()) text_ = "# Written by Lissom\n";
        write_mtl(mtl_of(label, asset, material), text_);
        note_lost_members(material, lost_);
    }

    bool empty() const { return text_.empty(); }
    std::string take_text() { return std::move(text_); }
    std::vector<SideFile> take_textures() { return textures_.take_files(); }
    const std::set<std::string>& lost() const { return lost_; }

  private:
    MtlMaterial mtl_of(const std::string& label, const GltfAsset& asset, const Json& material) {
        const Json none = Json::object();
        const Json* found = member(material, "pbrMetallicRoughness");
        const Json& surface = found ? *found : none;
        MtlMaterial m;
        m.name = label;
        const Json* base = member(surface, "baseColorFactor");
        m.diffuse = color_in(base, 1.0);
        const bool has_alpha = base && base->is_array() && base->size() > 3;
        if (has_alpha && text_member(material, "alphaMode") == "BLEND") {
            m.opacity = std::clamp(number_in(&(*base)[3], 1.0), 0.0, 1.0);
        }
        m.emissive = color_in(member(material, "emissiveFactor"), 0.0);
        m.metalness = number_in(member(surface, "metallicFactor"), 1.0);
        m.roughness = number_in(member(surface, "roughnessFactor"), 1.0);
        m.shininess = exponent_of(*m.roughness);
        m.diffuse_map = file_of(asset, member(surface, "baseColorTexture"));
        m.emissive_map = file_of(asset, member(material, "emissiveTexture"));
        m.normal_map = file_of(asset, member(material, "normalTexture"));
        m.others = other_statements(material, folder_, lost_);
        return m;
    }

    // A picture that was not found keeps its name.
    std::string file_of(const GltfAsset& asset, const Json* texture_info) {
        if (!texture_info) return "";
        const int image = image_of_texture(asset, texture_info);
        if (image >= 0 && !asset.images[at(image)]) return name_of_missing(asset, image);
        std::string name = image < 0 ? "" : textures_.name_of(asset, image);
        if (name.empty()) lost_.insert("textures that are neither PNG nor JPEG");
        return name;
    }

    static std::string name_of_missing(const GltfAsset& asset, int image) {
        std::string name = percent_decoded(text_member(asset.json["images"][at(image)], "uri"));
        std::replace(name.begin(), name.end(), '\\', '/');
        return name;
    }

    GltfFolder& folder_;
    TextureNames textures_;
    std::string text_;
    std::set<std::string> lost_;
};

// Names of the materials that faces have, in the order of the labels.
std::vector<std::string> used_materials(const Mesh& mesh) {
    const auto found = mesh.attributes().labels().find("material");
    if (found == mesh.attributes().labels().end()) return {};
    const FaceLabels& labels = found->second;
    std::vector<char> used(labels.names.size(), 0);
    for (const Index label : labels.of_face) {
        if (label >= 0 && at(label) < used.size()) used[at(label)] = 1;
    }
    std::vector<std::string> names;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] && seen.insert(labels.names[i]).second) names.push_back(labels.names[i]);
    }
    return names;
}

std::string first_names(const std::vector<std::string>& names) {
    constexpr std::size_t kShown = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i) {
        text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
    }
    return text + (names.size() > kShown ? ", ..." : "");
}

// Decides the library files that define the materials of one OBJ file.
class Planner {
  public:
    Planner(const Mesh& mesh, const fs::path& path, const Context& context)
        : mesh_(mesh),
          path_(path),
          context_(context),
          folder_path_(path.has_parent_path() ? path.parent_path() : fs::path(".")),
          folder_(folder_path_, context),
          asset_(dynamic_cast<const GltfAsset*>(mesh.asset().get())) {}

    MaterialFiles plan() {
        find_libraries();
        const std::vector<std::string> names = used_materials(mesh_);
        const bool are_defined =
            std::all_of(names.begin(), names.end(),
                        [&](const std::string& name) { return is_defined_there(name); });
        if (!are_defined) define(names);
        return std::move(result_);
    }

  private:
    // The libraries that lie beside the file.
    void find_libraries() {
        Report ignored;
        MaterialCollector collector(folder_path_, ignored, context_);
        for (const std::string& name : mesh_.material_libraries()) {
            if (!content_beside(folder_, name)) continue;
            result_.libraries.push_back(name);
            collector.add_library(name);
        }
        there_ = collector.asset();
    }

    bool is_defined_there(const std::string& name) const {
        const Json* there = material_called(there_.get(), name);
        const Json* known = material_called(asset_, name);
        if (!there || !known) return there != nullptr;
        return with_pictures(*there_, *there) == with_pictures(*asset_, *known);
    }

    void define(const std::vector<std::string>& names) {
        LibraryWriter writer(path_, folder_);
        std::vector<std::string> undefined;
        for (const std::string& name : names) {
            context_.checkpoint();
            if (const Json* known = material_called(asset_, name)) {
                writer.add(name, *asset_, *known);
                result_.holds_asset = true;
            } else if (const Json* there = material_called(there_.get(), name)) {
                writer.add(name, *there_, *there);
            } else {
                undefined.push_back(name);
            }
        }
        if (!writer.empty()) add_library(writer);
        tell(undefined, writer.lost());
    }

    void add_library(LibraryWriter& writer) {
        const fs::path library = fs::path(path_).replace_extension(".mtl");
        result_.libraries = {display_name(library.filename())};
        result_.files = writer.take_textures();
        result_.files.push_back({library, writer.take_text()});
    }

    void tell(const std::vector<std::string>& undefined, const std::set<std::string>& lost) const {
        if (!undefined.empty()) {
            context_.log(LogLevel::warning,
                         "no file defines the materials " + first_names(undefined) +
                             "; programs will show them in a colour of their own");
        }
        if (lost.empty()) return;
        std::string text = "of the materials these were not saved, because MTL cannot hold them: ";
        bool is_first = true;
        for (const std::string& what : lost)
            text += (std::exchange(is_first, false) ? "" : ", ") + what;
        context_.log(LogLevel::warning, text);
    }

    const Mesh& mesh_;
    const fs::path& path_;
    const Context& context_;
    fs::path folder_path_;
    GltfFolder folder_;
    const GltfAsset* asset_;
    std::shared_ptr<const GltfAsset> there_;
    MaterialFiles result_;
};

}  // namespace

MaterialFiles material_files(const Mesh& mesh, const fs::path& path, const Context& context) {
    return Planner(mesh, path, context).plan();
}

}  // namespace lissom
