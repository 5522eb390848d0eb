/// StrandsItem: strands in a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/hair/strands/strands.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/scene_item.h"
#include "kernel/scene/shared_blocks.h"

namespace lissom {

/// All of strands but their points; private to kernel/scene.
struct StrandFrame;

/// Strands at one time. Points are shared by blocks, all else as a whole.
class StrandsContent : public ItemContent {
  public:
    /// Shares with `last`, which may be null.
    StrandsContent(const Strands& strands, const StrandsContent* last, ContentStore& store);

    /// Returns the strands again, with all that they held.
    Strands strands() const;
    /// Puts them back into `strands`, which hold `present` now; false if more than points differ.
    bool write_points(Strands& strands, const StrandsContent& present) const;

    void list_kept(std::vector<const KeptBytes*>& list) const override;
    bool operator==(const StrandsContent& other) const {
        return points_ == other.points_ && frame_ == other.frame_;
    }

  private:
    std::uint64_t compute_hash() const override;

    SharedBlocks points_;
    std::shared_ptr<const Kept<StrandFrame>> frame_;
};

class StrandsItem : public SceneItem {
  public:
    explicit StrandsItem(std::shared_ptr<Strands> strands) : strands_(std::move(strands)) {}

    const Strands& strands() const { return *strands_; }
    std::shared_ptr<const Strands> shared_strands() const { return strands_; }

    ItemKind kind() const override { return ItemKind::strands; }
    const void* identity() const override { return strands_.get(); }
    std::shared_ptr<const ItemContent> capture(const std::shared_ptr<const ItemContent>& last,
                                               ContentStore& store) const override;
    void restore(const ItemContent& content, const ItemContent* present) override;
    std::size_t memory_bytes() const override { return strands_->memory_bytes(); }

  private:
    std::shared_ptr<Strands> strands_;
};

}  // namespace lissom
