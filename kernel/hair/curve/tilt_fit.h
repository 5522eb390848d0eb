/// Tilts of a dividing curve from hint strokes beside it: how an artist says which way hair flows
/// away from a parting (thesis, section 4.5).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/curve/dividing_curve.h"

namespace lissom {

/// Result of the hints on one side of a curve.
struct SideTilt {
    DividingOptions::Tilt tilt;
    /// Short straight pieces of the hints that told it; 0 if there is no hint on this side.
    Index pieces = 0;
    /// Root of the mean square by which their directions differ from the tilt, radians.
    double error = 0.0;

    bool operator==(const SideTilt&) const = default;
};

struct TiltFit {
    SideTilt left, right;

    bool operator==(const TiltFit&) const = default;
};

/// A hint counts within this distance of the curve, across and in height. Metres.
inline constexpr double kHintReach = 0.03;

/// Returns the tilts that hints mean, each a polyline of metres along hair that flows away from the
/// curve; one that runs towards it by more than 10 degrees is read from its end. A piece of a hint
/// at the share s of the curve's length has the angle atan2(d . t, +-d . r), with d its direction,
/// t and r the curve's tangent and right. Per side, all of them together give
///     a(s) = a0 (1 - s) + a1 s
/// by least squares, weighted by length, with .01 of the whole weight on (a0 - a1)^2: so one hint,
/// which cannot tell both, means an even tilt. Pieces farther than kHintReach, beyond the ends of
/// the curve or on it do not count. Tilts are from -pi / 2 to pi / 2.
/// Errors: as require_curve; out_of_range for a hint of more than a million pieces.
TiltFit fit_tilt(const DividingLine& line, std::span<const std::vector<Vec3>> hints);

/// Errors: out_of_range if nothing of `hint` counts, with the reason and the remedy; as fit_tilt.
void require_hint(const DividingLine& line, const std::vector<Vec3>& hint);

}  // namespace lissom
