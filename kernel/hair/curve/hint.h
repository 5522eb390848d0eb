/// Hint strokes: short curves that change a style curve by cutting it, going on from it, or taking
/// the place of a part of it (thesis, section 4.5, Figure 4.3 c-h).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

enum class HintOperation { cut, concatenate, insert };

/// Lengths in metres, as the curves of a style.
struct HintOptions {
    /// A hint that is farther than this from the curve has nothing to do with it.
    double reach = 0.03;
    /// A join replaces this length of the curve and of the hint, or less if they are shorter.
    double join = 0.015;
};

/// Meaning of a hint.
struct HintReading {
    HintOperation operation = HintOperation::cut;
    /// False if a hint that is drawn a little nearer or farther, or turned by 12 degrees, means
    /// something else: tell the artist the reading.
    bool sure = true;
    /// Other readings, likelier first: those of varied hints, then any that its ends allow.
    std::vector<HintOperation> others = {};
};

/// Reads a hint by its ends and its general direction, that from its start to its end. With r for
/// `near`: one that starts and ends within r of the curve, at places 1.2 r and 0.15 of its length
/// apart, inserts; if these are nearer, it cuts if it crosses the curve or is at most 3 r long,
/// else it concatenates. One that only starts within r concatenates if that is within r of the tip,
/// or if it does not cross the curve in its first 1.2 r; else it cuts if it is short, begins well
/// before the curve and runs across it, and concatenates if it continues along the curve. Any other
/// one cuts if it crosses the curve or passes within r. A crossing is a change of sides within r of
/// the curve. `near` is about 20 pixels of the picture that the hint was drawn in. Errors: as
/// require_curve for both; invalid_argument for `near`; out_of_range if the hint is nowhere near
/// the curve.
HintReading hint_reading(std::span<const Vec3> curve, std::span<const Vec3> hint,
                         double near = 0.007);

/// Returns the operation of hint_reading.
HintOperation hint_operation(std::span<const Vec3> curve, std::span<const Vec3> hint,
                             double near = 0.007);

/// Returns the curve up to its crossing with the hint, or up to the point nearest to it. Errors: as
/// require_curve for both; invalid_argument for options out of range, or if nothing of the curve
/// would be left; out_of_range if the hint is nowhere near the curve.
std::vector<Vec3> cut_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                            const HintOptions& options = {});

/// Returns the curve up to the point nearest to the start of the hint, and the hint from there on.
/// The join is smooth: a cubic with the tangents of both. The first point of the curve stays.
/// Errors: as cut_curve; out_of_range if the hint does not start near the curve.
std::vector<Vec3> concatenated_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                                     const HintOptions& options = {});

/// Returns the curve with the hint between the points nearest to the ends of the hint, in either
/// direction of the hint. Joins are smooth; the first and last point of the curve stay. Errors: as
/// cut_curve; out_of_range if the hint does not start and end near the curve; invalid_argument if
/// it does so at one place.
std::vector<Vec3> inserted_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                                 const HintOptions& options = {});

}  // namespace lissom
