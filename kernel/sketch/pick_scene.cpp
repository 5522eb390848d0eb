#include "kernel/sketch/pick_scene.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

void require_finite_points(std::span<const Vec3> points) {
    const bool finite =
        std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
    if (!finite) throw Error(ErrorCode::not_finite, "points to pick from are NaN or infinite");
}

Affine inverse_of(const Affine& map) {
    require(map.is_finite(), "the transform of an object to pick from is NaN or infinite");
    // Relative to the columns, so that the smallest objects have an inverse too.
    const double volume = std::abs(map.linear.determinant());
    const double product = map.linear.colwise().norm().prod();
    require(volume > 1e-12 * product,
            "the transform of an object to pick from has no inverse: it scales by 0 along an axis");
    const Mat3 inverse = map.linear.inverse();
    return {inverse, -(inverse * map.translation)};
}

}  // namespace

PointSet::PointSet(std::vector<Vec3> points, const Context& context) : points_(std::move(points)) {
    require_finite_points(points_);
    std::vector<Box> boxes;
    boxes.reserve(points_.size());
    for (const Vec3& p : points_) boxes.push_back({p, p});
    boxes_ = BoxTree(boxes, context);
}

PolylineSet::PolylineSet(std::vector<Vec3> points, std::vector<Index> offsets, bool closed,
                         const Context& context)
    : points_(std::move(points)), offsets_(std::move(offsets)) {
    require_finite_points(points_);
    require(!offsets_.empty() && offsets_.front() == 0 && offsets_.back() == count_of(points_) &&
                std::is_sorted(offsets_.begin(), offsets_.end()),
            "the offsets of polylines must ascend from 0 to the number of points");
    for (Index line = 0; line < line_count(); ++line) {
        const Index first = offsets_[at(line)], last = offsets_[at(line + 1)] - 1;
        for (Index i = first; i < last; ++i) segments_.push_back({line, i, i + 1});
        const bool single = first == last;
        if (single || (closed && last > first + 1)) segments_.push_back({line, last, first});
    }
    std::vector<Box> boxes(segments_.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        boxes[i].extend(points_[at(segments_[i].first)]);
        boxes[i].extend(points_[at(segments_[i].second)]);
    }
    boxes_ = BoxTree(boxes, context);
}

Index PickScene::add(Object object, const Placement& placement) {
    object.to_world = placement.to_world;
    object.to_local = inverse_of(placement.to_world);
    object.on_top = placement.on_top;
    objects_.push_back(object);
    return count_of(objects_) - 1;
}

Index PickScene::add(const SpatialTree& surface, const Placement& placement) {
    return add(Object{.surface = &surface}, placement);
}

Index PickScene::add(const PointSet& points, const Placement& placement) {
    return add(Object{.points = &points}, placement);
}

Index PickScene::add(const PolylineSet& lines, const Placement& placement) {
    return add(Object{.lines = &lines}, placement);
}

}  // namespace lissom
