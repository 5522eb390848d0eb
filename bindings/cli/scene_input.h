/// Scene files as the input of verbs: the meshes and the hair that they hold.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"
#include "kernel/scene/scene_state.h"

namespace lissom::cli {

/// Returns whether a path is that of a scene: a file with the extension .lissom, or a folder with a
/// scene.json.
bool is_scene_path(const std::filesystem::path& path);

/// Returns whether the extension of a path is that of a hair file that can be read, of meshes too.
bool may_hold_hair(const std::filesystem::path& path);

/// Returns whether the extension of a path is that of a hair file that can be read, and not one of
/// meshes.
bool is_hair_path(const std::filesystem::path& path);

/// Returns the extensions of files that hold hair and no meshes.
std::vector<std::string> hair_only_extensions();

/// An object of a scene, placed by its transform.
struct SceneObject {
    std::string name;
    /// "mesh", "strands", "deformation", "hairstyle", "polyline".
    std::string kind;
    bool visible = true;
    /// Null for objects of other kinds.
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Strands> strands;
};

/// Reads the objects of a scene. Errors: as load_scene.
ObjectList read_scene_list(const std::filesystem::path& path, const Context& context);

/// Reads the objects of a scene with their transforms applied. Errors: as load_scene.
std::vector<SceneObject> read_scene(const std::filesystem::path& path, const Context& context);

/// Returns the visible meshes among the objects of the scene at `path` as one, in which each object
/// has a face label "object" of its name, unless its faces have such labels. Warnings name the
/// other visible objects. Errors: mesh_empty if there is no mesh.
Mesh joined_scene_mesh(const std::filesystem::path& path, const std::vector<SceneObject>& objects,
                       const Context& context);

/// Returns the visible hair among the objects of the scene at `path` as one. Warnings name the
/// other visible objects. Errors: invalid_argument if there is none, or if its points are too many
/// to be numbered.
Strands joined_scene_strands(const std::filesystem::path& path,
                             const std::vector<SceneObject>& objects, const Context& context);

}  // namespace lissom::cli
