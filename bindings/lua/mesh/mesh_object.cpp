#include "bindings/lua/mesh/mesh_object.h"

#include <utility>

#include "kernel/core/nearest.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom::lua {
namespace {

// A query then takes some times as long as after building the tree again, which takes the time of
// tens of thousands of queries.
constexpr double kWornOut = 4.0;

}  // namespace

std::size_t MeshObject::memory_bytes() const {
    return mesh.memory_bytes() + (derived_.tree ? derived_.tree->memory_bytes() : 0);
}

void MeshObject::forget_shape() {
    const bool same_topology = derived_.topology == mesh.shared_topology();
    Derived next;
    next.topology = mesh.shared_topology();
    if (same_topology) next.tree = std::move(derived_.tree);
    derived_ = std::move(next);
}

void MeshObject::changed() {
    ++changes;
    forget_shape();
}

void MeshObject::close() {
    mesh = Mesh();
    closed = true;
    changed();
}

MeshObject::Derived& MeshObject::derived() {
    if (derived_.topology != mesh.shared_topology() || derived_.revision != mesh.revision()) {
        forget_shape();
        derived_.revision = mesh.revision();
    }
    return derived_;
}

const SpatialTree& MeshObject::tree(const Context& context) {
    Derived& kept = derived();
    if (kept.tree_is_current) return *kept.tree;
    if (kept.tree) kept.tree->refit(mesh, context);
    if (!kept.tree || kept.tree->wear() > kWornOut) kept.tree.emplace(mesh, context);
    kept.tree_is_current = true;
    return *kept.tree;
}

const HeatDistances& MeshObject::heat(const Context& context) {
    Derived& kept = derived();
    if (!kept.heat) kept.heat.emplace(mesh, context);
    return *kept.heat;
}

const std::vector<Vec3>& MeshObject::normals() {
    Derived& kept = derived();
    if (kept.normals.empty()) kept.normals = vertex_normals(mesh);
    return kept.normals;
}

const Region& RegionObject::current() const {
    require_current(*mesh, region.topology(), "the region");
    return region;
}

void require_current(const MeshObject& mesh, const std::shared_ptr<const Topology>& topology,
                     const char* what) {
    if (mesh.closed) {
        throw Error(ErrorCode::topology_mismatch, std::string("the mesh of ") + what +
                                                      " was closed; make it again on another mesh");
    }
    require_same_topology(mesh.mesh, topology, what);
}

int push_owner(Call& call, const std::shared_ptr<MeshObject>& mesh) {
    const bool open = call.attempt_quick([&] {
        if (mesh->closed) throw Error(ErrorCode::topology_mismatch, "the mesh was closed");
    });
    return open ? call.push_shared(mesh) : call.fail();
}

void refuse_absent(const char* what, std::string_view name,
                   const std::vector<std::string_view>& names) {
    throw Error(ErrorCode::out_of_range, std::string("the mesh has no ") + what + " '" +
                                             std::string(name) + "'" + name_hint(name, names));
}

bool check_id(Call& call, Index id, Index count, ElementKind kind) {
    if (id >= 0 && id < count) return true;
    return call.attempt_quick([&] {
        Elements elements{kind, 1, {id}};
        const std::string name = describe(elements);
        throw Error(ErrorCode::out_of_range,
                    name + " is not one of the " + std::to_string(count) + " of the mesh",
                    std::move(elements));
    });
}

}  // namespace lissom::lua
