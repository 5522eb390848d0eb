#include "kernel/merge/loop/loop_pair.h"

#include "kernel/core/error.h"

namespace lissom {

Vec3 point_of(std::span<const Vec3> points, const LoopPoint& place) {
    const std::size_t k = place.segment;
    if (place.segment < 0 || k >= points.size()) {
        throw Error(ErrorCode::out_of_range, "the place lies on no segment of the loop");
    }
    if (place.t == 0.0) return points[k];
    return points[k] + place.t * (points[(k + 1) % points.size()] - points[k]);
}

}  // namespace lissom
