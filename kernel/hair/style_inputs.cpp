#include "kernel/hair/style_inputs.h"

#include <algorithm>
#include <set>
#include <string>
#include <variant>

#include "kernel/core/error.h"
#include "kernel/hair/style_bytes.h"

namespace lissom {
namespace {

std::size_t bytes_in(const std::vector<Vec3>& points) {
    return points.size() * sizeof(Vec3);
}

std::size_t bytes_in(const StyleCurve& curve) {
    std::size_t bytes = curve.name.size() + bytes_in(drawn_points(curve));
    if (const auto* dividing = std::get_if<DividingCurve>(&curve.shape)) {
        for (const auto& hint : dividing->hints)
            bytes += sizeof(std::vector<Vec3>) + bytes_in(hint);
    }
    if (const auto* tail = std::get_if<Ponytail>(&curve.shape)) {
        bytes += bytes_in(tail->options.section);
        for (const auto& profile : tail->options.profiles) bytes += bytes_in(profile);
    }
    return bytes;
}

}  // namespace

std::size_t memory_bytes(const StyleInputs& inputs) {
    std::size_t bytes = inputs.scalp_step.size() * sizeof(GridConstraint);
    for (const MaskStroke& mask : inputs.masks) bytes += sizeof mask + bytes_in(mask.points);
    for (const PlacedCurve& one : inputs.curves) bytes += sizeof one + bytes_in(one.curve);
    return bytes;
}

PlacedCurve& placed_curve(StyleInputs& inputs, CurveId id) {
    return const_cast<PlacedCurve&>(placed_curve(std::as_const(inputs), id));
}

const PlacedCurve& placed_curve(const StyleInputs& inputs, CurveId id) {
    const auto found = std::find_if(inputs.curves.begin(), inputs.curves.end(),
                                    [&](const PlacedCurve& one) { return one.id == id; });
    if (found == inputs.curves.end()) {
        throw Error(ErrorCode::handle_removed,
                    "the hairstyle has no such curve: it was removed, or is that of another");
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
