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
#include "kernel/scene/content_store.h"
#include "kernel/scene/scene_item.h"

namespace lissom {

class HairstyleContent : public ItemContent {
  public:
    HairstyleContent(const Hairstyle& style, ContentStore& store);

    /// To be given to Hairstyle::restore.
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
    explicit HairstyleItem(std::shared_ptr<Hairstyle> style) : style_(std::move(style)) {}

    const Hairstyle& style() const { return *style_; }

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
};

}  // namespace lissom
