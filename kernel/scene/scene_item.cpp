#include "kernel/scene/scene_item.h"

namespace lissom {

std::string_view kind_name(ItemKind kind) {
    constexpr std::string_view kNames[] = {"mesh", "deformation", "strands", "hairstyle",
                                           "polyline"};
    return kNames[static_cast<int>(kind)];
}

ItemContent::~ItemContent() = default;
SceneItem::~SceneItem() = default;

void ItemContent::count_own(const ContentStore& store, std::size_t bytes) {
    // Blocks of the allocator, and the small objects that hold what is shared.
    constexpr std::size_t kBeside = 512;
    own_ = store.charge_beside(bytes + kBeside);
}

std::uint64_t ItemContent::hash() const {
    std::call_once(hashed_, [this] { hash_ = compute_hash(); });
    return hash_;
}

}  // namespace lissom
