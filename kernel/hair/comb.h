/// Combing: a stroke through grown hair changes the streams, so that hair flows along it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/hair/style_inputs.h"

namespace lissom {

/// Changes that a comb may make to a style.
enum class CombBy {
    least,  ///< bend or add, by the least change elsewhere
    bend,   ///< bend streams that run beside the stroke
    add,    ///< add a stream along the stroke
};

/// Lengths in metres of the scalp's frame.
struct CombOptions {
    CombBy by = CombBy::least;
    /// Radius of influence: streams are bent fully up to half of it from the stroke, then less and
    /// less.
    double reach = 0.04;
    /// Hair follows the stroke if it runs within this angle of it (root of the mean square),
    /// radians.
    double tolerance = 15.0 * kDegree;
};

struct CombReport {
    std::vector<CurveId> bent;
    std::optional<CurveId> added;
    /// The angle between the field and the stroke, root of the mean square along it, radians.
    double before = 0.0, after = 0.0;
    /// Change of the field beyond the reach of the stroke, root of the mean square;
    /// vectors near curves are of length 1.
    double change = 0.0;
};

/// Returns a stream bent by a comb: segments near the stroke turn to its direction, the others keep
/// theirs, and the root stays, so that the part behind is moved along. Nothing if no part of the
/// curve is beside the stroke within `reach`, or the two run against each other there. Curve and
/// stroke are polylines without repeated points.
std::optional<std::vector<Vec3>> combed_stream(std::span<const Vec3> curve,
                                               std::span<const Vec3> stroke, double reach);

/// Makes hair flow along a stroke, which runs as hair grows. If hair follows it already, nothing
/// changes. Otherwise the streams beside it are bent, or a stream without a stop is added along it:
/// the one that explains the stroke with the least change of the rest of the field; both, if
/// neither does alone. Solves. After an error the style is as it was. Errors: not_finite;
/// invalid_argument for a stroke shorter than two steps of the grid, for options out of range, or
/// if streams are to be bent and none is beside the stroke; as Hairstyle::set and solve.
CombReport comb(Hairstyle& style, std::span<const Vec3> stroke, const CombOptions& options = {},
                const Context& context = {});

}  // namespace lissom
