// The joints of skins, for other formats than glTF.
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "kernel/io/gltf/asset.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/json_object.h"

namespace lissom {
namespace {

constexpr std::size_t kMatrixBytes = 16 * sizeof(float);

// The skin of an object, or null.
const Json* skin_of(const GltfAsset& asset, std::string_view object) {
    const auto found = asset.node_of_object.find(std::string(object));
    const Json* nodes = member(asset.json, "nodes");
    const Json* skins = member(asset.json, "skins");
    if (found == asset.node_of_object.end() || !nodes || !skins) return nullptr;
    const Json& node = (*nodes)[found->second];
    if (!node.contains("skin")) return nullptr;
    const auto skin = node["skin"].get<std::uint64_t>();
    return skin < skins->size() ? &(*skins)[static_cast<std::size_t>(skin)] : nullptr;
}

// The nodes of the joints; one that does not exist is the number of nodes.
std::vector<std::size_t> joint_nodes(const Json& skin, std::size_t node_count) {
    std::vector<std::size_t> result;
    const Json* joints = member(skin, "joints");
    if (!joints || !joints->is_array()) return {};
    for (const Json& joint : *joints) {
        const std::uint64_t number = joint.is_number_unsigned() ? joint.get<std::uint64_t>() : 0;
        result.push_back(number < node_count ? static_cast<std::size_t>(number) : node_count);
    }
    return result;
}

std::string joint_name(const Json& nodes, std::size_t node) {
    const bool named = node < nodes.size() && nodes[node].contains("name");
    return named ? nodes[node]["name"].get<std::string>() : "node " + std::to_string(node);
}

// The inverse of the matrix of joint `j`, or nothing if there is none.
std::optional<Affine> bind_transform(const GltfAsset& asset, const Json& skin, std::size_t j) {
    const int number = index_member(skin, "inverseBindMatrices", "a skin");
    if (number < 0) return Affine{};
    if (at(number) >= asset.accessors.size()) return std::nullopt;
    const KeptAccessor& kept = asset.accessors[at(number)];
    const bool are_floats = kept.json.value("componentType", 0) == TINYGLTF_COMPONENT_TYPE_FLOAT;
    if (!are_floats || kept.bytes->size() < (j + 1) * kMatrixBytes) return std::nullopt;
    ByteReader reader(std::string_view(*kept.bytes).substr(j * kMatrixBytes), Endianness::little);
    Eigen::Matrix4d inverse;
    for (int i = 0; i < 16; ++i) inverse(i % 4, i / 4) = reader.read<float>();
    const Mat3 linear = inverse.topLeftCorner<3, 3>().inverse();
    const Affine bind{linear, -(linear * inverse.topRightCorner<3, 1>())};
    return bind.is_finite() ? std::optional(bind) : std::nullopt;
}

// The parent of each node, or the number of nodes.
std::vector<std::size_t> node_parents(const Json& nodes) {
    std::vector<std::size_t> parents(nodes.size(), nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const Json* children = member(nodes[n], "children");
        if (!children || !children->is_array()) continue;
        for (const Json& child : *children) parents[child.get<std::size_t>()] = n;
    }
    return parents;
}

Affine inverse_of(const Affine& map) {
    const Mat3 linear = map.linear.inverse();
    return {linear, -(linear * map.translation)};
}

// From joint to parent; a parent that flattens everything has no inverse.
Affine relative_to(const Affine& parent, const Affine& joint) {
    const Affine result = inverse_of(parent) * joint;
    return result.is_finite() ? result : joint;
}

}  // namespace

std::vector<std::string> GltfAsset::joints_of(std::string_view object) const {
    const Json* skin = skin_of(*this, object);
    if (!skin) return {};
    std::vector<std::string> names;
    for (const std::size_t node : joint_nodes(*skin, json["nodes"].size())) {
        names.push_back(joint_name(json["nodes"], node));
    }
    return names;
}

Skeleton GltfAsset::skeleton_of(std::string_view object) const {
    const Json* skin = skin_of(*this, object);
    if (!skin) return {};
    const Json& nodes = json["nodes"];
    const std::vector<std::size_t> joints = joint_nodes(*skin, nodes.size());
    const std::vector<Affine> world = world_transforms(json);
    const std::vector<std::size_t> above = node_parents(nodes);
    std::map<std::size_t, Index> joint_of_node;
    for (std::size_t j = 0; j < joints.size(); ++j) joint_of_node.emplace(joints[j], index_of(j));
    Skeleton skeleton;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const std::size_t node = joints[j];
        std::size_t parent = node < nodes.size() ? above[node] : node;
        while (parent < nodes.size() && !joint_of_node.contains(parent)) parent = above[parent];
        const bool has_parent = parent < nodes.size();
        const Affine place = node < nodes.size() ? world[node] : Affine{};
        skeleton.names.push_back(joint_name(nodes, node));
        skeleton.parents.push_back(has_parent ? joint_of_node.at(parent) : kNoIndex);
        skeleton.bind.push_back(bind_transform(*this, *skin, j).value_or(place));
        skeleton.rest.push_back(has_parent ? relative_to(world[parent], place) : place);
    }
    return skeleton;
}

}  // namespace lissom
