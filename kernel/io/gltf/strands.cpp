#include "kernel/io/gltf/strands.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strand_measures.h"
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

std::size_t add_floats(std::span<const float> values, const char* type, std::size_t width,
                       std::optional<BufferUse> use, GltfBinary& binary) {
    return binary.add(accessor(TINYGLTF_COMPONENT_TYPE_FLOAT, values.size() / width, type),
                      bytes_of(values), use);
}

std::size_t add_wholes(const std::vector<std::uint32_t>& values, const char* type,
                       std::size_t width, GltfBinary& binary) {
    return binary.add(accessor(TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, values.size() / width, type),
                      bytes_of(std::span<const std::uint32_t>(values)));
}

// Calls add(strand, point) for each point.
template <typename Add>
void for_each_point(const Strands& strands, const Add& add) {
    for (Index s = 0; s < strands.size(); ++s) {
        const Index first = strands.first_point(s);
        for (Index p = first; p < first + strands.point_count(s); ++p) add(s, p);
    }
}

void add_point_values(const Strands& strands, Json& attributes, GltfBinary& binary) {
    std::vector<float> list, one;
    for (Index s = 0; s < strands.size(); ++s) {
        widths_of(strands, s, one);
        list.insert(list.end(), one.begin(), one.end());
    }
    attributes["_WIDTH"] = add_floats(list, "SCALAR", 1, BufferUse::vertices, binary);
    const StrandValues<float>& transparency = strands.transparency();
    if (transparency.domain != StrandDomain::all || transparency.common != 0.0f) {
        list.clear();
        for_each_point(strands, [&](Index s, Index p) { list.push_back(transparency.at(s, p)); });
        attributes["_TRANSPARENCY"] = add_floats(list, "SCALAR", 1, BufferUse::vertices, binary);
    }
    const std::vector<Eigen::Vector2f>& uvs = strands.roots().uvs;
    if (uvs.empty()) return;
    list.clear();
    for_each_point(strands, [&](Index s, Index) {
        list.insert(list.end(), uvs[at(s)].begin(), uvs[at(s)].end());
    });
    attributes["_ROOT_UV"] = add_floats(list, "VEC2", 2, BufferUse::vertices, binary);
}

std::vector<std::uint32_t> wholes_of(const std::vector<Index>& indices) {
    return {indices.begin(), indices.end()};
}

void add_root_tables(const StrandRoots& roots, Json& tables, GltfBinary& binary) {
    if (roots.faces.empty()) return;
    tables["face"] = add_wholes(wholes_of(roots.faces), "SCALAR", 1, binary);
    std::vector<float> weights;
    for (const Eigen::Vector3f& w : roots.barycentrics) {
        weights.insert(weights.end(), w.begin(), w.end());
    }
    tables["weights"] = add_floats(weights, "VEC3", 3, {}, binary);
    std::vector<std::uint32_t> vertices;
    for (const Triangle& t : roots.triangles) vertices.insert(vertices.end(), t.begin(), t.end());
    if (!vertices.empty()) tables["vertices"] = add_wholes(vertices, "VEC3", 3, binary);
}

Json strand_tables(const Strands& strands, GltfBinary& binary) {
    Json tables = json_object({{"count", strands.size()}});
    add_root_tables(strands.roots(), tables, binary);
    if (!strands.ids().empty()) tables["id"] = add_wholes(strands.ids(), "SCALAR", 1, binary);
    if (!strands.guides().ids.empty()) {
        tables["guide"] = add_wholes(strands.guides().ids, "SCALAR", 1, binary);
        tables["guide_arc"] = add_floats(strands.guides().arcs, "SCALAR", 1, {}, binary);
    }
    if (!strands.groups().empty()) {
        tables["group"] = add_wholes(wholes_of(strands.groups()), "SCALAR", 1, binary);
        Json& names = list_in(tables, "group_names");
        for (const std::string& name : strands.group_names()) names.push_back(name);
    }
    if (!strands.comment().empty()) tables["comment"] = strands.comment();
    return tables;
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
    add_point_values(strands, primitive["attributes"], binary);
    progress.update(0.6);
    primitive["indices"] = add_lines(strands, binary);
    Json mesh = json_object({{"name", "Hair"}, {"extras", Json::object()}});
    mesh["extras"][kStrandTables] = strand_tables(strands, binary);
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
