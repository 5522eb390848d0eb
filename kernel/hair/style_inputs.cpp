#include "kernel/hair/style_inputs.h"

#include <algorithm>
#include <set>
#include <string>

#include "kernel/core/error.h"

namespace lissom {

PlacedCurve& placed_curve(StyleInputs& inputs, CurveId id) {
    return const_cast<PlacedCurve&>(placed_curve(std::as_const(inputs), id));
}

const PlacedCurve& placed_curve(const StyleInputs& inputs, CurveId id) {
    const auto found = std::find_if(inputs.curves.begin(), inputs.curves.end(),
                                    [&](const PlacedCurve& one) { return one.id == id; });
    if (found == inputs.curves.end()) {
        throw Error(ErrorCode::handle_removed, "the curve was removed from its hairstyle");
    }
    return *found;
}

std::int64_t next_edit(const StyleInputs& inputs) {
    std::int64_t last = inputs.scalp_edit;
    for (const PlacedCurve& one : inputs.curves) last = std::max(last, one.edit);
    return last + 1;
}

void reorder_curve(StyleInputs& inputs, CurveId id, Index place) {
    const auto from = inputs.curves.begin() + (&placed_curve(inputs, id) - inputs.curves.data());
    const auto count = count_of(inputs.curves);
    if (place < 0 || place >= count) {
        throw Error(ErrorCode::out_of_range, "a hairstyle of " + std::to_string(count) +
                                                 " curves has no place " + std::to_string(place));
    }
    const auto to = inputs.curves.begin() + place;
    if (from < to) {
        std::rotate(from, from + 1, to + 1);
    } else {
        std::rotate(to, from, from + 1);
    }
}

void require_inputs(const StyleInputs& inputs, const GridSize& size) {
    std::set<ConstraintOwner> ids;
    for (const PlacedCurve& one : inputs.curves) {
        require(one.id.value > 0 && ids.insert(one.id.value).second,
                "the curves of a hairstyle need ids above 0, each of its own");
    }
    GridConstraints(size).set(0, inputs.scalp_step);
    for (const MaskStroke& mask : inputs.masks) require_mask(mask);
}

}  // namespace lissom
