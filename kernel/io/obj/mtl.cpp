#include "kernel/io/obj/mtl.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "kernel/io/gltf/asset.h"
#include "kernel/io/stream/text_reader.h"

namespace lissom {
namespace {

struct Material {
    std::string name;
    std::array<double, 3> diffuse{0.8, 0.8, 0.8}, emissive{};
    double opacity = 1.0, metalness = 0.0;
    std::optional<double> roughness, shininess;
    std::string diffuse_map, emissive_map, normal_map;
};

std::optional<double> finite_number(std::string_view word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool good = error == std::errc() && end == word.data() + word.size();
    return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// Statements that are not understood are passed over, as other readers of the format do.
class LibraryReader {
  public:
    explicit LibraryReader(std::string_view text)
        : text_(text, {.comment = '#', .continuation = true}) {}

    std::vector<Material> read() {
        for (; !text_.at_end(); text_.skip_line()) read_statement(text_.word());
        return std::move(materials_);
    }

  private:
    void read_statement(std::string_view keyword) {
        if (keyword == "newmtl") {
            materials_.emplace_back().name = text_.rest_of_line();
            return;
        }
        if (materials_.empty()) return;
        Material& m = materials_.back();
        if (keyword == "Kd") return read_color(m.diffuse);
        if (keyword == "Ke") return read_color(m.emissive);
        if (keyword == "d") read_share(m.opacity);
        if (keyword == "Tr" && read_share(m.opacity)) m.opacity = 1.0 - m.opacity;
        if (keyword == "Pm") read_share(m.metalness);
        if (keyword == "Pr") m.roughness = share();
        if (keyword == "Ns") m.shininess = finite_number(text_.word());
        if (keyword == "map_Kd") m.diffuse_map = file_name();
        if (keyword == "map_Ke") m.emissive_map = file_name();
        if (keyword == "norm") m.normal_map = file_name();
    }

    std::optional<double> share() {
        const std::optional<double> value = finite_number(text_.word());
        return value ? std::optional(std::clamp(*value, 0.0, 1.0)) : std::nullopt;
    }

    bool read_share(double& target) {
        const std::optional<double> value = share();
        if (value) target = *value;
        return value.has_value();
    }

    // One number stands for all three.
    void read_color(std::array<double, 3>& color) {
        const std::optional<double> r = share();
        if (!r) return;
        const std::optional<double> g = share(), b = share();
        color = {*r, g.value_or(*r), b.value_or(*r)};
    }

    // What follows the options, such as "-s 1 1 1" and "-clamp on"; names may have blanks.
    std::string file_name() {
        std::string_view rest = text_.rest_of_line();
        while (rest.starts_with('-')) {
            const std::string_view option = take_word(rest);
            const bool has_numbers = option == "-o" || option == "-s" || option == "-t" ||
                                     option == "-mm" || option == "-bm" || option == "-boost" ||
                                     option == "-texres";
            if (!has_numbers) {
                take_word(rest);
                continue;
            }
            while (finite_number(rest.substr(0, rest.find_first_of(" \t")))) take_word(rest);
        }
        std::string name(rest);
        std::replace(name.begin(), name.end(), '\\', '/');
        return name;
    }

    static std::string_view take_word(std::string_view& text) {
        const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(end);
        text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
        return word;
    }

    TextReader text_;
    std::vector<Material> materials_;
};

std::string media_type_of(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    return bytes.starts_with("\xff\xd8\xff") ? "image/jpeg" : "";
}

// Collects materials in an asset of the kind that glTF files have.
class Library {
  public:
    Library(const std::filesystem::path& folder, Report& report, const Context& context)
        : folder_(folder, context), report_(report), asset_(std::make_shared<GltfAsset>()) {
        asset_->from_libraries = true;
    }

    void add_file(const std::string& name) {
        const SharedBytes content = find(name);
        if (!content) return;
        for (const Material& material : LibraryReader(*content).read()) add(material);
    }

    // Null where there is no material.
    std::shared_ptr<const GltfAsset> asset() const {
        return asset_->material_of_label.empty() ? nullptr : asset_;
    }

  private:
    // The content of a file in the folder; null, with a finding, where it is not there.
    SharedBytes find(const std::string& name) {
        SharedBytes content;
        std::string why;
        try {
            content = folder_.read_if_there(as_uri(name));
        } catch (const Error& error) {
            if (error.code() != ErrorCode::unsafe_path) throw;
            why = " (outside the folder of the file)";
        }
        if (!content) report_.add(FindingKind::files_missing, 1, in_quotes(name) + why);
        return content;
    }

    static std::string as_uri(const std::string& name) {
        std::string uri;
        for (const char c : name) uri += c == '%' ? "%25" : std::string(1, c);
        return uri;
    }

    void add(const Material& m) {
        Json& materials = asset_->json["materials"];
        if (!asset_->material_of_label.emplace(m.name, materials.size()).second) return;
        Json surface{{"metallicFactor", m.metalness}, {"roughnessFactor", roughness_of(m)}};
        const int diffuse = texture(m.diffuse_map);
        // The colour of a material with a texture is a stand-in for programs that show none.
        const std::array<double, 3> color =
            diffuse < 0 ? m.diffuse : std::array<double, 3>{1.0, 1.0, 1.0};
        surface["baseColorFactor"] = {color[0], color[1], color[2], m.opacity};
        if (diffuse >= 0) surface["baseColorTexture"] = {{"index", diffuse}};
        Json json{{"name", m.name}, {"pbrMetallicRoughness", std::move(surface)}};
        if (m.opacity < 1.0) json["alphaMode"] = "BLEND";
        add_emission(m, json);
        if (const int normal = texture(m.normal_map); normal >= 0)
            json["normalTexture"] = {{"index", normal}};
        materials.push_back(std::move(json));
    }

    void add_emission(const Material& m, Json& json) {
        const int map = texture(m.emissive_map);
        if (map >= 0) json["emissiveTexture"] = {{"index", map}};
        const bool shines = m.emissive != std::array<double, 3>{};
        if (shines || map >= 0)
            json["emissiveFactor"] = shines ? m.emissive : std::array<double, 3>{1.0, 1.0, 1.0};
    }

    // A Blinn-Phong lobe of exponent n is about as wide as one of this roughness (Karis 2013).
    static double roughness_of(const Material& m) {
        if (m.roughness) return *m.roughness;
        return m.shininess ? std::pow(2.0 / (std::max(*m.shininess, 0.0) + 2.0), 0.25) : 1.0;
    }

    // The number of the texture, or -1 where there is none that can be kept.
    int texture(const std::string& name) {
        if (name.empty()) return -1;
        const auto [entry, is_new] = texture_of_name_.emplace(name, -1);
        if (!is_new) return entry->second;
        const SharedBytes content = find(name);
        if (!content) return -1;
        const std::string type = media_type_of(*content);
        if (type.empty()) {
            report_.add(FindingKind::content_skipped, 1,
                        "texture " + in_quotes(name) + ", which is neither PNG nor JPEG");
            return -1;
        }
        Json& images = asset_->json["images"];
        Json& textures = asset_->json["textures"];
        textures.push_back({{"source", images.size()}});
        images.push_back({{"name", name}, {"mimeType", type}});
        asset_->images.push_back(content);
        return entry->second = count_of(textures) - 1;
    }

    GltfFolder folder_;
    Report& report_;
    std::shared_ptr<GltfAsset> asset_;
    std::map<std::string, int> texture_of_name_;
};

}  // namespace

void read_material_libraries(const FileInput& file, MeshData& data, const Context& context) {
    if (file.folder.empty()) return;
    Library library(file.folder, data.report, context);
    for (const std::string& name : data.material_libraries) {
        context.checkpoint();
        library.add_file(name);
    }
    data.asset = library.asset();
}

}  // namespace lissom
