#include "viewer/window/session/snapshot_bounds.h"

#include <algorithm>
#include <span>
#include <utility>

namespace lissom::window {
namespace {

void extend_by(Box& box, const Vec3& point) {
    if (point.allFinite()) box.extend(point);
}

Box box_of(const DrawnMesh& drawn) {
    Box box;
    for (const Vec3& p : drawn.mesh->positions()) extend_by(box, drawn.transform(p));
    return box;
}

Box box_of(const DrawnStrands& drawn) {
    Box box;
    const std::span<const float> points = drawn.strands->points();
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        const Vec3 p(points[i], points[i + 1], points[i + 2]);
        extend_by(box, drawn.transform(p / drawn.style.unit));
    }
    return box;
}

}  // namespace

template <typename Find>
void SnapshotBounds::extend(Box& box, Known object, const Find& find) {
    const auto is_it = [&](const Known& known) {
        return known.object.lock() == object.object.lock() && known.unit == object.unit &&
               known.transform == object.transform;
    };
    const auto found = std::find_if(known_.begin(), known_.end(), is_it);
    object.box = found == known_.end() ? find() : found->box;
    if (!object.box.empty()) {
        box.extend(object.box.min);
        box.extend(object.box.max);
    }
    next_.push_back(std::move(object));
}

Box SnapshotBounds::of(const Snapshot& snapshot) {
    Box box;
    for (const DrawnMesh& drawn : snapshot.meshes) {
        extend(box, {drawn.mesh, drawn.transform, 1.0, {}}, [&] { return box_of(drawn); });
    }
    for (const DrawnStrands& drawn : snapshot.strands) {
        extend(box, {drawn.strands, drawn.transform, drawn.style.unit, {}},
               [&] { return box_of(drawn); });
    }
    known_ = std::exchange(next_, {});
    Snapshot marks;
    marks.overlays = snapshot.overlays;
    for_each_point(marks, [&](const Vec3& p) { extend_by(box, p); });
    return box;
}

}  // namespace lissom::window
