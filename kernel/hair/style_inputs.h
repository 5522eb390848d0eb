/// StyleInputs: the inputs of a hairstyle, as a value.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/hair/curve/style_curve.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/solve/grid/grid_constraints.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// Names a curve of a hairstyle, for as long as that lives.
struct CurveId {
    ConstraintOwner value = 0;
    bool operator==(const CurveId&) const = default;
};

/// A curve of a hairstyle.
struct PlacedCurve {
    CurveId id;
    StyleCurve curve;
    /// Ascends with the last edits of the curves. The rows of the field's system are in this order,
    /// so that the next edit of the same curve is cheap; the field depends on it by rounding alone.
    std::int64_t edit = 0;

    bool operator==(const PlacedCurve&) const = default;
};

/// A hairstyle without its results. Keep a copy and give it to Hairstyle::restore to undo. On one
/// head and with one HairstyleOptions, equal inputs give the same field and strands to the bit, for
/// any history.
struct StyleInputs {
    /// In their order.
    std::vector<PlacedCurve> curves;
    /// The constraints of avoid_scalp; empty without it.
    std::vector<GridConstraint> scalp_step;
    /// Same as PlacedCurve::edit.
    std::int64_t scalp_edit = 0;
    /// Strokes painted on the scalp, in their order.
    std::vector<MaskStroke> masks;

    bool operator==(const StyleInputs&) const = default;
};

/// Returns the curve of this id. Errors: handle_removed.
PlacedCurve& placed_curve(StyleInputs& inputs, CurveId id);
const PlacedCurve& placed_curve(const StyleInputs& inputs, CurveId id);

/// Returns the number of the next edit.
std::int64_t next_edit(const StyleInputs& inputs);

/// Gives a curve the place `place` in the order, from 0. Errors: handle_removed; out_of_range.
void reorder_curve(StyleInputs& inputs, CurveId id, Index place);

/// Errors: invalid_argument if two curves have one id, or the scalp step is not one of a grid of
/// this size; not_finite; out_of_range.
void require_inputs(const StyleInputs& inputs, const GridSize& size);

}  // namespace lissom
