/// HairstyleItem: a hairstyle in a scene, with its curves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/hair/hairstyle.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/style_inputs.h"
#include "kernel/mesh/mesh.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/scene_item.h"

namespace lissom {

class HairstyleContent : public ItemContent {
  public:
    HairstyleContent(const Hairstyle& style, ContentStore& store)
        : HairstyleContent(style, style.inputs(), store) {}
    /// Makes the content of `style` with other inputs.
    HairstyleContent(const Hairstyle& style, const StyleInputs& inputs, ContentStore& store);

    /// Returns the argument of Hairstyle::restore.
    const StyleInputs& inputs() const { return *inputs_->value; }
    void list_kept(std::vector<const KeptBytes*>& list) const override;

  private:
    std::uint64_t compute_hash() const override;

    std::shared_ptr<const Kept<StyleInputs>> inputs_;
    // A style keeps these for life.
    HairstyleOptions options_;
    std::shared_ptr<const Scalp> scalp_;
};

class HairstyleItem : public SceneItem {
  public:
    /// `head` is the item of the mesh that the style was made on, or null if that has gone.
    explicit HairstyleItem(std::shared_ptr<Hairstyle> style,
                           std::shared_ptr<SceneItem> head = nullptr)
        : style_(std::move(style)), head_(std::move(head)) {}

    const Hairstyle& style() const { return *style_; }
    const std::shared_ptr<SceneItem>& head() const { return head_; }
    /// Returns whether the mesh has the shape that the style was made on.
    bool is_head_unchanged() const;
    /// Returns whether `mesh` is that shape.
    bool is_head(const Mesh& mesh) const;
    /// Returns the head that the style was made on: that mesh, or if it has changed the shape that
    /// the style keeps.
    Mesh head_as_it_was() const;

    ItemKind kind() const override { return ItemKind::hairstyle; }
    const void* identity() const override { return style_.get(); }
    std::shared_ptr<const ItemContent> capture(const std::shared_ptr<const ItemContent>& last,
                                               ContentStore& store) const override;
    void restore(const ItemContent& content, const ItemContent* present) override;
    std::size_t memory_bytes() const override { return style_->memory_bytes(); }

  private:
    /// Called after content was put back.
    virtual void restored() {}

    std::shared_ptr<Hairstyle> style_;
    std::shared_ptr<SceneItem> head_;
};

}  // namespace lissom
