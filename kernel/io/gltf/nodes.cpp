#include "kernel/io/gltf/nodes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/io/stream/json_object.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

constexpr int kMaximumDepth = 1000;

const Json& list_of(const Json& json, const char* key) {
    static const Json kNone = Json::array();
    const Json* list = member(json, key);
    return list && list->is_array() ? *list : kNone;
}

std::string node_name(std::size_t node) {
    return "node " + std::to_string(node);
}

// The numbers of the array `key`, or none if it is absent.
std::vector<double> numbers_of(const Json& node, const char* key, std::size_t count,
                               std::size_t number) {
    const Json* list = member(node, key);
    if (!list) return {};
    std::vector<double> values;
    for (const Json& value : *list) {
        if (value.is_number()) values.push_back(value.get<double>());
    }
    bool good = list->is_array() && list->size() == count && values.size() == count;
    for (const double value : values) good = good && std::isfinite(value);
    if (good) return values;
    refuse(ErrorCode::file_syntax, "'" + std::string(key) + "' of " + node_name(number) +
                                       " does not have " + std::to_string(count) + " numbers");
}

Affine local_transform(const Json& node, std::size_t number) {
    Affine result;
    if (const auto m = numbers_of(node, "matrix", 16, number); !m.empty()) {
        for (int column = 0; column < 3; ++column) {
            for (int row = 0; row < 3; ++row) result.linear(row, column) = m[4 * column + row];
        }
        result.translation = Vec3(m[12], m[13], m[14]);
        return result;
    }
    if (const auto r = numbers_of(node, "rotation", 4, number); !r.empty()) {
        const Eigen::Quaterniond q(r[3], r[0], r[1], r[2]);
        if (q.norm() > 0.0) result.linear = q.normalized().toRotationMatrix();
    }
    if (const auto s = numbers_of(node, "scale", 3, number); !s.empty()) {
        for (int column = 0; column < 3; ++column) result.linear.col(column) *= s[column];
    }
    if (const auto t = numbers_of(node, "translation", 3, number); !t.empty()) {
        result.translation = Vec3(t[0], t[1], t[2]);
    }
    return result;
}

std::vector<std::size_t> node_list(const Json& owner, const char* key, std::size_t node_count,
                                   const std::string& name) {
    std::vector<std::size_t> nodes;
    const Json* list = member(owner, key);
    if (list && !list->is_array()) {
        refuse(ErrorCode::file_syntax, "'" + std::string(key) + "' of " + name + " is not a list");
    }
    for (const Json& entry : list_of(owner, key)) {
        const bool exists = entry.is_number_unsigned() && entry.get<std::uint64_t>() < node_count;
        if (!exists) {
            refuse(ErrorCode::file_syntax,
                   name + " refers to the node " + to_text(entry) + ", which does not exist");
        }
        nodes.push_back(entry.get<std::size_t>());
    }
    return nodes;
}

// Parents and children of all nodes, which form trees.
struct Forest {
    std::vector<std::vector<std::size_t>> children;
    std::vector<std::size_t> roots;
    // All nodes, parents before children.
    std::vector<std::size_t> order;
    std::vector<std::size_t> parent;
};

constexpr std::size_t kNoParent = -1;

void find_roots(const Json& nodes, Forest& forest) {
    forest.parent.assign(nodes.size(), kNoParent);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        forest.children.push_back(node_list(nodes[n], "children", nodes.size(), node_name(n)));
        for (const std::size_t child : forest.children.back()) {
            if (forest.parent[child] != kNoParent) {
                refuse(ErrorCode::file_syntax, node_name(child) + " is a child of " +
                                                   node_name(forest.parent[child]) +
                                                   " and again of " + node_name(n));
            }
            forest.parent[child] = n;
        }
    }
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (forest.parent[n] == kNoParent) forest.roots.push_back(n);
    }
}

void find_order(Forest& forest) {
    std::vector<int> depth(forest.parent.size(), -1);
    forest.order = forest.roots;
    for (const std::size_t root : forest.roots) depth[root] = 0;
    for (std::size_t i = 0; i < forest.order.size(); ++i) {
        const std::size_t node = forest.order[i];
        if (depth[node] > kMaximumDepth) {
            refuse(ErrorCode::file_syntax, node_name(node) + " is nested deeper than " +
                                               std::to_string(kMaximumDepth) + " levels");
        }
        for (const std::size_t child : forest.children[node]) {
            depth[child] = depth[node] + 1;
            forest.order.push_back(child);
        }
    }
    for (std::size_t n = 0; n < depth.size(); ++n) {
        if (depth[n] < 0) {
            refuse(ErrorCode::file_syntax,
                   node_name(n) + " is its own ancestor or below one that is");
        }
    }
}

Forest forest_of(const Json& document) {
    Forest forest;
    find_roots(list_of(document, "nodes"), forest);
    find_order(forest);
    return forest;
}

