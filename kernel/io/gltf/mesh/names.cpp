#include "kernel/io/gltf/mesh/names.h"

#include <array>
#include <charconv>
#include <utility>

namespace lissom {
namespace {

constexpr Index kMaximumSet = 999;
// More joints a vertex are found nowhere, and each takes memory for all.
constexpr Index kMaximumJointSet = 15;

// The number that `text` is, or kNoIndex.
Index number_in(std::string_view text) {
    Index value = kNoIndex;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool good = error == std::errc() && stop == text.data() + text.size() && value >= 0;
    return good ? value : kNoIndex;
}

struct SetName {
    std::string_view prefix, name;
    GltfSemantic semantic;
};

constexpr std::array<SetName, 4> kSets{{{"TEXCOORD_", "uv", GltfSemantic::uv},
                                        {"COLOR_", "color", GltfSemantic::color},
                                        {"JOINTS_", "joints", GltfSemantic::joints},
                                        {"WEIGHTS_", "weights", GltfSemantic::weights}}};

struct PlainName {
    std::string_view gltf, name;
    GltfSemantic semantic;
};

constexpr std::array<PlainName, 3> kPlain{{{"POSITION", "position", GltfSemantic::position},
                                           {"NORMAL", "normal", GltfSemantic::normal},
                                           {"TANGENT", "tangent", GltfSemantic::tangent}}};

bool is_joints(GltfSemantic semantic) {
    return semantic == GltfSemantic::joints || semantic == GltfSemantic::weights;
}

// "uv", "uv2", ...
std::string numbered(std::string_view name, Index set) {
    return std::string(name) + (set == 0 ? "" : std::to_string(set + 1));
}

// Names that mean something in a mesh, and so cannot be those of other attributes.
bool is_reserved(std::string_view name) {
    if (name.empty() || name == "position" || parse_morph_name(name).target > 0) return true;
    const GltfSemantic semantic = parse_mesh_attribute(name).semantic;
    return semantic != GltfSemantic::custom;
}

}  // namespace

GltfAttributeName parse_gltf_attribute(std::string_view name) {
    for (const PlainName& plain : kPlain) {
        if (name == plain.gltf) return {plain.semantic, 0, std::string(plain.name)};
    }
    for (const SetName& sets : kSets) {
        if (!name.starts_with(sets.prefix)) continue;
        const Index set = number_in(name.substr(sets.prefix.size()));
        const bool joints = is_joints(sets.semantic);
        if (set == kNoIndex || set > (joints ? kMaximumJointSet : kMaximumSet)) return {};
        return {sets.semantic, set, joints ? std::string(sets.name) : numbered(sets.name, set)};
    }
    if (!name.starts_with('_')) return {};
    const std::string_view rest = name.substr(1);
    return {GltfSemantic::custom, 0, std::string(is_reserved(rest) ? name : rest)};
}

GltfAttributeName parse_mesh_attribute(std::string_view name) {
    if (parse_morph_name(name).target > 0) return {};
    for (const PlainName& plain : kPlain) {
        if (name == plain.name && plain.semantic != GltfSemantic::position) {
            return {plain.semantic, 0, std::string(name)};
        }
    }
    for (const SetName& sets : kSets) {
        if (!name.starts_with(sets.name)) continue;
        if (name == sets.name) return {sets.semantic, 0, std::string(name)};
        const Index number = number_in(name.substr(sets.name.size()));
        if (!is_joints(sets.semantic) && number >= 2 && number <= kMaximumSet + 1) {
            return {sets.semantic, number - 1, std::string(name)};
        }
    }
    return {GltfSemantic::custom, 0, std::string(name)};
}

std::string gltf_attribute_name(const GltfAttributeName& attribute) {
    for (const PlainName& plain : kPlain) {
        if (attribute.semantic == plain.semantic) return std::string(plain.gltf);
    }
    for (const SetName& sets : kSets) {
        if (attribute.semantic == sets.semantic) {
            return std::string(sets.prefix) + std::to_string(attribute.set);
        }
    }
    const std::string& name = attribute.name;
    const bool has_mark = name.starts_with('_') && is_reserved(std::string_view(name).substr(1));
    return has_mark ? name : "_" + name;
}

MorphName parse_morph_name(std::string_view name) {
    constexpr std::string_view kPrefix = "morph.";
    if (!name.starts_with(kPrefix)) return {};
    name.remove_prefix(kPrefix.size());
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) return {};
    const Index target = number_in(name.substr(0, dot));
    for (const PlainName& plain : kPlain) {
        if (target > 0 && name.substr(dot + 1) == plain.name) return {target, plain.semantic};
    }
    return {};
}

std::string morph_name(Index target, GltfSemantic semantic) {
    std::string name = "morph." + std::to_string(target) + ".";
    for (const PlainName& plain : kPlain) {
        if (plain.semantic == semantic) name += plain.name;
    }
    return name;
}

}  // namespace lissom
