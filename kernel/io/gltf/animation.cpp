#include "kernel/io/gltf/animation.h"

#include <algorithm>
#include <utility>

#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/mesh/surface.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

bool drives_weights(const Json& channel) {
    const Json* target = member(channel, "target");
    return target && text_member(*target, "path") == "weights";
}

// Weights and names that belong to targets which are gone.
void erase_old_weights(Json& document) {
    for (const char* list : {"nodes", "meshes"}) {
        Json* all = member(document, list);
        for (std::size_t i = 0; all && i < all->size(); ++i) {
            Json& object = (*all)[i];
            object.erase("weights");
            Json* extras = member(object, "extras");
            if (extras && extras->is_object()) extras->erase("targetNames");
        }
    }
    Json* animations = member(document, "animations");
    for (std::size_t i = 0; animations && i < animations->size(); ++i) {
        Json* channels = member((*animations)[i], "channels");
        if (!channels || !channels->is_array()) continue;
        Json rest = Json::array();
        for (Json& channel : *channels) {
            if (!drives_weights(channel)) rest.push_back(std::move(channel));
        }
        *channels = std::move(rest);
    }
}

std::size_t add_node(GltfAsset& asset, const std::string& label) {
    Json& scene = default_scene(asset.json);
    Json& nodes = list_in(asset.json, "nodes");
    Json node = Json::object();
    if (!label.empty()) {
        node["name"] = label;
        Json& meshes = list_in(asset.json, "meshes");
        node["mesh"] = meshes.size();
        meshes.push_back(json_object({{"name", label}}));
    }
    nodes.push_back(std::move(node));
    list_in(scene, "nodes").push_back(nodes.size() - 1);
    asset.node_of_object[label] = nodes.size() - 1;
    return nodes.size() - 1;
}

bool has_flag(const Mesh& mesh, const SurfaceObject& object, const std::vector<char>& flags) {
    for (const SurfacePrimitive& primitive : object.primitives) {
        for (const Index f : primitive.faces) {
            const auto face = mesh.topology().face(f);
            if (std::any_of(face.begin(), face.end(), [&](Index v) { return flags[v]; })) {
                return true;
            }
        }
    }
    return false;
}

const FaceLabels* labels_of(const Mesh& mesh, const char* kind) {
    const auto found = mesh.attributes().labels().find(kind);
    return found == mesh.attributes().labels().end() ? nullptr : &found->second;
}

std::size_t add_floats(GltfAsset& asset, const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values) append_number(bytes, value, Endianness::little);
    Json json = json_object({{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT},
                             {"count", values.size()},
                             {"type", "SCALAR"}});
    asset.accessors.push_back(
        {std::move(json), std::make_shared<const std::string>(std::move(bytes))});
    return asset.accessors.size() - 1;
}

void add_animation(GltfAsset& asset, const std::vector<std::size_t>& nodes, const MorphKeys& keys) {
    const std::size_t times = add_floats(asset, keys.times);
    asset.accessors[times].json["min"] = Json::array({keys.times.front()});
    asset.accessors[times].json["max"] = Json::array({keys.times.back()});
    const Json sampler = json_object({{"input", times},
                                      {"output", add_floats(asset, keys.weights)},
                                      {"interpolation", keys.is_stepped ? "STEP" : "LINEAR"}});
    Json channels = Json::array();
    for (const std::size_t node : nodes) {
        Json target = json_object({{"node", node}, {"path", "weights"}});
        channels.push_back(json_object({{"sampler", 0}, {"target", std::move(target)}}));
    }
    Json animation =
        json_object({{"samplers", Json::array({sampler})}, {"channels", std::move(channels)}});
    if (!keys.name.empty()) animation["name"] = keys.name;
    list_in(asset.json, "animations").push_back(std::move(animation));
}

}  // namespace

std::vector<std::size_t> nodes_of_objects(const Mesh& mesh, const std::vector<char>& flags,
                                          GltfAsset& asset) {
    const FaceLabels* labels = labels_of(mesh, "object");
    std::vector<Index> pool_of_face;
    std::vector<std::size_t> nodes;
    for (const SurfaceObject& object :
         divide_surface(mesh, labels, labels_of(mesh, "material"), pool_of_face)) {
        if (!has_flag(mesh, object, flags)) continue;
        const std::string label = object.label == kNoIndex ? "" : labels->names[object.label];
        const auto known = asset.node_of_object.find(label);
        nodes.push_back(known == asset.node_of_object.end() ? add_node(asset, label)
                                                            : known->second);
    }
    return nodes;
}

std::shared_ptr<const GltfAsset> with_morph_animation(const Mesh& mesh,
                                                      const std::vector<char>& moves,
                                                      const MorphKeys& keys) {
    const auto* old = dynamic_cast<const GltfAsset*>(mesh.asset().get());
    auto asset = old ? std::make_shared<GltfAsset>(*old) : std::make_shared<GltfAsset>();
    asset->from_libraries = false;
    erase_old_weights(asset->json);
    const std::vector<std::size_t> nodes = nodes_of_objects(mesh, moves, *asset);
    if (!nodes.empty() && keys.target_count > 0) add_animation(*asset, nodes, keys);
    return asset;
}

}  // namespace lissom
