// Morph targets of an asset: GltfAsset as a MorphAsset.
#include "kernel/io/gltf/asset.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/mesh/told_morphs.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

// Returns the targets of `all` with own weights if they exist.
std::vector<MorphTarget> with_own_weights(std::vector<MorphTarget> all,
                                          const std::vector<MorphTarget>& own) {
    const std::vector<Index> places = morph_places(own, all);
    for (std::size_t k = 0; k < own.size(); ++k) {
        if (places[k] != kNoIndex) all[at(places[k])].weight = own[k].weight;
    }
    return all;
}

const Json* numbers_member(const Json& object, const char* key) {
    const Json* list = member(object, key);
    return list && list->is_array() ? list : nullptr;
}

// Animations of the weights of one node, for other targets.
class WeightTracks {
  public:
    WeightTracks(GltfAsset& asset, const std::vector<MorphTarget>& all)
        : asset_(asset), all_(all) {}

    // `own` of the node, before.
    void follow(std::size_t node, const std::vector<MorphTarget>& own) {
        Json* animations = member(asset_.json, "animations");
        for (std::size_t a = 0; animations && a < animations->size(); ++a) {
            Json& animation = (*animations)[a];
            Json* channels = member(animation, "channels");
            if (!channels || !channels->is_array()) continue;
            for (Json& channel : *channels) {
                if (drives(channel, node)) follow(animation, channel, own);
            }
        }
    }

  private:
    static bool drives(const Json& channel, std::size_t node) {
        const Json* target = member(channel, "target");
        return target && text_member(*target, "path") == "weights" &&
               index_member(*target, "node", "an animation") == index_of(node);
    }

    void follow(Json& animation, Json& channel, std::vector<MorphTarget> own) {
        const int number = index_member(channel, "sampler", "an animation");
        Json& samplers = list_in(animation, "samplers");
        if (number < 0 || at(number) >= samplers.size()) return;
        Json sampler = samplers[at(number)];
        const int input = index_member(sampler, "input", "an animation"),
                  output = index_member(sampler, "output", "an animation");
        const std::size_t count = asset_.accessors.size();
        if (input < 0 || output < 0 || at(input) >= count || at(output) >= count) return;
        const std::size_t values = text_member(sampler, "interpolation") == "CUBICSPLINE" ? 3 : 1;
        const std::size_t groups =
            values * asset_.accessors[at(input)].json.value("count", std::size_t{0});
        const KeptAccessor& old = asset_.accessors[at(output)];
        const auto numbers = old.json.value("count", std::size_t{0});
        if (groups == 0 || numbers % groups != 0) return;
        const std::size_t width = numbers / groups;
        while (own.size() < width) {
            own.push_back({morph_call_name(count_of(own) + 1), 0.0, false});
        }
        own.resize(width);
        KeptAccessor made = laid_out(old, groups, values, morph_places(own, all_));
        sampler["output"] = asset_.accessors.size();
        asset_.accessors.push_back(std::move(made));
        channel["sampler"] = samplers.size();
        samplers.push_back(std::move(sampler));
    }

    // The second of a spline's three values is the weight, the others are tangents.
    KeptAccessor laid_out(const KeptAccessor& old, std::size_t groups, std::size_t values,
                          const std::vector<Index>& places) const {
        const std::size_t width = places.size();
        const std::size_t size = old.bytes->size() / (groups * width);
        const bool is_float = old.json.value("componentType", 0) == TINYGLTF_COMPONENT_TYPE_FLOAT;
        std::string bytes(groups * all_.size() * size, '\0');
        for (std::size_t g = 0; g < groups; ++g) {
            for (std::size_t t = 0; is_float && g % values == values / 2 && t < all_.size(); ++t) {
                const auto rest = to_bytes(static_cast<float>(all_[t].weight), Endianness::little);
                std::copy(rest.begin(), rest.end(), bytes.data() + (g * all_.size() + t) * size);
            }
            for (std::size_t k = 0; k < width; ++k) {
                if (places[k] == kNoIndex) continue;
                std::copy_n(old.bytes->data() + (g * width + k) * size, size,
                            bytes.data() + (g * all_.size() + at(places[k])) * size);
            }
        }
        KeptAccessor made{old.json, std::make_shared<const std::string>(std::move(bytes))};
        made.json["count"] = groups * all_.size();
        return made;
    }

    GltfAsset& asset_;
    const std::vector<MorphTarget>& all_;
};

bool is_same(const std::vector<MorphTarget>& own, const std::vector<MorphTarget>& all) {
    return std::equal(own.begin(), own.end(), all.begin(), all.end(),
                      [](const MorphTarget& a, const MorphTarget& b) { return a.name == b.name; });
}

// Gives the meshes and nodes of an asset other targets.
class MorphTeller {
  public:
    MorphTeller(const GltfAsset& old, GltfAsset& made, const std::vector<MorphTarget>& all)
        : old_(old), made_(made), all_(all) {
        const Json* meshes = member(old.json, "meshes");
        for (std::size_t m = 0; meshes && m < meshes->size(); ++m) {
            with_weights_ = with_weights_ || numbers_member((*meshes)[m], "weights");
        }
    }

    void tell_node(std::size_t number) {
        Json* nodes = member(made_.json, "nodes");
        Json* meshes = member(made_.json, "meshes");
        if (!nodes || !meshes || number >= nodes->size()) return;
        Json& node = (*nodes)[number];
        const int mesh = index_member(node, "mesh", "a node");
        if (mesh < 0 || at(mesh) >= meshes->size()) return;
        const Json& old_mesh = old_.json["meshes"][at(mesh)];
        const std::vector<MorphTarget> own = told_morphs(old_mesh, nullptr);
        tell_morphs((*meshes)[at(mesh)], with_own_weights(all_, own), with_weights_);
        if (is_same(own, all_)) return;
        if (node.contains("weights")) {
            node["weights"] = weights_of(with_own_weights(all_, told_morphs(old_mesh, &node)));
        }
        WeightTracks(made_, all_).follow(number, own);
    }

  private:
    const GltfAsset& old_;
    GltfAsset& made_;
    const std::vector<MorphTarget>& all_;
    bool with_weights_ = false;
};

}  // namespace

std::vector<MorphTarget> GltfAsset::morphs_of(std::string_view object) const {
    const auto found = node_of_object.find(std::string(object));
    if (found == node_of_object.end()) return new_morphs;
    const Json* nodes = member(json, "nodes");
    const Json* meshes = member(json, "meshes");
    if (!nodes || !meshes || found->second >= nodes->size()) return {};
    const Json& node = (*nodes)[found->second];
    const int mesh = index_member(node, "mesh", "a node");
    if (mesh < 0 || at(mesh) >= meshes->size()) return {};
    return told_morphs((*meshes)[at(mesh)], &node);
}

std::shared_ptr<const Asset> GltfAsset::with_morphs(const std::vector<MorphTarget>& all) const {
    auto result = std::make_shared<GltfAsset>(*this);
    result->new_morphs = all;
    MorphTeller teller(*this, *result, all);
    for (const auto& [label, node] : node_of_object) teller.tell_node(node);
    if (result->json == json && is_same(new_morphs, all)) return nullptr;
    return result;
}

}  // namespace lissom
