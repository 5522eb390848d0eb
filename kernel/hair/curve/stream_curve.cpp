#include "kernel/hair/curve/stream_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/hair/curve/curve.h"

namespace lissom {
namespace {

// A corner with less weight than this says nothing of its segment.
constexpr double kMinWeight = 1e-9;

}  // namespace

double steps_across(const GridLayout& layout) {
    return static_cast<double>(layout.counts[0]) + layout.counts[1] + layout.counts[2];
}

bool VectorSplat::add(const Vec3& point, const Vec3& vector, ConstraintKind kind) {
    const Vec3 at = (point - layout_.origin) / layout_.step;
    const Vec3 floor = at.array().floor();
    // Far outside, before the numbers of cells do not fit an Index any more.
    if ((floor.array() < -1.0).any()) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (floor[axis] >= layout_.counts[axis]) return false;
    }
    bool found = false;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::array<Index, 3> index{};
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
            const int up = (corner >> axis) & 1;
            const double t = at[axis] - floor[axis];
            index[axis] = static_cast<Index>(floor[axis]) + up;
            inside = inside && index[axis] >= 0 && index[axis] < layout_.counts[axis];
            weight *= up ? t : 1.0 - t;
        }
        if (!inside || weight < kMinWeight) continue;
        add_at(layout_.index(index[0], index[1], index[2]), vector, weight, kind);
        found = true;
    }
    return found;
}

void VectorSplat::add_at(Index point, const Vec3& vector, double weight, ConstraintKind kind) {
    given_.push_back({point, weight, weight * vector, kind});
}

std::vector<GridConstraint> VectorSplat::constraints(double weight) const {
    std::vector<Given> sorted = given_;
    // Stable, so that sums are taken in the order in which vectors were given.
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Given& a, const Given& b) { return a.point < b.point; });
    std::vector<GridConstraint> result;
    for (std::size_t i = 0; i < sorted.size();) {
        std::size_t end = i;
        while (end < sorted.size() && sorted[end].point == sorted[i].point) ++end;
        const Given all = taken(std::span(sorted).subspan(i, end - i));
        result.push_back({all.point, all.sum / all.weight, weight, static_cast<int>(all.kind)});
        i = end;
    }
    return result;
}

VectorSplat::Given VectorSplat::taken(std::span<const Given> given) const {
    if (fidelity_ == HairFidelity::thesis) {
        return *std::max_element(given.begin(), given.end(), [](const Given& a, const Given& b) {
            return a.weight < b.weight;
        });
    }
    Given sum{given.front().point, 0.0, Vec3::Zero(), given.front().kind};
    for (const Given& one : given) {
        sum.weight += one.weight;
        sum.sum += one.sum;
    }
    return sum;
}

std::vector<GridConstraint> stream_constraints(const GridLayout& layout,
                                               std::span<const Vec3> points,
                                               const StreamOptions& options) {
    require_curve(points);
    if (!(options.stop_length >= 0.0) || !std::isfinite(options.stop_length)) {
        throw Error(ErrorCode::invalid_argument, "stop_length of a curve must be 0 or more");
    }
    require_curve_weight(options.weight);
    VectorSplat splat(layout, options.fidelity);
    bool inside = false;
    Vec3 tangent = Vec3::Zero();
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i] == points[i - 1]) continue;
        tangent = (points[i] - points[i - 1]).normalized();
        inside =
            splat.add(0.5 * (points[i - 1] + points[i]), tangent, ConstraintKind::stream) || inside;
    }
    if (!inside) {
        throw Error(ErrorCode::out_of_range,
                    "the curve lies outside the volume of the hairstyle; enlarge the volume, or "
                    "draw the curve nearer to the head");
    }
    const double extra = std::ceil(options.stop_length / layout.step);
    // Farther from a point of the grid there is no other.
    const double last = std::min(extra, steps_across(layout));
    for (double k = 1.0; k <= last; k += 1.0) {
        const Vec3 at = points.back() + (k - 0.5) * layout.step * tangent;
        splat.add(at, (1.0 - k / extra) * tangent, ConstraintKind::stop);
    }
    return splat.constraints(options.weight);
}

}  // namespace lissom
