/// The similarity that brings one boundary loop to another; private to kernel/merge.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_pair.h"

namespace lissom {

inline constexpr int kLoopSamples = 128;

/// A loop at evenly spaced parameters from `start`.
struct LoopSamples {
    std::array<Vec3, kLoopSamples> points, normals;

    /// `frames` are those of the loop; their normals are interpolated.
    LoopSamples(const Loop& loop, const std::vector<Mat3>& frames, double start);
};

/// p -> to + scale * rotation * (p - from).
struct SimilarityMap {
    Mat3 rotation = Mat3::Identity();
    double scale = 1.0;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();

    Vec3 operator()(const Vec3& p) const { return to + scale * (rotation * (p - from)); }
};

/// Returns the similarity of least squares (Umeyama 1991) that takes the center of `from` to that
/// of `to`; its scale is that of the sizes.
SimilarityMap similarity_about(std::span<const Vec3> from, std::span<const Vec3> to,
                               const Vec3& from_center, const Vec3& to_center);

/// Points that are to meet.
struct Matches {
    std::vector<Vec3> from, to;

    /// The similarity that fits them best by least squares.
    SimilarityMap fit() const;
};

/// The similarity that moves a source by the correspondence of one of its loops.
SimilarityMap similarity_of(const Loop& source, const Loop& target, const LoopPair& pair);

/// Returns the ratio of length to width of a loop, along the principal axes of its points.
double loop_aspect(const Loop& loop);

/// Rotates one unit vector onto another by the least angle; the identity if either is zero.
Mat3 shortest_turn(const Vec3& from, const Vec3& to);

/// The parameter near sample `offset` of a loop (in samples) at which `cost` is as high a little
/// before as a little after: in a minimum of any shape that is a zero with a slope, so that
/// rounding hardly moves it.
template <typename Cost>
double refined_offset(int offset, const Cost& cost) {
    // Steps of the search between samples: the last is a billionth of a loop.
    constexpr int kRefinements = 30;
    // A rise below this is none, whichever sign rounding gives it.
    constexpr double kLevel = 1e-10;
    const double apart = 0.5 / kLoopSamples;
    const auto rise = [&](double x) { return cost(x + apart) - cost(x - apart); };
    double low = (offset - 1.0) / kLoopSamples, high = (offset + 1.0) / kLoopSamples;
    if (!(rise(low) < -kLevel && rise(high) > kLevel)) {
        return static_cast<double>(offset) / kLoopSamples;
    }
    for (int step = 0; step < kRefinements; ++step) {
        const double middle = 0.5 * (low + high);
        (rise(middle) < -kLevel ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace lissom
