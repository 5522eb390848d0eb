#include "kernel/deform/contact/local_shape.h"

#include <algorithm>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr Index kPointGrain = 16384;

}  // namespace

void LocalShape::set(std::span<const Vec3> shape, const Context& context) {
    Box box;
    for (const Vec3& p : shape) box.extend(p);
    const Vec3 middle = box.empty() ? Vec3(Vec3::Zero()) : box.center();
    // Boxes of single precision know no more: at their limit all of them would overlap.
    constexpr double kFarthest = 1e30;
    const double reach = box.empty() ? 0.0 : (box.max - middle).maxCoeff();
    if (!(reach <= kFarthest)) {
        throw Error(
            ErrorCode::not_finite,
            "contacts need a surface within 1e30 units of its middle; move the handles back");
    }
    extent = static_cast<float>(reach);
    points.resize(shape.size());
    context.parallel_for(0, count_of(shape), kPointGrain, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            points[at(v)].head<3>() = (shape[at(v)] - middle).cast<float>().array();
            points[at(v)][3] = 0.0F;
        }
    });
}

}  // namespace lissom
