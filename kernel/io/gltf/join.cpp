#include "kernel/io/gltf/join.h"

#include <utility>

#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/nodes.h"

namespace lissom {
namespace {

void shift(Json& object, const char* key, std::size_t offset) {
    Json* number = member(object, key);
    if (number && number->is_number_unsigned()) *number = number->get<std::size_t>() + offset;
}

void shift_all(Json& object, const char* key, std::size_t offset) {
    Json* list = member(object, key);
    if (!list || !list->is_array()) return;
    for (Json& number : *list) {
        if (number.is_number_unsigned()) number = number.get<std::size_t>() + offset;
    }
}

Json* extension_of(Json& object, const char* name) {
    Json* extensions = member(object, "extensions");
    return extensions ? member(*extensions, name) : nullptr;
}

std::size_t light_count(const Json& json) {
    const Json* lights = extension(json, "KHR_lights_punctual");
    return lights ? size_of_member(*lights, "lights") : 0;
}

// Renumbers the references inside one document so that they hold after the elements of another.
class Renumbering {
  public:
    Renumbering(const GltfAsset& base) : base_(base) {}

    void apply(Json& json) const {
        for_each(json, "nodes", [&](Json& node) { node_references(node); });
        for_each(json, "scenes", [&](Json& scene) { shift_all(scene, "nodes", count("nodes")); });
        for_each(json, "skins", [&](Json& skin) { skin_references(skin); });
        for_each(json, "animations", [&](Json& animation) { animation_references(animation); });
        for_each(json, "textures", [&](Json& texture) { texture_references(texture); });
        for_each(json, "materials", [&](Json& material) { material_references(material); });
        for_each(json, "meshes", [&](Json& mesh) { mesh_references(mesh); });
    }

  private:
    std::size_t count(const char* kind) const { return size_of_member(base_.json, kind); }

    template <typename Use>
    static void for_each(Json& json, const char* key, const Use& use) {
        Json* list = member(json, key);
        if (!list || !list->is_array()) return;
        for (Json& item : *list) use(item);
    }

    void node_references(Json& node) const {
        shift_all(node, "children", count("nodes"));
        shift(node, "mesh", count("meshes"));
        shift(node, "skin", count("skins"));
        shift(node, "camera", count("cameras"));
        if (Json* light = extension_of(node, "KHR_lights_punctual")) {
            shift(*light, "light", light_count(base_.json));
        }
    }

    void skin_references(Json& skin) const {
        shift_all(skin, "joints", count("nodes"));
        shift(skin, "skeleton", count("nodes"));
        shift(skin, "inverseBindMatrices", base_.accessors.size());
    }

    void animation_references(Json& animation) const {
        for_each(animation, "channels", [&](Json& channel) {
            if (Json* target = member(channel, "target")) shift(*target, "node", count("nodes"));
        });
        for_each(animation, "samplers", [&](Json& sampler) {
            shift(sampler, "input", base_.accessors.size());
            shift(sampler, "output", base_.accessors.size());
        });
    }

    // Extensions give other sources in other formats.
    void texture_references(Json& texture) const {
        shift(texture, "sampler", count("samplers"));
        for_each_object(texture, [&](Json& object) { shift(object, "source", count("images")); });
    }

    // Every reference to a texture is an object with its number as "index".
    void material_references(Json& material) const {
        for_each_object(material, [&](Json& object) { shift(object, "index", count("textures")); });
    }

    void mesh_references(Json& mesh) const {
        for_each_object(mesh, [&](Json& object) { shift(object, "material", count("materials")); });
    }

    const GltfAsset& base_;
};

std::string free_name(const std::string& name, const std::map<std::string, std::size_t>& taken,
                      const std::map<std::string, std::size_t>& others) {
    for (std::size_t i = 2;; ++i) {
        const std::string numbered = name + " " + std::to_string(i);
        if (!taken.contains(numbered) && !others.contains(numbered)) return numbered;
    }
}

bool has_texture(const Json& material) {
    bool found = false;
    for_each_object(material,
                    [&](const Json& object) { found = found || object.contains("index"); });
    return found;
}

// Adds labels for elements moved by `offset`; `same(old, added)` returns whether a label means the
// same in both. `json` has the elements, which take over new names.
template <typename Same>
void join_labels(std::map<std::string, std::size_t>& labels,
                 const std::map<std::string, std::size_t>& added, std::size_t offset,
                 std::map<std::string, std::string>& renames, Json& elements, const Same& same) {
    for (const auto& [label, element] : added) {
        const auto old = labels.find(label);
        if (old == labels.end()) {
            labels[label] = element + offset;
        } else if (!same(old->second, element + offset)) {
            const std::string name = free_name(label, labels, added);
            renames[label] = name;
            labels[name] = element + offset;
            elements[element + offset]["name"] = name;
        }
    }
}

void append_lists(Json& json, Json& added) {
    for (const char* key : {"animations", "cameras", "images", "materials", "meshes", "nodes",
                            "samplers", "skins", "textures"}) {
        if (size_of_member(added, key) == 0) continue;
        Json& list = list_in(json, key);
        for (Json& item : added[key]) list.push_back(std::move(item));
    }
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        if (size_of_member(added, key) == 0) continue;
        Json& list = list_in(json, key);
        for (Json& item : added[key]) list.push_back(std::move(item));
    }
}

void append_lights(Json& json, const Json& added) {
    const Json* lights = extension(added, "KHR_lights_punctual");
    if (!lights || size_of_member(*lights, "lights") == 0) return;
    Json& list = list_in(object_in(object_in(json, "extensions"), "KHR_lights_punctual"), "lights");
    for (const Json& light : (*lights)["lights"]) list.push_back(light);
}

}  // namespace

void join_assets(GltfAsset& asset, const GltfAsset& other, LabelRenames& renames) {
    Json added = other.json;
    Json& scene = default_scene(asset.json);
    const Json shown = default_scene(added);
    const std::size_t first_node = size_of_member(asset.json, "nodes");
    const std::size_t first_material = size_of_member(asset.json, "materials");
    Renumbering(asset).apply(added);
    for (const Json& node : shown.value("nodes", Json::array())) {
        list_in(scene, "nodes").push_back(node.get<std::size_t>() + first_node);
    }
    append_lights(asset.json, added);
    append_lists(asset.json, added);
    asset.accessors.insert(asset.accessors.end(), other.accessors.begin(), other.accessors.end());
    asset.images.insert(asset.images.end(), other.images.begin(), other.images.end());
    join_labels(asset.node_of_object, other.node_of_object, first_node, renames["object"],
                asset.json["nodes"], [](std::size_t, std::size_t) { return false; });
    const Json& materials = asset.json["materials"];
    join_labels(asset.material_of_label, other.material_of_label, first_material,
                renames["material"], asset.json["materials"], [&](std::size_t a, std::size_t b) {
                    return materials[a] == materials[b] && !has_texture(materials[a]);
                });
}

}  // namespace lissom
