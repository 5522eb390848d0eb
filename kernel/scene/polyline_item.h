/// PolylineItem: a free curve in a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/scene/content_store.h"
#include "kernel/scene/polyline.h"
#include "kernel/scene/scene_item.h"

namespace lissom {

class PolylineContent : public ItemContent {
  public:
    PolylineContent(const Polyline& polyline, ContentStore& store);

    const Polyline& polyline() const { return *polyline_->value; }
    void list_kept(std::vector<const KeptBytes*>& list) const override;

  private:
    std::uint64_t compute_hash() const override;

    std::shared_ptr<const Kept<Polyline>> polyline_;
};

class PolylineItem : public SceneItem {
  public:
    explicit PolylineItem(std::shared_ptr<Polyline> polyline) : polyline_(std::move(polyline)) {}

    const Polyline& polyline() const { return *polyline_; }

    ItemKind kind() const override { return ItemKind::polyline; }
    const void* identity() const override { return polyline_.get(); }
    std::shared_ptr<const ItemContent> capture(const std::shared_ptr<const ItemContent>& last,
                                               ContentStore& store) const override;
    void restore(const ItemContent& content, const ItemContent* present) override;
    std::size_t memory_bytes() const override { return polyline_->points.size() * sizeof(Vec3); }

  private:
    std::shared_ptr<Polyline> polyline_;
};

}  // namespace lissom
