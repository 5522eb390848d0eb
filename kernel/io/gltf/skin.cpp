#include "kernel/io/gltf/skin.h"

#include <Eigen/Geometry>
#include <utility>

#include "kernel/io/gltf/animation.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/io/gltf/file/tiny_gltf.h"
#include "kernel/io/gltf/nodes.h"
#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

std::size_t add_numbers(GltfAsset& asset, const std::vector<float>& values, const char* type,
                        std::size_t width) {
    std::string bytes;
    for (const float value : values) append_number(bytes, value, Endianness::little);
    Json json = json_object({{"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT},
                             {"count", values.size() / width},
                             {"type", type}});
    asset.accessors.push_back(
        {std::move(json), std::make_shared<const std::string>(std::move(bytes))});
    return asset.accessors.size() - 1;
}

// The inverse of a translation for each joint, column by column.
std::size_t add_inverse_bind_matrices(GltfAsset& asset, const std::vector<Vec3>& centers) {
    constexpr std::size_t kFloats = 16;
    std::vector<float> values;
    for (const Vec3& center : centers) {
        Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
        matrix.topRightCorner<3, 1>() = -center.cast<float>();
        values.insert(values.end(), matrix.data(), matrix.data() + kFloats);
    }
    return add_numbers(asset, values, "MAT4", kFloats);
}

Json numbers_of(const Eigen::Vector3f& v) {
    Json list = Json::array();
    for (const float x : v) list.push_back(x);
    return list;
}

// Returns the number of the first joint; the others follow it.
std::size_t add_joints(GltfAsset& asset, const std::vector<Vec3>& centers) {
    Json& scene = default_scene(asset.json);
    Json& nodes = list_in(asset.json, "nodes");
    const std::size_t root = nodes.size(), first = root + 1;
    Json children = Json::array();
    for (std::size_t j = 0; j < centers.size(); ++j) children.push_back(first + j);
    nodes.push_back(json_object({{"name", "joints"}, {"children", std::move(children)}}));
    for (std::size_t j = 0; j < centers.size(); ++j) {
        const Eigen::Vector3f place = centers[j].cast<float>();
        nodes.push_back(json_object(
            {{"name", "joint " + std::to_string(j + 1)}, {"translation", numbers_of(place)}}));
    }
    list_in(scene, "nodes").push_back(root);
    return first;
}

std::size_t add_skin(GltfAsset& asset, const std::vector<Vec3>& centers, std::size_t first) {
    Json joints = Json::array();
    for (std::size_t j = 0; j < centers.size(); ++j) joints.push_back(first + j);
    Json& skins = list_in(asset.json, "skins");
    skins.push_back(
        json_object({{"joints", std::move(joints)},
                     {"skeleton", first - 1},
                     {"inverseBindMatrices", add_inverse_bind_matrices(asset, centers)}}));
    return skins.size() - 1;
}

// Tracks of one joint: its translations and rotations.
struct JointTracks {
    std::vector<float> translations, rotations;
};

JointTracks tracks_of(const SkinKeys& keys, std::size_t joint) {
    JointTracks tracks;
    Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
    for (const auto& motions : keys.motions) {
        const Affine& motion = motions[joint];
        const Eigen::Vector3f place = (motion(keys.centers[joint])).cast<float>();
        Eigen::Quaterniond turn(motion.linear);
        turn.normalize();
        // Neighbours on the same side, so that what is between them takes the short way.
        if (turn.dot(before) < 0.0) turn.coeffs() = -turn.coeffs();
        before = turn;
        tracks.translations.insert(tracks.translations.end(), place.data(), place.data() + 3);
        const Eigen::Vector4f numbers = turn.coeffs().cast<float>();
        tracks.rotations.insert(tracks.rotations.end(), numbers.data(), numbers.data() + 4);
    }
    return tracks;
}

void add_joint_animation(GltfAsset& asset, const SkinKeys& keys, std::size_t first) {
    const std::size_t times = add_numbers(asset, keys.times, "SCALAR", 1);
    asset.accessors[times].json["min"] = Json::array({keys.times.front()});
    asset.accessors[times].json["max"] = Json::array({keys.times.back()});
    Json samplers = Json::array(), channels = Json::array();
    const auto add = [&](std::size_t node, const char* path, std::size_t output) {
        Json target = json_object({{"node", node}, {"path", path}});
        channels.push_back(
            json_object({{"sampler", samplers.size()}, {"target", std::move(target)}}));
        samplers.push_back(
            json_object({{"input", times}, {"output", output}, {"interpolation", "LINEAR"}}));
    };
    for (std::size_t j = 0; j < keys.centers.size(); ++j) {
        const JointTracks tracks = tracks_of(keys, j);
        add(first + j, "translation", add_numbers(asset, tracks.translations, "VEC3", 3));
        add(first + j, "rotation", add_numbers(asset, tracks.rotations, "VEC4", 4));
    }
    list_in(asset.json, "animations")
        .push_back(json_object({{"name", keys.name},
                                {"samplers", std::move(samplers)},
                                {"channels", std::move(channels)}}));
}

}  // namespace

std::shared_ptr<const GltfAsset> with_skin(const Mesh& mesh, const SkinKeys& keys) {
    const auto* old = dynamic_cast<const GltfAsset*>(mesh.asset().get());
    auto asset = old ? std::make_shared<GltfAsset>(*old) : std::make_shared<GltfAsset>();
    asset->from_libraries = false;
    const std::vector<char> all(at(mesh.vertex_count()), 1);
    const std::vector<std::size_t> objects = nodes_of_objects(mesh, all, *asset);
    const std::size_t first = add_joints(*asset, keys.centers);
    const std::size_t skin = add_skin(*asset, keys.centers, first);
    for (const std::size_t node : objects) asset->json["nodes"][node]["skin"] = skin;
    if (!keys.times.empty()) add_joint_animation(*asset, keys, first);
    return asset;
}

}  // namespace lissom
