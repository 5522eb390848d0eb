#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "kernel/io/gltf/asset.h"
#include "kernel/io/gltf/file/binary.h"
#include "kernel/io/gltf/file/container.h"
#include "kernel/io/gltf/file/extensions.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/uri.h"
#include "kernel/io/gltf/gltf.h"
#include "kernel/io/gltf/mesh/mesh_writer.h"
#include "kernel/io/gltf/mesh/surface.h"
#include "kernel/io/gltf/mesh/told_morphs.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/io/stream/json_object.h"

namespace lissom {
namespace {

void erase_if_empty(Json& object, const char* key) {
    const Json* value = member(object, key);
    if (value && value->empty()) object.erase(key);
}

// Sets of texture coordinates that a material reads.
Index uv_count(const Json& material) {
    Index count = 0;
    const auto look_at = [&](const Json& texture) {
        const Json* set = member(texture, "texCoord");
        const bool is_number = set && set->is_number_unsigned();
        count = std::max(count, (is_number ? set->get<Index>() : 0) + 1);
    };
    for_each_object(material, [&](const Json& object) {
        if (!object.contains("index")) return;
        look_at(object);
        if (const Json* moved = extension(object, "KHR_texture_transform")) look_at(*moved);
    });
    return count;
}

// Assembles a document from a mesh and its asset.
class DocumentWriter {
  public:
    DocumentWriter(SavedParts& parts, const SaveOptions& options, const Context& context)
        : parts_(parts),
          options_(options),
          moves_origin_(options.origin == FileOrigin::automatic),
          context_(context),
          asset_(dynamic_cast<const GltfAsset*>(parts.take_asset().get())),
          attributes_(take_attributes(parts)),
          binary_(options.compression == Compression::meshopt) {
        if (!asset_) return;
        json_ = asset_->json;
        world_ = world_transforms(json_);
    }

    // The JSON; the bytes it refers to are those of `binary()`.
    Json write() {
        Progress progress(context_, "write glTF");
        describe_asset();
        take_meshes_from_nodes();
        write_surface(progress);
        write_kept_accessors();
        write_images();
        clean();
        binary_.finish(json_);
        declare_extensions();
        return std::move(json_);
    }

    const std::string& binary() const { return binary_.bytes(); }

  private:
    void describe_asset() {
        Json& asset = object_in(json_, "asset");
        asset["version"] = "2.0";
        asset["generator"] = "Lissom";
    }

    void take_meshes_from_nodes() {
        old_meshes_ = json_.value("meshes", Json::array());
        json_["meshes"] = Json::array();
        Json* nodes = member(json_, "nodes");
        for (std::size_t n = 0; nodes && n < nodes->size(); ++n) {
            old_mesh_.push_back(index_member((*nodes)[n], "mesh", "a node"));
            (*nodes)[n].erase("mesh");
        }
    }

    void write_surface(Progress& progress) {
        const Mesh& mesh = parts_.mesh();
        objects_ = parts_.take_labels("object");
        materials_ = parts_.take_labels("material");
        MeshWriter writer(parts_, attributes_, binary_, context_);
        writer.uses_draco = options_.compression == Compression::draco;
        writer.quantize = options_.quantize;
        writer.writes_integers = options_.compression == Compression::none;
        if (mesh.face_count() == 0) {
            if (mesh.vertex_count() > 0) write_points(writer);
            return;
        }
        std::vector<Index> pool_of_face;
        const std::vector<SurfaceObject> objects =
            divide_surface(mesh, objects_, materials_, pool_of_face);
        const auto count = count_of(objects);
        const VertexPools pools(mesh, pool_of_face, count, attributes_.of_corners());
        const bool are_joined = std::any_of(objects.begin(), objects.end(),
                                            [](const SurfaceObject& o) { return o.is_joined; });
        writer.states_copies = are_joined || seams_are_ambiguous(mesh, pools, count);
        for (Index o = 0; o < count; ++o) {
            progress.update(o, count);
            write_object(objects[o], pools, o, writer);
        }
        has_integers_ = writer.has_integers();
        writer.float_loss().require_small("glTF", !moves_origin_, context_);
        log_changes(writer);
    }

