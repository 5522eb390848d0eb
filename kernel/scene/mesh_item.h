/// MeshItem: a mesh in a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "kernel/mesh/asset.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/report.h"
#include "kernel/mesh/topology.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/scene_item.h"
#include "kernel/scene/shared_blocks.h"

namespace lissom {

/// A mesh at one time. Positions and the values of attributes are shared by blocks, all else as a
/// whole.
class MeshContent : public ItemContent {
  public:
    /// Shares with `last`, which may be null; positions that are known to be the same are not
    /// compared.
    MeshContent(const Mesh& mesh, const MeshContent* last, bool same_positions,
                ContentStore& store);

    /// Returns the mesh again, with all that it held.
    Mesh mesh() const;
    /// Puts it back into `mesh`, which holds `present` now; false if that has another form, so that
    /// more than numbers must change.
    bool write_numbers(Mesh& mesh, const MeshContent& present) const;
    const Topology& topology() const { return *topology_->value; }

    void list_kept(std::vector<const KeptBytes*>& list) const override;
    bool operator==(const MeshContent& other) const;

  private:
    using Labels = std::map<std::string, FaceLabels, std::less<>>;
    using Regions = std::map<std::string, Region, std::less<>>;
    struct AttributeContent {
        // Attribute without its values.
        Attribute form;
        SharedBlocks values;
    };

    std::uint64_t compute_hash() const override;
    bool same_form(const MeshContent& other) const;
    std::size_t own_bytes() const;

    std::shared_ptr<const Kept<Topology>> topology_;
    SharedBlocks positions_;
    std::vector<AttributeContent> attributes_;
    std::shared_ptr<const Kept<Labels>> labels_;
    std::shared_ptr<const Kept<Regions>> regions_;
    std::shared_ptr<const Kept<Asset>> asset_;
    std::shared_ptr<const Kept<Report>> report_;
    std::vector<std::string> material_libraries_;
};

/// Positions are compared with those captured before only if the mesh's revision has grown: callers
/// that write through an old span of edit_positions() call it again.
class MeshItem : public SceneItem {
  public:
    explicit MeshItem(std::shared_ptr<Mesh> mesh) : mesh_(std::move(mesh)) {}

    const Mesh& mesh() const { return *mesh_; }
    std::shared_ptr<const Mesh> shared_mesh() const { return mesh_; }

    ItemKind kind() const override { return ItemKind::mesh; }
    const void* identity() const override { return mesh_.get(); }
    std::shared_ptr<const ItemContent> capture(const std::shared_ptr<const ItemContent>& last,
                                               ContentStore& store) const override;
    void restore(const ItemContent& content, const ItemContent* present) override;
    std::size_t memory_bytes() const override {
        return mesh_->memory_bytes() - mesh_->topology().memory_bytes();
    }

  private:
    /// Called after content was put back.
    virtual void restored() {}

    std::shared_ptr<Mesh> mesh_;
    // The last capture, and the mesh's revision then.
    mutable std::weak_ptr<const ItemContent> captured_;
    mutable std::uint64_t revision_ = 0;
};

}  // namespace lissom
