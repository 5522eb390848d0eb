#include "kernel/deform/holds/mirror.h"

#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

// Candidates in the order of one coordinate, so that those near a point are found by bisection.
struct Sweep {
    std::vector<std::pair<double, Index>> order;

    Sweep(std::span<const Vec3> positions, std::span<const Index> candidates) {
        for (const Index v : candidates) order.emplace_back(positions[v].x(), v);
        std::sort(order.begin(), order.end());
    }

    Index nearest(std::span<const Vec3> positions, const Vec3& at, double tolerance) const {
        Index best = kNoIndex;
        double distance = tolerance;
        const auto first =
            std::lower_bound(order.begin(), order.end(), std::pair(at.x() - tolerance, Index{0}));
        for (auto it = first; it != order.end() && it->first <= at.x() + tolerance; ++it) {
            const double d = (positions[it->second] - at).norm();
            if (d > distance || (d == distance && best != kNoIndex)) continue;
            distance = d;
            best = it->second;
        }
        return best;
    }
};

}  // namespace

Affine reflection(const MirrorPlane& plane) {
    const double length = plane.normal.norm();
    if (!(length > 0.0) || !std::isfinite(length) || !plane.point.allFinite()) {
        throw Error(ErrorCode::invalid_argument, "the normal of a mirror plane needs a direction");
    }
    const Vec3 n = plane.normal / length;
    return {Mat3::Identity() - 2.0 * n * n.transpose(), 2.0 * plane.point.dot(n) * n};
}

std::vector<Index> counterparts(std::span<const Vec3> positions, std::span<const Index> vertices,
                                std::span<const Index> candidates, const Affine& mirror,
                                double tolerance) {
    const Sweep sweep(positions, candidates);
    std::vector<char> taken(positions.size(), 0);
    std::vector<Index> result;
    for (const Index v : vertices) {
        const Index found = sweep.nearest(positions, mirror(positions[v]), tolerance);
        const bool free = found != kNoIndex && !std::exchange(taken[found], 1);
        result.push_back(free ? found : kNoIndex);
    }
    return result;
}

}  // namespace lissom
