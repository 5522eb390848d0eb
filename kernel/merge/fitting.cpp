#include "kernel/merge/fitting.h"

#include <algorithm>
#include <cmath>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/loop/loop_values.h"

namespace lissom {
namespace {

// Parts that were laid together exactly may meet at a crease up to the first angle, as a flat lid
// and a tube; loops that only have one shape, as all regular ones have, up to the second.
constexpr double kLaidTurn = 105.0 * kDegree, kFoundTurn = 15.0 * kDegree;
// Fits of several joins are one if each brings the loops of all this close, in lengths.
constexpr double kOneFit = 1e-5;
// Directions across the loops that differ by more than 120 degrees lead to the same side.
constexpr double kSameSide = -0.5;

double median_frame_turn(const FitSides& sides, const CurveFit& fit) {
    std::vector<double> turns;
    for (const BoundaryValue& value :
         loop_values(sides.source_loop, sides.target_loop, fit.pair, {})) {
        const Mat3 left = value.rotation * fit.map.rotation.transpose();
        turns.push_back(std::acos(std::clamp(0.5 * (left.trace() - 1.0), -1.0, 1.0)));
    }
    const auto middle = turns.begin() + std::ssize(turns) / 2;
    std::nth_element(turns.begin(), middle, turns.end());
    return *middle;
}

bool goes_on(const FitSides& sides, const CurveFit& fit, double most) {
    return median_turn(fit, sides.source, sides.target) < most ||
           median_frame_turn(sides, fit) < most;
}

bool serves(const FitSides& sides, const CurveFit& fit, std::span<const ParameterPair> keys) {
    return meets(fit, sides.source_loop, sides.target_loop, keys) &&
           goes_on(sides, fit, fit.stays ? kLaidTurn : kFoundTurn);
}

std::optional<CurveFit> if_serves(const FitSides& sides, std::optional<CurveFit> fit,
                                  std::span<const ParameterPair> keys) {
    return fit && serves(sides, *fit, keys) ? fit : std::nullopt;
}

}  // namespace

std::optional<CurveFit> part_fit(const FitSides& sides, std::span<const ParameterPair> keys,
                                 Configuration configuration) {
    const Loop &from = sides.source_loop, &to = sides.target_loop;
    if (auto fit = if_serves(sides, fit_in_place(from, to), keys)) return fit;
    if (configuration == Configuration::fixed || keys.empty()) return std::nullopt;
    return if_serves(sides, fit_near(from, to, keys.front()), keys);
}

std::optional<CurveFit> only_part_fit(const FitSides& sides) {
    const std::vector<CurveFit> fits = curve_fits(sides.source_loop, sides.target_loop, 2);
    if (fits.size() != 1) return std::nullopt;
    return if_serves(sides, fits.front(), {});
}

std::optional<CurveFit> part_fit_near(const FitSides& sides, const ParameterPair& key) {
    return if_serves(sides, fit_near(sides.source_loop, sides.target_loop, key), {&key, 1});
}

bool parts_may_fit(const FitSides& sides, Configuration configuration) {
    const Loop &from = sides.source_loop, &to = sides.target_loop;
    if (if_serves(sides, fit_in_place(from, to), {})) return true;
    if (configuration == Configuration::fixed) return false;
    const std::vector<CurveFit> fits = curve_fits(from, to, 1);
    return !fits.empty() && serves(sides, fits.front(), {});
}

std::optional<CurveFit> common_fit(std::span<const std::optional<CurveFit>> fits,
                                   std::span<const Loop> sources, std::span<const Loop> targets) {
    const bool all = std::all_of(fits.begin(), fits.end(), [](const auto& fit) { return !!fit; });
    if (fits.empty() || !all) return std::nullopt;
    const CurveFit& one = *fits.front();
    for (std::size_t j = 1; j < fits.size(); ++j) {
        const LoopPair& pair = fits[j]->pair;
        for (std::size_t i = 0; i < pair.source.size(); ++i) {
            const Vec3 place = point_of(targets[j].points(), pair.on_target[i]);
            const double apart = (one(sources[j].points()[i]) - place).norm();
            if (!(apart <= kOneFit * targets[j].length())) return std::nullopt;
        }
    }
    return one;
}

// Both loops run the same way, so that the third columns of the frames go out of the target and
// into the source.
bool on_same_side(const Loop& source, const Loop& target, const LoopPair& pair) {
    const std::vector<Mat3> from = source.frames(0.0), to = target.frames(0.0);
    double sum = 0.0, total = 0.0;
    const std::vector<double> lengths = source.tangent_lengths();
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Mat3 frame = interpolated(to, pair.on_target[i]);
        sum += lengths[i] * from[i].col(2).dot(frame.col(2).normalized());
        total += lengths[i];
    }
    return sum < kSameSide * total;
}

}  // namespace lissom
