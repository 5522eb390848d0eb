/// The mesh of a script and values computed for its present shape.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "bindings/lua/core/call.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"

namespace lissom::lua {

struct MeshObject {
    static constexpr const char* kTypeName = "lissom.Mesh";

    MeshObject() = default;
    explicit MeshObject(Mesh content) : mesh(std::move(content)) {}

    Mesh mesh;
    bool closed = false;
    /// Grows with every call that may replace the topology or the attributes: typed buffers look
    /// for their values again then.
    std::uint64_t changes = 0;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const;
    /// To be called after every change but of single positions. Values computed for one shape are
    /// dropped, but a tree for the same topology, which is refitted when it is next asked for.
    void changed();
    /// Frees everything; regions and other dependents then refuse to work.
    void close();

    /// These are kept until the shape changes.
    const SpatialTree& tree(const Context& context);
    const HeatDistances& heat(const Context& context);
    const std::vector<Vec3>& normals();

  private:
    // Values computed for one shape; of the tree only the topology is sure to match.
    struct Derived {
        std::shared_ptr<const Topology> topology;
        std::optional<std::uint64_t> revision;
        std::optional<SpatialTree> tree;
        bool tree_is_current = false;
        std::optional<HeatDistances> heat;
        std::vector<Vec3> normals;
    };

    Derived& derived();
    void forget_shape();

    Derived derived_;
};

/// A region with the mesh that it was made for.
struct RegionObject {
    static constexpr const char* kTypeName = "lissom.Region";

    RegionObject(std::shared_ptr<MeshObject> owner, Region content)
        : mesh(std::move(owner)), region(std::move(content)) {}

    std::shared_ptr<MeshObject> mesh;
    Region region;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return region.vertices().size() * sizeof(Index); }
    /// Returns the region. Throws topology_mismatch if the mesh has another topology by now or was
    /// closed.
    const Region& current() const;
};

/// Throws topology_mismatch if `mesh` was closed or no longer has `topology`.
void require_current(const MeshObject& mesh, const std::shared_ptr<const Topology>& topology,
                     const char* what);

/// Pushes the mesh that an object belongs to. Fails if it was closed.
int push_owner(Call& call, const std::shared_ptr<MeshObject>& mesh);

/// Runs work(Mesh&), which changes the mesh of a method in place, and returns that mesh.
template <typename Work>
int change_mesh(Call& call, const Work& work) {
    const auto mesh = call.self<MeshObject>();
    const bool done = call.attempt([&] {
        work(mesh->mesh);
        mesh->changed();
    });
    if (!done) return call.fail();
    call.charge(mesh);
    return call.push_argument();
}

/// Returns the new mesh that work() makes.
template <typename Work>
int new_mesh(Call& call, const Work& work) {
    const auto result = call.create<MeshObject>();
    if (!call.attempt([&] { result.set(std::make_shared<MeshObject>(work())); }))
        return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

/// Returns the region that work() makes on `mesh`.
template <typename Work>
int new_region(Call& call, const Ref<MeshObject>& mesh, const Work& work) {
    const auto result = call.create<RegionObject>();
    const bool done =
        call.attempt([&] { result.set(std::make_shared<RegionObject>(mesh.share(), work())); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

/// Returns the number, boolean or text that work() computes, which must be plain data.
template <typename Work>
int compute(Call& call, const Work& work) {
    decltype(work()) result{};
    if (!call.attempt([&] { result = work(); })) return call.fail();
    return call.push(result);
}

/// Pushes a lissom.Bounds.
int push_bounds(const Call& call, const Box& box);

/// Throws out_of_range: the mesh has no `kind` called `name`; hints at the nearest of `names`.
[[noreturn]] void refuse_absent(const char* what, std::string_view name,
                                const std::vector<std::string_view>& names);

/// Fails with out_of_range, naming the id from 1, if `id` is not below `count`.
bool check_id(Call& call, Index id, Index count, ElementKind kind);

}  // namespace lissom::lua
