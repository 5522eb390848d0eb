#include "kernel/io/gltf/strands.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/io/gltf/file/binary.h"
#include "kernel/io/gltf/file/container.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/file/uri.h"
#include "kernel/io/stream/byte_source.h"
#include "kernel/io/stream/json_object.h"

namespace lissom {
namespace {

template <typename T>
std::string bytes_of(std::span<const T> numbers) {
    std::string bytes;
    bytes.reserve(numbers.size_bytes());
    append_little_endian(bytes, numbers);
    return bytes;
}

Json accessor(int component, std::size_t count, const char* type) {
    return json_object({{"componentType", component}, {"count", count}, {"type", type}});
}

std::size_t add_positions(const Strands& strands, GltfBinary& binary) {
    const std::span<const float> points = strands.points();
    Json positions = accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, points.size() / 3, "VEC3");
    Eigen::Vector3f least(points.data()), most(points.data());
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Eigen::Vector3f p(points.data() + i);
        least = least.cwiseMin(p);
        most = most.cwiseMax(p);
    }
    // Wide numbers of the same value, so that the text reads back equal.
    positions["min"] = {double(least.x()), double(least.y()), double(least.z())};
    positions["max"] = {double(most.x()), double(most.y()), double(most.z())};
    return binary.add(std::move(positions), bytes_of(points), BufferUse::vertices);
}

std::size_t add_colors(const Strands& strands, GltfBinary& binary) {
    std::vector<float> colors;
    colors.reserve(strands.points().size());
    for (Index s = 0; s < strands.size(); ++s) {
        const Index first = strands.first_point(s);
        for (Index k = 0; k < strands.point_count(s); ++k) {
            for (const float x : strands.colors()->at(s, first + k)) {
                colors.push_back(std::clamp(x, 0.0f, 1.0f));
            }
        }
    }
    return binary.add(accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, colors.size() / 3, "VEC3"),
                      bytes_of(std::span<const float>(colors)), BufferUse::vertices);
}

std::size_t add_lines(const Strands& strands, GltfBinary& binary) {
    std::vector<std::uint32_t> indices;
    indices.reserve(2 * at(strands.point_count() - strands.size()));
    for (Index s = 0; s < strands.size(); ++s) {
        const auto first = static_cast<std::uint32_t>(strands.first_point(s));
        const auto count = static_cast<std::uint32_t>(strands.point_count(s));
        for (std::uint32_t k = 1; k < count; ++k) {
            indices.push_back(first + k - 1);
            indices.push_back(first + k);
        }
    }
    return binary.add(accessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, indices.size(), "SCALAR"),
                      bytes_of(std::span<const std::uint32_t>(indices)), BufferUse::indices);
}

// glTF allows no empty meshes: without strands the scene is empty.
Json make_document(const Strands& strands, GltfBinary& binary, const Context& context) {
    Progress progress(context, "write strands");
    Json document =
        json_object({{"asset", json_object({{"version", "2.0"}, {"generator", "Lissom"}})}});
    if (strands.empty()) return document;
    Json primitive = json_object({{"mode", TINYGLTF_MODE_LINE}, {"attributes", Json::object()}});
    primitive["attributes"]["POSITION"] = add_positions(strands, binary);
    progress.update(0.3);
    if (strands.colors()) primitive["attributes"]["COLOR_0"] = add_colors(strands, binary);
    progress.update(0.6);
    primitive["indices"] = add_lines(strands, binary);
    Json mesh = json_object({{"name", "Hair"}});
    list_in(mesh, "primitives").push_back(std::move(primitive));
    list_in(document, "meshes").push_back(std::move(mesh));
    list_in(document, "nodes").push_back(json_object({{"name", "Hair"}, {"mesh", 0}}));
    list_in(document, "scenes").push_back(json_object({{"nodes", Json::array({0})}}));
    document["scene"] = 0;
    binary.finish(document);
    return document;
}

}  // namespace

void write_gltf_strands(const Strands& strands, std::string& bytes, const Context& context) {
    GltfBinary binary;
    Json document = make_document(strands, binary, context);
    if (!binary.bytes().empty()) document["buffers"][0]["uri"] = make_data_uri(binary.bytes());
    bytes = to_text(document);
}

void write_glb_strands(const Strands& strands, std::string& bytes, const Context& context) {
    GltfBinary binary;
    const std::string json = to_text(make_document(strands, binary, context));
    bytes = make_glb(json, binary.bytes());
}

}  // namespace lissom
