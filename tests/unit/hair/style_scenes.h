/// A small head and curves over it, for tests of whole hairstyles.
#pragma once

#include <memory>
#include <vector>

#include "kernel/hair/hairstyle.h"
#include "kernel/mesh/shapes/head.h"

namespace lissom::test {

inline const Mesh& small_head() {
    static const Mesh head = make_head({.vertices = 3000});
    return head;
}

inline std::shared_ptr<const Scalp> small_scalp() {
    static const auto scalp = std::make_shared<const Scalp>(small_head());
    return scalp;
}

/// A style of its curves alone, without gravity.
inline Hairstyle small_style(const GridFieldOptions& field = HairField::default_options()) {
    HairstyleOptions options;
    options.resolution = 6000;
    options.field = field;
    options.gravity = 0.0;
    return Hairstyle(small_head(), small_scalp(), options);
}

inline Vec3 over(const Hairstyle& style, double azimuth, double elevation, double lift) {
    const double degree = kPi / 180.0;
    return style.scalp().to_metres(
        style.scalp().at({azimuth * degree, elevation * degree}, lift).position);
}

inline std::vector<Vec3> side(const Hairstyle& style, double sign) {
    return {over(style, 20 * sign, 50, 0.01), over(style, 70 * sign, 25, 0.02),
            over(style, 85 * sign, -15, 0.02)};
}

inline StyleCurve stream(std::vector<Vec3> points) {
    return {StreamCurve{std::move(points)}};
}

inline StyleCurve parting(const Hairstyle& style) {
    return {DividingCurve{{over(style, 0, 45, 0), over(style, 0, 65, 0), over(style, 0, 85, 0)}}};
}

inline StyleCurve tail(const Hairstyle& style) {
    const Vec3 tie = over(style, 180, 25, 0.02);
    return {Ponytail{{tie, tie + Vec3(0, -0.01, -0.04), tie + Vec3(0, -0.12, -0.06)}}};
}

inline std::vector<float> field_of(Hairstyle& style) {
    style.solve();
    const auto values = style.field().values();
    return {values.begin(), values.end()};
}

}  // namespace lissom::test