    void log_changes(const MeshWriter& writer) const {
        if (writer.lost_tangents() > 0) {
            context_.log(LogLevel::warning, "tangents were not saved because there are no normals");
        }
        if (writer.uncompressed() > 0) {
            context_.log(LogLevel::warning,
                         std::to_string(writer.uncompressed()) +
                             " objects of several materials were not compressed by Draco: other "
                             "vertices lie where the materials meet; meshopt compresses them too");
        }
        const Mesh& mesh = parts_.mesh();
        std::size_t alone = 0;
        for (Index v = 0; v < mesh.vertex_count(); ++v) alone += mesh.topology().is_isolated(v);
        if (alone > 0) {
            context_.log(LogLevel::warning,
                         std::to_string(alone) + " vertices without faces were not saved");
        }
    }

    std::string label_of(const SurfaceObject& object) const {
        return object.label == kNoIndex ? "" : objects_->names[object.label];
    }

    // The node that a label stands for. One that flattens cannot place anything.
    std::optional<std::size_t> node_of(const std::string& label) const {
        if (!asset_) return std::nullopt;
        const auto found = asset_->node_of_object.find(label);
        if (found == asset_->node_of_object.end()) return std::nullopt;
        const double volume = world_[found->second].linear.determinant();
        const bool places = std::isfinite(volume) && volume != 0.0;
        return places || is_skinned(found->second) ? std::optional(found->second) : std::nullopt;
    }

    bool is_skinned(std::size_t node) const {
        return attributes_.joints && json_["nodes"][node].contains("skin");
    }

    ObjectPlace place_at(std::size_t node) {
        ObjectPlace place;
        Json& json = json_["nodes"][node];
        if (is_skinned(node)) {
            const int skin = index_member(json, "skin", "a node");
            const Json* skins = member(json_, "skins");
            if (skins && at(skin) < skins->size()) {
                place.joint_count = size_of_member((*skins)[skin], "joints");
            }
        } else {
            json.erase("skin");
            place.to_node = NodeTransform(world_[node]).inverse();
        }
        const int mesh = old_mesh_[node];
        if (mesh >= 0 && at(mesh) < old_meshes_.size()) {
            place.mesh = old_meshes_[mesh];
        }
        return place;
    }

    std::size_t add_node(const std::string& name) {
        Json node = Json::object();
        if (!name.empty()) node["name"] = name;
        Json& scene = default_scene(json_);
        Json& nodes = list_in(json_, "nodes");
        nodes.push_back(std::move(node));
        list_in(scene, "nodes").push_back(nodes.size() - 1);
        return nodes.size() - 1;
    }

    void write_object(const SurfaceObject& object, const VertexPools& pools, Index number,
                      MeshWriter& writer) {
        const std::string label = label_of(object);
        const std::optional<std::size_t> old_node = node_of(label);
        ObjectPlace place = old_node ? place_at(*old_node) : ObjectPlace();
        if (!old_node && asset_) tell_morphs(place.mesh, asset_->new_morphs);
        if (!old_node && !label.empty()) place.mesh["name"] = label;
        const std::size_t node =
            moved_node(old_node, label, pools.pool(number).vertices, place.to_node);
        std::vector<PlacedMaterial> materials;
        for (const SurfacePrimitive& primitive : object.primitives) {
            materials.push_back(placed_material(primitive.material));
        }
        put_mesh(node, writer.write(object, pools, number, place, materials));
    }

    void write_points(MeshWriter& writer) {
        ObjectPlace place;
        const std::vector<Index> all = pool_of_points(parts_.mesh()).vertices;
        const std::size_t node = moved_node(std::nullopt, "", all, place.to_node);
        put_mesh(node, writer.write_points(place));
    }

