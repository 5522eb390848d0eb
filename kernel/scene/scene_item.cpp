#include "kernel/scene/scene_item.h"

namespace lissom {

std::string_view kind_name(ItemKind kind) {
    constexpr std::string_view kNames[] = {"mesh", "deformation", "strands", "hairstyle",
                                           "polyline"};
    return kNames[static_cast<int>(kind)];
}

ItemContent::~ItemContent() = default;
SceneItem::~SceneItem() = default;

std::uint64_t ItemContent::hash() const {
    std::call_once(hashed_, [this] { hash_ = compute_hash(); });
    return hash_;
}

}  // namespace lissom