void require_default_scene(const Json& document) {
    const int scene = index_member(document, "scene", "the file");
    if (scene < 0 || at(scene) < list_of(document, "scenes").size()) return;
    refuse(ErrorCode::file_syntax,
           "the default scene " + std::to_string(scene) + " does not exist");
}

// Nodes that the default scene starts at.
std::vector<std::size_t> scene_nodes(const Json& document, const Forest& forest) {
    const Json& scenes = list_of(document, "scenes");
    if (scenes.empty()) return forest.roots;
    const std::size_t scene = std::max(index_member(document, "scene", "the file"), 0);
    return node_list(scenes[scene], "nodes", forest.parent.size(), "a scene");
}

// The nodes of the scene, each before its children.
std::vector<std::size_t> nodes_in_scene(const Json& document, const Forest& forest) {
    std::vector<std::size_t> result, stack = scene_nodes(document, forest);
    std::vector<char> seen(forest.parent.size(), 0);
    std::reverse(stack.begin(), stack.end());
    while (!stack.empty()) {
        const std::size_t node = stack.back();
        stack.pop_back();
        if (seen[node]) continue;
        seen[node] = 1;
        result.push_back(node);
        const auto& children = forest.children[node];
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    return result;
}

std::string name_of(const Json& list, std::size_t number, const std::string& fallback) {
    const std::string name = text_member(list[number], "name");
    return name.empty() ? fallback : name;
}

std::size_t checked_mesh(const Json& node, std::size_t number, std::size_t mesh_count) {
    const int mesh = index_member(node, "mesh", node_name(number));
    if (mesh >= 0 && at(mesh) < mesh_count) return mesh;
    refuse(ErrorCode::file_syntax,
           node_name(number) + " has mesh " + std::to_string(mesh) + ", which does not exist");
}

std::vector<GltfInstance> meshes_alone(const Json& meshes) {
    std::vector<GltfInstance> result;
    UniqueNames names;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const std::string name = name_of(meshes, m, "mesh " + std::to_string(m));
        result.push_back({index_of(m), -1, {}, names.take(name)});
    }
    return result;
}

void report_unused(const std::vector<char>& used, Report& report) {
    std::size_t unused = 0;
    for (const char flag : used) unused += flag ? 0 : 1;
    if (unused == 0) return;
    report.add(FindingKind::content_skipped, unused,
               std::to_string(unused) + (unused == 1 ? " mesh is" : " meshes are") +
                   " not in the default scene");
}

Json array_of(const AccessorValues& values, std::size_t i) {
    Json list = Json::array();
    for (Index k = 0; k < values.width; ++k) {
        list.push_back(values.values[i * values.width + k]);
    }
    return list;
}

struct InstanceTransforms {
    const char* key;
    AccessorValues values;
};

std::vector<InstanceTransforms> instance_transforms(const Json& attributes,
                                                    const AccessorReader& accessors,
                                                    std::size_t node) {
    std::vector<InstanceTransforms> result;
    const std::pair<const char*, const char*> kinds[] = {
        {"TRANSLATION", "translation"}, {"ROTATION", "rotation"}, {"SCALE", "scale"}};
    for (const auto& [name, key] : kinds) {
        const int accessor = index_member(attributes, name, node_name(node));
        if (accessor < 0) continue;
        AccessorValues values = accessors.values(accessor);
        const Index width = name == std::string_view("ROTATION") ? 4 : 3;
        const bool fits =
            values.width == width && (result.empty() || result[0].values.count == values.count);
        if (!fits) {
            refuse(ErrorCode::file_syntax,
                   "the copies of " + node_name(node) + " have numbers that do not fit");
        }
        result.push_back({key, std::move(values)});
    }
    return result;
}

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
constexpr std::size_t kElementsPerNode = 64;

std::size_t count_of_accessor(const Json& document, const Json& owner, const char* key) {
    const Json& accessors = list_of(document, "accessors");
    const int accessor = index_member(owner, key, "a primitive");
    if (accessor < 0 || at(accessor) >= accessors.size()) return 0;
    const int count = index_member(accessors[accessor], "count", "accessor");
    return count > 0 ? at(count) : 0;
}

// Vertices and corners of the mesh of a node.
std::size_t elements_of_mesh(const Json& document, const Json& node, std::size_t number) {
    const Json& meshes = list_of(document, "meshes");
    const Json& mesh = meshes[checked_mesh(node, number, meshes.size())];
    std::size_t sum = 0;
    for (const Json& primitive : list_of(mesh, "primitives")) {
        if (const Json* attributes = member(primitive, "attributes"))
            sum += count_of_accessor(document, *attributes, "POSITION");
        sum += count_of_accessor(document, primitive, "indices");
    }
    return sum;
}

