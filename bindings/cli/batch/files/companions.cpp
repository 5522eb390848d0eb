#include "bindings/cli/batch/files/companions.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "bindings/cli/batch/files/file_plan.h"
#include "bindings/cli/json.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

std::string rest_of_line(std::istringstream& words) {
    std::string rest;
    std::getline(words >> std::ws, rest);
    rest.erase(rest.find_last_not_of(" \t\r") + 1);
    return rest;
}

// The last word of "map_Kd -s 1 1 1 wood.png" that may be a name, and all words as a name.
void add_texture(const fs::path& folder, const std::string& rest, std::set<std::string>& files) {
    files.insert((folder / rest).string());
    const std::size_t space = rest.find_last_of(" \t");
    if (space != std::string::npos) files.insert((folder / rest.substr(space + 1)).string());
}

void add_textures(const fs::path& library, std::set<std::string>& files) {
    std::ifstream stream(library);
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        const bool is_map = keyword.starts_with("map_") || keyword == "norm" || keyword == "bump";
        if (is_map) add_texture(library.parent_path(), rest_of_line(words), files);
    }
}

void add_libraries(const fs::path& obj, std::set<std::string>& files) {
    std::ifstream stream(obj);
    for (std::string line; std::getline(stream, line);) {
        if (line.find("mtllib") == std::string::npos) continue;
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword != "mtllib") continue;
        const fs::path library = obj.parent_path() / rest_of_line(words);
        files.insert(library.string());
        add_textures(library, files);
    }
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string decoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_code = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                             hex_digit(uri[i + 2]) >= 0;
        text += is_code ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2]))
                        : uri[i];
        if (is_code) i += 2;
    }
    return text;
}

void add_resources(const fs::path& gltf, std::set<std::string>& files) {
    std::ifstream stream(gltf, std::ios::binary);
    const Json json = Json::parse(stream, nullptr, false);
    if (!json.is_object()) return;
    for (const char* kind : {"buffers", "images"}) {
        if (!json.contains(kind) || !json.at(kind).is_array()) continue;
        for (const Json& resource : json.at(kind)) {
            if (!resource.is_object() || !resource.contains("uri")) continue;
            if (!resource.at("uri").is_string()) continue;
            const auto uri = resource.at("uri").get<std::string>();
            if (uri.starts_with("data:")) continue;
            files.insert((gltf.parent_path() / decoded(uri)).string());
        }
    }
}

void add_folder(const fs::path& folder, std::set<std::string>& files) {
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;
        if (entry->is_regular_file(ignored)) files.insert(entry->path().string());
    }
}

}  // namespace

void add_companions(const std::string& file, std::set<std::string>& files) {
    const fs::path path(file);
    std::error_code error;
    if (fs::is_directory(path, error)) return add_folder(path, files);
    const std::string extension = lower_case(path.extension().string());
    if (extension == ".obj") return add_libraries(path, files);
    if (extension == ".gltf") return add_resources(path, files);
}

}  // namespace lissom::cli
