#include "kernel/scene/polyline_item.h"

#include "kernel/core/hasher.h"

namespace lissom {

PolylineContent::PolylineContent(const Polyline& polyline, ContentStore& store)
    : polyline_(store.keep(std::make_shared<const Polyline>(polyline),
                           polyline.points.size() * sizeof(Vec3))) {
    count_own(store, sizeof *this);
}

void PolylineContent::list_kept(std::vector<const KeptBytes*>& list) const {
    list.push_back(polyline_.get());
}

std::uint64_t PolylineContent::compute_hash() const {
    Hasher hasher;
    hasher.add(polyline().closed);
    hasher.add(count_of(polyline().points));
    for (const Vec3& point : polyline().points) {
        for (const double x : point) hasher.add(x);
    }
    return hasher.value();
}

std::shared_ptr<const ItemContent> PolylineItem::capture(
    const std::shared_ptr<const ItemContent>& last, ContentStore& store) const {
    const auto* before = dynamic_cast<const PolylineContent*>(last.get());
    if (before && before->polyline() == *polyline_) return last;
    return std::make_shared<const PolylineContent>(*polyline_, store);
}

void PolylineItem::restore(const ItemContent& content, const ItemContent*) {
    Polyline wanted = dynamic_cast<const PolylineContent&>(content).polyline();
    *polyline_ = std::move(wanted);
}

}  // namespace lissom