// Gives node `n` a child for each copy in place of its mesh.
void add_copies(Json& nodes, std::size_t n, const std::vector<InstanceTransforms>& transforms) {
    Json copy = json_object({{"mesh", nodes[n]["mesh"]}});
    if (nodes[n].contains("name")) copy["name"] = nodes[n]["name"];
    Json children = nodes[n].value("children", Json::array());
    for (std::size_t i = 0; i < transforms[0].values.count; ++i) {
        for (const auto& transform : transforms)
            copy[transform.key] = array_of(transform.values, i);
        children.push_back(nodes.size());
        nodes.push_back(copy);
    }
    nodes[n].erase("mesh");
    nodes[n]["children"] = std::move(children);
}

// Root nodes that a document without scenes shows.
Json root_nodes(const Json& json) {
    std::vector<char> has_parent(size_of_member(json, "nodes"), 0);
    for (std::size_t n = 0; n < has_parent.size(); ++n) {
        const Json* children = member(json["nodes"][n], "children");
        if (!children) continue;
        for (const Json& child : *children) has_parent[child.get<std::size_t>()] = 1;
    }
    Json roots = Json::array();
    for (std::size_t n = 0; n < has_parent.size(); ++n) {
        if (!has_parent[n]) roots.push_back(n);
    }
    return roots;
}

}  // namespace

std::string UniqueNames::take(const std::string& name) {
    if (taken_.insert(name).second) return name;
    std::size_t& next = next_[name];
    for (next = std::max<std::size_t>(next, 2);; ++next) {
        const std::string numbered = name + " " + std::to_string(next);
        if (taken_.insert(numbered).second) return numbered;
    }
}

std::vector<Affine> world_transforms(const Json& document) {
    const Json& nodes = list_of(document, "nodes");
    const Forest forest = forest_of(document);
    std::vector<Affine> world(nodes.size());
    for (const std::size_t node : forest.order) {
        world[node] = local_transform(nodes[node], node);
        const std::size_t parent = forest.parent[node];
        if (parent != kNoParent) world[node] = world[parent] * world[node];
    }
    return world;
}

std::vector<GltfInstance> find_instances(const Json& document, Report& report) {
    const Json &nodes = list_of(document, "nodes"), &meshes = list_of(document, "meshes");
    require_default_scene(document);
    if (nodes.empty()) return meshes_alone(meshes);
    const Forest forest = forest_of(document);
    const std::vector<Affine> world = world_transforms(document);
    std::vector<GltfInstance> result;
    std::vector<char> used(meshes.size(), 0);
    UniqueNames names;
    for (const std::size_t n : nodes_in_scene(document, forest)) {
        if (!member(nodes[n], "mesh")) continue;
        const std::size_t mesh = checked_mesh(nodes[n], n, meshes.size());
        used[mesh] = 1;
        const std::string name = name_of(nodes, n, name_of(meshes, mesh, node_name(n)));
        const bool is_skinned = member(nodes[n], "skin") != nullptr;
        result.push_back(
            {index_of(mesh), index_of(n), is_skinned ? Affine() : world[n], names.take(name)});
    }
    report_unused(used, report);
    return result;
}

void expand_instancing(Json& document, const AccessorReader& accessors, GltfBudget& budget,
                       Report& report) {
    Json* nodes = member(document, "nodes");
    const std::size_t count = nodes ? nodes->size() : 0;
    std::size_t planned = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const Json* instancing = extension((*nodes)[n], kInstancing);
        const Json* attributes = instancing ? member(*instancing, "attributes") : nullptr;
        if (!attributes || !(*nodes)[n].contains("mesh")) continue;
        const auto transforms = instance_transforms(*attributes, accessors, n);
        if (transforms.empty()) continue;
        const std::size_t copies = transforms[0].values.count;
        const std::size_t each = kElementsPerNode + elements_of_mesh(document, (*nodes)[n], n);
        if (copies > 0 && budget.allows(planned) && budget.allows(planned + each * copies)) {
            planned += each * copies;
            budget.charge(kElementsPerNode * copies);
            add_copies(*nodes, n, transforms);
        } else {
            report.add(FindingKind::extensions_dropped, 1,
                       std::string(kInstancing) + " (the " + std::to_string(copies) +
                           " copies of " + node_name(n) +
                           " would be many times larger than the file; one is kept)");
        }
        Json& node = (*nodes)[n];
        node["extensions"].erase(kInstancing);
        if (node["extensions"].empty()) node.erase("extensions");
    }
}

Json& default_scene(Json& json) {
    if (size_of_member(json, "scenes") == 0) {
        json["scenes"] = Json::array({json_object({{"nodes", root_nodes(json)}})});
        json["scene"] = 0;
    }
    const Json* scene = member(json, "scene");
    return json["scenes"][scene ? scene->get<std::size_t>() : 0];
}

std::vector<std::string> material_names(const Json& document) {
    const Json& materials = list_of(document, "materials");
    std::vector<std::string> result;
    UniqueNames names;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        result.push_back(names.take(name_of(materials, m, "material " + std::to_string(m))));
    }
    return result;
}

}  // namespace lissom
