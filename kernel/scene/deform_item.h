/// DeformItem: a deformation in progress in a scene, with the mesh that it deforms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/stats.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/scene_item.h"

namespace lissom {

struct ConstraintSet;
struct DeformFrame;
struct RestShape;

/// Inputs of a deformation, and its shown result.
class DeformContent : public ItemContent {
  public:
    DeformContent(Deformer& deformer, ContentStore& store);
    DeformContent(DeformSnapshot snapshot, ContentStore& store);

    /// Returns the argument of Deformer::restore.
    DeformSnapshot snapshot() const {
        return {rest_->value, constraints_->value, poses_, shown_->value};
    }

    void list_kept(std::vector<const KeptBytes*>& list) const override;
    bool operator==(const DeformContent& other) const;

  private:
    std::uint64_t compute_hash() const override;

    std::shared_ptr<const Kept<RestShape>> rest_;
    std::shared_ptr<const Kept<ConstraintSet>> constraints_;
    Poses poses_;
    std::shared_ptr<const Kept<DeformFrame>> shown_;
};

class DeformItem : public SceneItem {
  public:
    /// `mesh` is the item of the mesh that is deformed: it is captured and put back along with it.
    DeformItem(std::shared_ptr<Deformer> deformer, std::shared_ptr<SceneItem> mesh)
        : deformer_(std::move(deformer)), mesh_(std::move(mesh)) {}

    const Deformer& deformer() const { return *deformer_; }

    ItemKind kind() const override { return ItemKind::deformation; }
    const void* identity() const override { return deformer_.get(); }
    std::vector<std::shared_ptr<SceneItem>> parts() const override { return {mesh_}; }
    std::shared_ptr<const ItemContent> capture(const std::shared_ptr<const ItemContent>& last,
                                               ContentStore& store) const override;
    void restore(const ItemContent& content, const ItemContent* present) override;
    std::size_t memory_bytes() const override { return stats_of(*deformer_).factor_bytes; }

  private:
    /// Called after content was put back.
    virtual void restored() {}

    std::shared_ptr<Deformer> deformer_;
    std::shared_ptr<SceneItem> mesh_;
};

}  // namespace lissom
