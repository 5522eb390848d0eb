#include "kernel/hair/curve/style_curve.h"

#include <array>

#include "kernel/hair/curve/constraint_kind.h"

namespace lissom {
namespace {

struct DrawnPoints {
    const std::vector<Vec3>& operator()(const StreamCurve& c) const { return c.points; }
    const std::vector<Vec3>& operator()(const DividingCurve& c) const { return c.points; }
    const std::vector<Vec3>& operator()(const Ponytail& c) const { return c.spine; }
};

}  // namespace

template <>
StreamCurve curve_with(HairFidelity fidelity) {
    StreamCurve curve;
    curve.options.fidelity = fidelity;
    if (fidelity == HairFidelity::thesis) curve.clearance = 0.0;
    return curve;
}

template <>
DividingCurve curve_with(HairFidelity fidelity) {
    DividingCurve curve;
    curve.options.fidelity = fidelity;
    if (fidelity == HairFidelity::thesis) curve.gap = 0.0;
    return curve;
}

template <>
Ponytail curve_with(HairFidelity fidelity) {
    Ponytail curve;
    curve.options.fidelity = fidelity;
    if (fidelity == HairFidelity::thesis) {
        curve.options.grip = curve.options.spread = curve.ragged = 0.0;
    }
    return curve;
}

HairFidelity fidelity_of(const StyleCurve& curve) {
    return std::visit([](const auto& shape) { return shape.options.fidelity; }, curve.shape);
}

std::string_view kind_name(const StyleCurve& curve) {
    constexpr std::array<std::string_view, 3> kNames = {"stream", "dividing", "ponytail"};
    return kNames[curve.shape.index()];
}

std::string_view kind_name(ConstraintKind kind) {
    constexpr std::array<std::string_view, 8> kNames = {"stream",  "stop",  "parting", "separation",
                                                        "section", "spine", "gather",  "scalp"};
    return kNames[static_cast<std::size_t>(kind)];
}

const std::vector<Vec3>& drawn_points(const StyleCurve& curve) {
    return std::visit(DrawnPoints{}, curve.shape);
}

std::vector<Vec3>& drawn_points(StyleCurve& curve) {
    return const_cast<std::vector<Vec3>&>(std::visit(DrawnPoints{}, curve.shape));
}

}  // namespace lissom
