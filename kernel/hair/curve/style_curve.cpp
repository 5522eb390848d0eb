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

StreamCurve StreamCurve::thesis() {
    return {.points = {}, .options = StreamOptions::thesis(), .clearance = 0.0};
}

DividingCurve DividingCurve::thesis() {
    return {.points = {}, .options = DividingOptions::thesis(), .gap = 0.0};
}

Ponytail Ponytail::thesis() {
    return {.spine = {}, .options = PonytailOptions::thesis(), .ragged = 0.0};
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
