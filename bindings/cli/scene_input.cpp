#include "bindings/cli/scene_input.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/record/file_rules.h"
#include "kernel/io/strand_file.h"
#include "kernel/io/stream/file.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/scene_file.h"
#include "kernel/scene/strands_item.h"

namespace lissom::cli {
namespace fs = std::filesystem;
namespace {

std::shared_ptr<const Mesh> placed(std::shared_ptr<const Mesh> mesh, const Affine& map,
                                   const Context& context) {
    if (map.is_identity()) return mesh;
    Mesh moved = *mesh;
    transform(moved, map, context);
    return std::make_shared<const Mesh>(std::move(moved));
}

std::shared_ptr<const Strands> placed(std::shared_ptr<const Strands> strands, const Affine& map,
                                      const Context& context) {
    if (map.is_identity()) return strands;
    Strands moved = *strands;
    transform(moved, map, context);
    return std::make_shared<const Strands>(std::move(moved));
}

SceneObject object_of(const NamedObject& object, const Context& context) {
    SceneObject result{object.name, std::string(kind_name(object.item->kind())),
                       object.look.visible, nullptr, nullptr};
    const Affine& map = object.look.transform;
    if (const auto* mesh = dynamic_cast<const MeshItem*>(object.item.get())) {
        result.mesh = placed(mesh->shared_mesh(), map, context);
    } else if (const auto* strands = dynamic_cast<const StrandsItem*>(object.item.get())) {
        result.strands = placed(strands->shared_strands(), map, context);
    }
    return result;
}

void label_object(Mesh& mesh, const std::string& name) {
    auto& labels = mesh.attributes().labels();
    if (mesh.face_count() == 0 || labels.contains("object")) return;
    labels["object"] = {{name}, std::vector<Index>(at(mesh.face_count()), 0)};
}

std::string listed(const std::vector<std::string>& extensions) {
    std::string text;
    for (const std::string& extension : extensions)
        text += (text.empty() ? "." : ", .") + extension;
    return text;
}

// A deformation holds nothing that is seen but its mesh, which is an object of its own.
bool is_left_out(const SceneObject& object, std::string_view kind) {
    return object.visible &&
           (object.kind == kind || object.kind == "polyline" || object.kind == "hairstyle");
}

// Warns of the visible objects of `kind`, and of those that no file but a scene holds.
void warn_of_left_out(const fs::path& path, const std::vector<SceneObject>& objects,
                      std::string_view kind, const std::string& remedy, const Context& context) {
    std::string names;
    bool any_of_kind = false;
    for (const SceneObject& object : objects) {
        if (!is_left_out(object, kind)) continue;
        names += (names.empty() ? "'" : ", '") + object.name + "' (" + object.kind + ")";
        any_of_kind = any_of_kind || object.kind == kind;
    }
    if (names.empty()) return;
    context.log(LogLevel::warning, display_name(path) + ": left out: " + names + "; " +
                                       (any_of_kind ? remedy : "only scenes hold them"));
}

bool has_one_of(const fs::path& path, const std::vector<std::string>& known) {
    const std::string extension = normalized_extension(display_name(path.extension()));
    return std::find(known.begin(), known.end(), extension) != known.end();
}

}  // namespace

bool is_scene_path(const fs::path& path) {
    std::error_code error;
    const std::string extension = display_name(path.extension());
    if (extension == ".lissom" || extension == ".LISSOM") return true;
    return fs::is_directory(path, error) && fs::exists(path / "scene.json", error);
}

bool may_hold_hair(const fs::path& path) {
    return has_one_of(path, readable_strand_extensions());
}

// A file of both kinds, .ply, counts as a mesh.
bool is_hair_path(const fs::path& path) {
    return may_hold_hair(path) && !has_one_of(path, readable_extensions());
}

std::vector<std::string> hair_only_extensions() {
    std::vector<std::string> result;
    const std::vector<std::string>& of_meshes = writable_extensions();
    for (const std::string& extension : writable_strand_extensions()) {
        if (std::find(of_meshes.begin(), of_meshes.end(), extension) == of_meshes.end()) {
            result.push_back(extension);
        }
    }
    return result;
}

ObjectList read_scene_list(const fs::path& path, const Context& context) {
    Scene scene;
    ItemMaker maker;
    load_scene(path, scene, maker, context);
    return scene.objects();
}

std::vector<SceneObject> read_scene(const fs::path& path, const Context& context) {
    std::vector<SceneObject> objects;
    for (const auto& object : read_scene_list(path, context)) {
        objects.push_back(object_of(*object, context));
    }
    return objects;
}

Mesh joined_scene_mesh(const fs::path& path, const std::vector<SceneObject>& objects,
                       const Context& context) {
    std::optional<Mesh> result;
    for (const SceneObject& object : objects) {
        if (!object.mesh || !object.visible) continue;
        Mesh mesh = *object.mesh;
        label_object(mesh, object.name);
        if (result) {
            for (const std::string& warning : append(*result, mesh, context)) {
                context.log(LogLevel::warning, display_name(path) + ": " + warning);
            }
        } else {
            result = std::move(mesh);
        }
    }
    if (!result) {
        throw Error(ErrorCode::mesh_empty, display_name(path) +
                                               ": the scene has no visible mesh; lissom inspect "
                                               "lists its contents");
    }
    warn_of_left_out(path, objects, "strands",
                     "write the hair to a file of its own (" + listed(hair_only_extensions()) + ")",
                     context);
    return std::move(*result);
}

Strands joined_scene_strands(const fs::path& path, const std::vector<SceneObject>& objects,
                             const Context& context) {
    std::optional<Strands> result;
    for (const SceneObject& object : objects) {
        if (!object.strands || !object.visible) continue;
        if (result) {
            append(*result, *object.strands);
        } else {
            result = *object.strands;
        }
    }
    if (!result) {
        throw Error(ErrorCode::invalid_argument, display_name(path) +
                                                     ": the scene has no visible hair; lissom "
                                                     "inspect lists its contents");
    }
    warn_of_left_out(
        path, objects, "mesh",
        "write the meshes to a file of their own (" + listed(writable_extensions()) + ")", context);
    return std::move(*result);
}

}  // namespace lissom::cli
