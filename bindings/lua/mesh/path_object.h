/// A path or boundary of a script with the mesh that it runs on.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/mesh/query/path.h"

namespace lissom::lua {

struct PathObject {
    static constexpr const char* kTypeName = "lissom.Path";

    PathObject(std::shared_ptr<MeshObject> owner, Path content)
        : mesh(std::move(owner)), path(std::move(content)) {}

    std::shared_ptr<MeshObject> mesh;
    Path path;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const {
        const std::size_t points = path.on_mesh() ? 0 : path.points().size();
        return path.vertices().size() * sizeof(Index) + points * sizeof(Vec3);
    }
    /// Returns the path. Throws topology_mismatch if the mesh was closed or has another topology.
    const Path& current() const;
};

/// Pushes a list of `paths` on `mesh`, which are moved from. Both are owned by more than a local.
int push_paths(Call& call, const std::shared_ptr<MeshObject>& mesh, std::vector<Path>& paths);

}  // namespace lissom::lua
