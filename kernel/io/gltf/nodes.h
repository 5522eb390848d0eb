/// The nodes of a glTF file: placement of its meshes; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/io/gltf/file/accessor.h"
#include "kernel/io/gltf/file/document.h"
#include "kernel/io/gltf/file/json.h"
#include "kernel/mesh/report.h"

namespace lissom {

/// Gives each thing a name of its own.
class UniqueNames {
  public:
    /// Returns `name`, with a number after it if it is taken.
    std::string take(const std::string& name);

  private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, std::size_t> next_;
};

/// Returns the transform of every node to the world. Errors: file_syntax naming nodes that do not
/// exist, have two parents or are their own ancestors, are nested too deep, or have a transform
/// that is none.
std::vector<Affine> world_transforms(const Json& document);

/// A mesh at its place.
struct GltfInstance {
    int mesh = -1;
    /// The node, or -1 for a mesh of a file without nodes.
    int node = -1;
    /// Map to the world; the identity for skinned meshes, which their joints place.
    Affine transform;
    std::string label;
};

/// Returns the meshes of the default scene in the order of its nodes. Reports the meshes outside of
/// it. Errors: file_syntax.
std::vector<GltfInstance> find_instances(const Json& document, Report& report);

/// Replaces nodes that EXT_mesh_gpu_instancing repeats by a child for each copy. If the copies
/// would be many times larger than the file, one is kept and the report says so.
void expand_instancing(Json& document, const AccessorReader& accessors, GltfBudget& budget,
                       Report& report);

/// Returns the scene that is shown first. A document without scenes gets one of all its root nodes,
/// as it would be shown.
Json& default_scene(Json& document);

/// Returns a name for each material, made unique.
std::vector<std::string> material_names(const Json& document);

}  // namespace lissom