    // The node of an object: the old one, or a new one. If the origin is to be moved and is far, it
    // is a new one in the middle of `vertices`, below the old one, and `to_node` leads there.
    std::size_t moved_node(std::optional<std::size_t> old_node, const std::string& label,
                           const std::vector<Index>& vertices, NodeTransform& to_node) {
        Vec3 origin = Vec3::Zero();
        if (moves_origin_ && !(old_node && is_bound(*old_node))) {
            Box box;
            for (const Index v : vertices) box.extend(to_node.position(parts_.mesh().position(v)));
            origin = near_origin(box);
        }
        if (origin.isZero(0.0)) return old_node ? *old_node : add_node(label);
        to_node = to_node.moved(-origin);
        const std::size_t node = old_node ? add_child(*old_node, label) : add_node(label);
        json_["nodes"][node]["translation"] = {origin.x(), origin.y(), origin.z()};
        return node;
    }

    // Whether the mesh has to stay at its node: its skin or its weights are there.
    bool is_bound(std::size_t node) const {
        const Json& json = json_["nodes"][node];
        if (is_skinned(node) || json.contains("weights")) return true;
        bool is_animated = false;
        const Json* animations = member(json_, "animations");
        if (!animations) return false;
        for_each_object(*animations, [&](const Json& object) {
            is_animated =
                is_animated || (text_member(object, "path") == "weights" &&
                                index_member(object, "node", "an animation") == index_of(node));
        });
        return is_animated;
    }

    std::size_t add_child(std::size_t parent, const std::string& name) {
        Json& nodes = json_["nodes"];
        const std::size_t number = nodes.size();
        nodes.push_back(json_object({{"name", name}}));
        list_in(nodes[parent], "children").push_back(number);
        return number;
    }

    void put_mesh(std::size_t node, Json mesh) {
        Json& primitive = mesh["primitives"][0];
        Json& json = json_["nodes"][node];
        if (!primitive["attributes"].contains("JOINTS_0")) json.erase("skin");
        const Json* weights = member(json, "weights");
        if (weights && weights->size() != size_of_member(primitive, "targets")) {
            json.erase("weights");
        }
        json["mesh"] = json_["meshes"].size();
        json_["meshes"].push_back(std::move(mesh));
    }

    PlacedMaterial placed_material(Index label) {
        if (label == kNoIndex) return {};
        const std::string& name = materials_->names[label];
        const auto known = new_materials_.find(name);
        std::size_t number = 0;
        if (asset_ && asset_->material_of_label.contains(name)) {
            number = asset_->material_of_label.at(name);
        } else if (known != new_materials_.end()) {
            number = known->second;
        } else {
            Json& materials = list_in(json_, "materials");
            number = new_materials_[name] = materials.size();
            materials.push_back(json_object({{"name", name}}));
        }
        return {index_of(number), uv_count(json_["materials"][number])};
    }

    void write_kept_accessors() {
        if (!asset_) return;
        std::vector<std::size_t> numbers;
        for (const KeptAccessor& kept : asset_->accessors) {
            numbers.push_back(binary_.add(kept.json, *kept.bytes));
        }
        const auto renumber = [&](Json& object, const char* key) {
            if (Json* number = member(object, key)) *number = numbers[number->get<std::size_t>()];
        };
        if (Json* skins = member(json_, "skins")) {
            for (Json& skin : *skins) renumber(skin, "inverseBindMatrices");
        }
        if (Json* animations = member(json_, "animations")) {
            for (Json& animation : *animations) {
                for (Json& sampler : list_in(animation, "samplers")) {
                    renumber(sampler, "input");
                    renumber(sampler, "output");
                }
            }
        }
    }

    void write_images() {
        if (!asset_) return;
        for (std::size_t i = 0; i < asset_->images.size(); ++i) {
            if (!asset_->images[i]) continue;
            json_["images"][i]["bufferView"] = binary_.add_view(*asset_->images[i]);
        }
    }

    std::size_t target_count(const Json& node) const {
        const Json* mesh = member(node, "mesh");
        if (!mesh) return 0;
        return size_of_member(json_["meshes"][mesh->get<std::size_t>()]["primitives"][0],
                              "targets");
    }

