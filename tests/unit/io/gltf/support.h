/// Builds glTF files in memory for tests.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/unit/io/io_support.h"

namespace lissom::test {

using Json = nlohmann::json;

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                     kUnsignedInt = 5125, kFloat = 5126;

/// `text` in base64.
inline std::string base64(const std::string& text) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    for (std::size_t i = 0; i < text.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            bits = bits << 8 | (k < text.size() ? static_cast<unsigned char>(text[k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            result += i + k > text.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
    }
    return result;
}

/// A document and its one buffer.
struct GltfFile {
    Json json{{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    /// Adds numbers as one buffer view and returns its number.
    template <typename T>
    int view(const std::vector<T>& numbers) {
        while (bytes.size() % 4 != 0) bytes += '\0';
        json["bufferViews"].push_back({{"buffer", 0},
                                       {"byteOffset", bytes.size()},
                                       {"byteLength", numbers.size() * sizeof(T)}});
        for (const T& number : numbers) bytes += std::string(Bytes().add(number));
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    /// Adds an accessor to numbers and returns its number. `more` has further members.
    template <typename T>
    int accessor(const std::vector<T>& numbers, int component_type, const char* type,
                 const Json& more = Json::object()) {
        const std::string name = type;
        const std::size_t width = name == "SCALAR" ? 1 : name == "MAT4" ? 16 : name[3] - '0';
        Json accessor{{"bufferView", view(numbers)},
                      {"componentType", component_type},
                      {"count", numbers.size() / width},
                      {"type", type}};
        accessor.update(more);
        json["accessors"].push_back(accessor);
        return static_cast<int>(json["accessors"].size()) - 1;
    }

    int floats(const std::vector<float>& numbers, const char* type) {
        return accessor(numbers, kFloat, type);
    }
    int indices(const std::vector<std::uint16_t>& numbers) {
        return accessor(numbers, kUnsignedShort, "SCALAR");
    }

    /// Adds a mesh with one primitive and a root node for it; returns the node's number.
    int add_mesh(const Json& primitive) {
        json["meshes"].push_back({{"primitives", {primitive}}});
        json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
        return static_cast<int>(json["nodes"].size()) - 1;
    }

    /// Positions of a square around the origin, counter-clockwise.
    int square() { return floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3"); }
    /// Adds a square of two triangles; returns the primitive.
    Json square_primitive() {
        return {{"attributes", {{"POSITION", square()}}}, {"indices", indices({0, 1, 2, 0, 2, 3})}};
    }

    std::string text() const {
        Json whole = json;
        if (!bytes.empty() && !whole.contains("buffers")) {
            whole["buffers"] = {{{"byteLength", bytes.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        }
        return whole.dump();
    }
    Mesh load() const { return decode_mesh(text(), "gltf"); }
    Error error() const {
        return error_of([&] { load(); });
    }
};

/// The JSON of a binary file.
inline Json json_of_glb(const std::string& bytes) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof(length));
    return Json::parse(bytes.substr(20, length));
}

}  // namespace lissom::test
