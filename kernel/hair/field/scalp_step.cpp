#include "kernel/hair/field/scalp_step.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// Vectors shorter than this, as a share of their length before, have no direction worth keeping.
constexpr double kMinLength = 1e-3;

bool is_positive(double x) {
    return x > 0.0 && std::isfinite(x);
}

void require_options(const ScalpStepOptions& options) {
    require(!options.band || is_positive(*options.band),
            "the band of the scalp step must be a length above 0");
    require(is_positive(options.magnitude), "the magnitude of the scalp step must be above 0");
    require(is_positive(options.weight), "the weight of the scalp step must be above 0");
}

// Which grid points have constraints.
std::vector<bool> constrained_points(const GridField& grid) {
    std::vector<bool> constrained(grid.size().count(), false);
    for (const ConstraintOwner owner : grid.constraints().owners()) {
        for (const GridConstraint& c : grid.constraints().of(owner)) {
            constrained[c.point] = true;
        }
    }
    return constrained;
}

// Returns the unit vector of increasing distance, by differences between neighbours; zero if there
// is none.
Vec3 outward(const DistanceGrid& distances, const std::array<Index, 3>& point) {
    const GridLayout& layout = distances.layout();
    Vec3 gradient;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<Index, 3> low = point, high = point;
        low[axis] = std::max(point[axis] - 1, 0);
        high[axis] = std::min(point[axis] + 1, layout.counts[axis] - 1);
        gradient[index_of(axis)] =
            (distances.at(high[0], high[1], high[2]) - distances.at(low[0], low[1], low[2])) /
            (high[axis] - low[axis]);
    }
    return gradient.stableNormalized();
}

// v without the part that points inward; zero if hardly anything is left.
Vec3 without_inward(const Vec3& v, const Vec3& normal) {
    const double inward = std::min(0.0, v.dot(normal));
    const Vec3 rest = v - inward * normal;
    return rest.norm() > kMinLength * v.norm() ? rest : Vec3::Zero();
}

}  // namespace

std::vector<GridConstraint> scalp_step(const HairField& field, const ScalpStepOptions& options) {
    require_options(options);
    const GridLayout& layout = field.layout();
    const double band = options.band.value_or(layout.step);
    const std::vector<bool> constrained = constrained_points(field.grid());
    std::vector<GridConstraint> result;
    for (Index point = 0; point < layout.size(); ++point) {
        const float* quad = field.values().data() + 4 * at(point);
        const double distance = field.distances().values()[point];
        if (!(std::abs(distance) < band) || constrained[point]) continue;
        const GridPoint at = field.grid().size().point(point);
        const Vec3 place = layout.point(at.x, at.y, at.z);
        if (options.where && !options.where(place)) continue;
        const Vec3 normal = outward(field.distances(), {at.x, at.y, at.z});
        const Vec3 value(quad[0], quad[1], quad[2]);
        if (options.scalp && !(value.dot(normal) < 0.0) && !options.scalp(place)) continue;
        const Vec3 direction = without_inward(value, normal);
        if (!(direction.norm() > 0.0)) continue;
        result.push_back({point, options.magnitude * direction.normalized(), options.weight});
    }
    return result;
}

}  // namespace lissom
