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
    /// A join takes the place of this length of the curve and of the hint, or of less where they
    /// are shorter.
    double join = 0.015;
};

/// What a hint means: one that starts and ends near the curve inserts, one that only starts near it
/// concatenates, one that only passes near it cuts. Errors: as the operations.
HintOperation hint_operation(std::span<const Vec3> curve, std::span<const Vec3> hint,
                             const HintOptions& options = {});

/// The curve up to where the hint crosses it, or comes nearest to it.
/// Errors: as require_curve for both; invalid_argument for options out of range, or where nothing
/// of the curve would be left; out_of_range where the hint is nowhere near the curve.
std::vector<Vec3> cut_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                            const HintOptions& options = {});

/// The curve up to the point nearest to the start of the hint, and the hint from there on. The join
/// is smooth: a cubic with the tangents of both. The first point of the curve stays.
/// Errors: as cut_curve; out_of_range where the hint does not start near the curve.
std::vector<Vec3> concatenated_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                                     const HintOptions& options = {});

/// The curve with the hint between the points nearest to the ends of the hint, whichever way the
/// hint runs. Joins are smooth; the first and last point of the curve stay.
/// Errors: as cut_curve; out_of_range where the hint does not start and end near the curve;
/// invalid_argument where it does so at one place.
std::vector<Vec3> inserted_curve(std::span<const Vec3> curve, std::span<const Vec3> hint,
                                 const HintOptions& options = {});

}  // namespace lissom