    // Animations of weights need targets.
    bool is_idle(const Json& channel) const {
        const Json* target = member(channel, "target");
        if (!target || text_member(*target, "path") != "weights") return false;
        const int node = index_member(*target, "node", "an animation");
        const Json* nodes = member(json_, "nodes");
        return node >= 0 && nodes && at(node) < nodes->size() && target_count((*nodes)[node]) == 0;
    }

    void clean_animations() {
        Json* animations = member(json_, "animations");
        if (!animations) return;
        Json rest = Json::array();
        std::size_t lost = 0;
        for (Json& animation : *animations) {
            Json channels = Json::array();
            for (Json& channel : list_in(animation, "channels")) {
                if (is_idle(channel)) {
                    ++lost;
                } else {
                    channels.push_back(std::move(channel));
                }
            }
            if (channels.empty()) continue;
            animation["channels"] = std::move(channels);
            rest.push_back(std::move(animation));
        }
        *animations = std::move(rest);
        if (lost == 0) return;
        context_.log(LogLevel::warning,
                     std::to_string(lost) +
                         " animations of morph weights were not saved: their objects have no "
                         "targets, or are part of other objects now");
    }

    void clean_nodes() {
        if (Json* nodes = member(json_, "nodes")) {
            for (Json& node : *nodes) {
                if (!node.contains("mesh")) {
                    node.erase("skin");
                    node.erase("weights");
                }
                erase_if_empty(node, "children");
            }
        }
        if (Json* scenes = member(json_, "scenes")) {
            for (Json& scene : *scenes) erase_if_empty(scene, "nodes");
        }
    }

    void declare_extensions() {
        std::vector<std::string> used = extensions_inside(json_);
        if (has_integers_) used.emplace_back("KHR_mesh_quantization");
        std::sort(used.begin(), used.end());
        std::set<std::string> required;
        if (const Json* old = member(json_, "extensionsRequired")) {
            for (const Json& name : *old) {
                if (std::find(used.begin(), used.end(), name) != used.end()) {
                    required.insert(name.get<std::string>());
                }
            }
        }
        for (const std::string name :
             {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization"}) {
            if (std::find(used.begin(), used.end(), name) != used.end()) required.insert(name);
        }
        json_["extensionsUsed"] = used;
        json_["extensionsRequired"] = required;
        erase_if_empty(json_, "extensionsUsed");
        erase_if_empty(json_, "extensionsRequired");
    }

    void clean() {
        clean_animations();
        clean_nodes();
        for (const char* key : {"animations", "cameras", "images", "materials", "meshes", "nodes",
                                "samplers", "scenes", "skins", "textures"}) {
            erase_if_empty(json_, key);
        }
    }

    SavedParts& parts_;
    const SaveOptions& options_;
    bool moves_origin_;
    const Context& context_;
    const GltfAsset* asset_;
    WrittenAttributes attributes_;
    Json json_ = Json::object(), old_meshes_;
    std::vector<Affine> world_;
    std::vector<int> old_mesh_;
    const FaceLabels* objects_ = nullptr;
    const FaceLabels* materials_ = nullptr;
    std::map<std::string, std::size_t> new_materials_;
    bool has_integers_ = false;
    GltfBinary binary_;
};

// The asset was checked when it was read, but not every member of it.
Json document_of(DocumentWriter& writer) {
    try {
        return writer.write();
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::unsupported,
                    "contents of the mesh's file beside its surface cannot be saved: " +
                        std::string(error.what()));
    }
}

}  // namespace

void write_gltf(SavedParts& parts, const SaveOptions& options, std::string& bytes,
                const Context& context) {
    DocumentWriter writer(parts, options, context);
    Json json = document_of(writer);
    if (!writer.binary().empty()) json["buffers"][0]["uri"] = make_data_uri(writer.binary());
    bytes = to_text(json);
}

void write_glb(SavedParts& parts, const SaveOptions& options, std::string& bytes,
               const Context& context) {
    DocumentWriter writer(parts, options, context);
    const std::string json = to_text(document_of(writer));
    bytes = make_glb(json, writer.binary());
}

}  // namespace lissom
