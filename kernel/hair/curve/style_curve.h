/// Style curves: drawn curves that direct the flow of hair (thesis, section 4.5). Points and
/// lengths are in metres of the scalp's frame.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/curve/dividing_curve.h"
#include "kernel/hair/curve/fidelity.h"
#include "kernel/hair/curve/ponytail.h"
#include "kernel/hair/curve/stream_curve.h"

namespace lissom {

/// Hair flows along it.
struct StreamCurve {
    /// From the root to the tip; the curve runs smoothly through them.
    std::vector<Vec3> points;
    StreamOptions options = {};
    /// The curve is moved outward to this height above the head.
    double clearance = 0.004;

    bool operator==(const StreamCurve&) const = default;
};

/// Hair parts along it.
struct DividingCurve {
    /// On the head or near it: the curve runs over the head through the nearest points.
    std::vector<Vec3> points;
    DividingOptions options = {};
    /// Width of the bare skin along the line, on which no hair is rooted.
    double gap = kPartingGap;
    /// Polylines beside the curve along which hair flows away from it: on sides with hints the
    /// tilts follow from all of them together (fit_tilt), and those of the options do not count.
    /// They keep their positions when the curve moves; the ones it has left have no effect.
    std::vector<std::vector<Vec3>> hints = {};

    bool operator==(const DividingCurve&) const = default;
};

/// Hair gathers in a tie and continues along a spine.
struct Ponytail {
    /// From the tie to the tip of the tail; the curve runs smoothly through them.
    std::vector<Vec3> spine;
    PonytailOptions options = {};
    /// Length of the hair behind the tie; absent: as long as the spine, with the fidelity of the
    /// thesis as long as hair would be without the tie. A share of it that differs from strand to
    /// strand, up to `ragged`, 0 to 1, is missing at the tips.
    std::optional<double> tail_length = std::nullopt;
    double ragged = 0.45;

    bool operator==(const Ponytail&) const = default;
};

struct StyleCurve {
    std::variant<StreamCurve, DividingCurve, Ponytail> shape = StreamCurve{};
    /// For people and groups of strands; need not be unique.
    std::string name = {};
    /// Curves that are not have no effect.
    bool enabled = true;

    bool operator==(const StyleCurve&) const = default;
};

/// "stream", "dividing" or "ponytail".
std::string_view kind_name(const StyleCurve& curve);

/// Returns how closely the curve keeps to the thesis.
HairFidelity fidelity_of(const StyleCurve& curve);

/// Returns a curve without points, as it is by default with a fidelity. In section 4.5 of the
/// thesis a stream may lie on the head, a dividing curve bares no skin, and a ponytail has no grip
/// and no spread, and hair behind its tie is like any other.
template <typename Shape>
Shape curve_with(HairFidelity fidelity);
template <>
StreamCurve curve_with(HairFidelity fidelity);
template <>
DividingCurve curve_with(HairFidelity fidelity);
template <>
Ponytail curve_with(HairFidelity fidelity);

/// Returns the points or spine that the curve was drawn with.
const std::vector<Vec3>& drawn_points(const StyleCurve& curve);
std::vector<Vec3>& drawn_points(StyleCurve& curve);

}  // namespace lissom
