#include "kernel/scene/hairstyle_item.h"

#include <algorithm>

#include "kernel/core/hasher.h"
#include "kernel/hair/style_bytes.h"
#include "kernel/io/style_file.h"
#include "kernel/scene/mesh_item.h"

namespace lissom {
namespace {

void add_frame(Hasher& hasher, const Scalp& scalp) {
    for (const double x : scalp.frame().center) hasher.add(x);
    for (const double x : scalp.frame().axes.reshaped()) hasher.add(x);
    hasher.add(scalp.scale());
    hasher.add(scalp.unit());
    hasher.add(scalp.root_faces());
}

}  // namespace

HairstyleContent::HairstyleContent(const Hairstyle& style, const StyleInputs& inputs,
                                   ContentStore& store)
    : inputs_(
          store.keep(std::make_shared<const StyleInputs>(inputs), lissom::memory_bytes(inputs))),
      options_(style.options()),
      scalp_(style.shared_scalp()) {
    count_own(store, sizeof *this);
}

void HairstyleContent::list_kept(std::vector<const KeptBytes*>& list) const {
    list.push_back(inputs_.get());
}

// Hashes the contents of a style file, and its omissions: the place on the head, and the scalp
// step.
std::uint64_t HairstyleContent::compute_hash() const {
    Hasher hasher;
    hasher.add(encode_style(content_of(inputs(), options_)));
    add_frame(hasher, *scalp_);
    for (const GridConstraint& constraint : inputs().scalp_step) {
        hasher.add(constraint.point);
        for (const auto x : constraint.value) hasher.add(static_cast<double>(x));
        hasher.add(static_cast<double>(constraint.weight));
    }
    return hasher.value();
}

bool HairstyleItem::is_head_unchanged() const {
    const auto* item = dynamic_cast<const MeshItem*>(head_.get());
    return item && is_head(item->mesh());
}

bool HairstyleItem::is_head(const Mesh& mesh) const {
    if (mesh.shared_topology() != style_->head().shared_topology()) return false;
    const auto same = [&](const Vec3& metres, const Vec3& position) {
        return metres == style_->scalp().to_metres(position);
    };
    const auto kept = style_->head().positions(), now = mesh.positions();
    return std::equal(kept.begin(), kept.end(), now.begin(), now.end(), same);
}

Mesh HairstyleItem::head_as_it_was() const {
    if (is_head_unchanged()) return dynamic_cast<const MeshItem&>(*head_).mesh();
    Mesh head = style_->head();
    for (Vec3& position : head.edit_positions()) {
        position = style_->scalp().from_metres(position);
    }
    return head;
}

std::shared_ptr<const ItemContent> HairstyleItem::capture(
    const std::shared_ptr<const ItemContent>& last, ContentStore& store) const {
    const auto* before = dynamic_cast<const HairstyleContent*>(last.get());
    if (before && before->inputs() == style_->inputs()) return last;
    return std::make_shared<const HairstyleContent>(*style_, store);
}

void HairstyleItem::restore(const ItemContent& content, const ItemContent*) {
    style_->restore(dynamic_cast<const HairstyleContent&>(content).inputs());
    restored();
}

}  // namespace lissom
