/// A deformation of a script with the mesh that it deforms, and its handles.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bindings/lua/core/registry.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/deform/attach/attachment.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom::lua {

/// A mesh that follows the surface of a deformer.
struct AttachedMesh {
    std::shared_ptr<MeshObject> mesh;
    std::shared_ptr<const Topology> topology;
    Attachment attachment;
};

struct DeformObject {
    static constexpr const char* kTypeName = "lissom.Deformer";

    DeformObject(std::shared_ptr<MeshObject> owner, Deformer made)
        : DeformObject(std::move(owner), std::make_shared<Deformer>(std::move(made))) {}
    DeformObject(std::shared_ptr<MeshObject> owner, std::shared_ptr<Deformer> shared)
        : mesh(std::move(owner)),
          topology(mesh->mesh.shared_topology()),
          content(std::move(shared)) {}

    std::shared_ptr<MeshObject> mesh;
    std::shared_ptr<const Topology> topology;
    /// Empty once it was closed.
    std::shared_ptr<Deformer> content;
    std::vector<AttachedMesh> attached;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const;
    /// Bytes of handles, constraints and the list of attached meshes.
    std::size_t held_bytes() const;
    /// Writes the last result into the mesh, and moves the attached meshes along; after an error
    /// all are as before. Throws topology_mismatch if an attached mesh has another topology by now.
    void show_result(const Context& context);
    /// Throws handle_removed if it was closed, topology_mismatch if the mesh has another topology
    /// by now or was closed.
    Deformer& deformer();
};

struct HandleObject {
    static constexpr const char* kTypeName = "lissom.Handle";

    std::shared_ptr<DeformObject> edit;
    HandleId id;
};

/// Returns the bytes of a handle of so many vertices or points, at most about.
constexpr std::size_t handle_bytes(std::size_t size) {
    return 1024 + 128 * size;
}

/// Pushes contacts as a lissom.Contacts, on top of values of its own.
void push_contacts(Call& call, const DeformObject& edit, const std::vector<FacePair>& pairs);

/// Returns the method contacts of a deformer.
std::vector<Function> contact_methods();

/// Returns the methods add_bones and bones of a deformer.
Function add_bones_method();
Function list_bones_method();

/// Returns the methods attach and detach of a deformer.
std::vector<Function> attachment_methods();

}  // namespace lissom::lua
