#include "kernel/merge/loop/loop_values.h"

#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

// |tangent| at v_t over |tangent| at v_s: how much the neighbours of a vertex move apart.
std::vector<double> tangent_ratios(const Loop& source, const std::vector<Vec3>& places) {
    std::vector<double> ratios;
    const std::vector<double> lengths = source.tangent_lengths();
    const std::size_t n = places.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double length = 0.5 * (places[(i + 1) % n] - places[(i + n - 1) % n]).norm();
        const bool usable = lengths[i] > 0.0 && length > 0.0;
        ratios.push_back(usable ? length / lengths[i] : 1.0);
    }
    return ratios;
}

}  // namespace

double loop_scale(const Loop& source, const Loop& target) {
    return target.radius() / source.radius();
}

std::vector<BoundaryValue> loop_values(const Loop& source, const Loop& target, const LoopPair& pair,
                                       const LoopValueOptions& options) {
    std::vector<Vec3> places;
    for (const LoopPoint& place : pair.on_target) {
        places.push_back(point_of(target.points(), place));
    }
    const std::vector<Mat3> from = source.frames(options.sigma), to = target.frames(options.sigma);
    const std::vector<double> ratios =
        options.tangent_scales ? tangent_ratios(source, places)
                               : std::vector<double>(places.size(), loop_scale(source, target));
    std::vector<BoundaryValue> values;
    for (std::size_t i = 0; i < places.size(); ++i) {
        BoundaryValue value{places[i], Mat3::Identity(), ratios[i]};
        if (options.turn) {
            const Mat3 frame = interpolated(to, pair.on_target[i]);
            value.rotation = nearest_rotation(frame * from[i].transpose());
        }
        values.push_back(value);
    }
    return values;
}

}  // namespace lissom
