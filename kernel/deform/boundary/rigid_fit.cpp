#include "kernel/deform/boundary/rigid_fit.h"

#include <Eigen/Geometry>
#include <numeric>

#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// Returns the rotation, or the nearest one within the slack of a value.
Mat3 limited(const Mat3& rotation, const TurnLimit& limit) {
    if (!limit.value) return rotation;
    const Eigen::AngleAxisd away(Mat3(rotation * limit.value->upright.transpose()));
    if (away.angle() <= limit.value->slack) return rotation;
    return Eigen::AngleAxisd(limit.value->slack, away.axis()).toRotationMatrix() *
           limit.value->upright;
}

// Energy of one vertex with a transform.
double energy_at(const EnergyLoop& loop, std::span<const Vec4> x, Index v, const Mat3& transform) {
    const Vec3 own = x[at(v)].head<3>(), rest = loop.rest[v].head<3>();
    double sum = 0.0;
    Vec3 bending = -transform * loop.laplacian[v].head<3>();
    for (Index e = loop.ring_begin[v]; e < loop.ring_begin[v + 1]; ++e) {
        const Index u = loop.neighbor[e];
        const Vec3 edge = own - x[at(u)].head<3>();
        const Vec3 wanted = transform * (rest - loop.rest[u].head<3>());
        sum += 0.5 * loop.edge_weight[e] * (edge - wanted).squaredNorm();
        bending += loop.coefficient[e] * edge;
    }
    return sum + loop.row_weight[v] * bending.squaredNorm();
}

}  // namespace

FittedTurns fitted_turns(const EnergyLoop& loop, std::span<const Vec4> x, std::span<const Mat3> now,
                         std::span<const double> size, std::span<const TurnLimit> limits,
                         const Context& context) {
    const auto count = count_of(now);
    FittedTurns result{{now.begin(), now.end()}, 0.0};
    std::vector<double> energy(now.size(), 0.0);
    std::vector<Index> all(now.size());
    std::iota(all.begin(), all.end(), 0);
    for_each_block(context, count, [&](Index begin, Index end) {
        std::vector<Mat3> fitted(at(end - begin));
        loop.fit(x.data(), all.data() + begin, fitted.data(), 0, end - begin);
        nearest_rotations(fitted, fitted);
        for (Index v = begin; v < end; ++v) {
            energy[at(v)] = energy_at(loop, x, v, now[at(v)]);
            if (!limits[at(v)].free) continue;
            const Mat3 next = size[at(v)] * limited(fitted[at(v - begin)], limits[at(v)]);
            const double least = energy_at(loop, x, v, next);
            // Rotations that are limited may be worse than those that there are.
            if (!(least < energy[at(v)])) continue;
            energy[at(v)] = least;
            result.transform[at(v)] = next;
        }
    });
    result.energy = std::accumulate(energy.begin(), energy.end(), 0.0);
    return result;
}

std::vector<Mat3> turned_beyond(std::span<const Mat3> from, std::span<const Mat3> to,
                                std::span<const double> size, std::span<const TurnLimit> limits,
                                double further) {
    std::vector<Mat3> result(to.begin(), to.end());
    if (further == 0.0) return result;
    for (std::size_t v = 0; v < to.size(); ++v) {
        if (!limits[v].free) continue;
        const Mat3 before = from[v] / size[v];
        const Eigen::AngleAxisd change(Mat3(to[v] / size[v] * before.transpose()));
        const Mat3 turn = rotation_of_turn((1.0 + further) * change.angle() * change.axis());
        result[v] = size[v] * limited(turn * before, limits[v]);
    }
    return result;
}

}  // namespace lissom
