/// Colours as people write them: sRGB, each part 0 to 1. Light is added up in linear values, which
/// the renderer converts to and from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/core/geometry.h"

namespace lissom {

struct Color {
    double r = 0.0, g = 0.0, b = 0.0;

    bool operator==(const Color&) const = default;
};

/// Returns the colour called `text`: "#rrggbb", "#rgb" or one of `color_names()`. Errors:
/// invalid_argument that lists the accepted forms.
Color parse_color(std::string_view text);

/// Returns the names that `parse_color` accepts, separated by commas.
std::string_view color_names();

/// Convert one sRGB part to its linear value and back.
double srgb_to_linear(double value);
double linear_to_srgb(double value);
/// Returns the linear parts of a colour: red, green, blue.
Vec3 linear(const Color& color);

/// Returns the perceived lightness, 0 (black) to 1 (white).
double lightness(const Color& color);

/// Returns `a` for fraction 0, `b` for fraction 1.
Color mix(const Color& a, const Color& b, double fraction);

/// Returns four bytes: red, green, blue and an alpha of 255.
std::array<std::uint8_t, 4> to_bytes(const Color& color);

/// Colours that pictures of this project are drawn in.
inline constexpr Color kClayColor{0.80, 0.795, 0.785};
inline constexpr Color kRegionColor{0.45, 0.63, 0.89};
inline constexpr Color kHandleColor{0.61, 0.39, 0.79};
inline constexpr Color kWireColor{0.13, 0.14, 0.17};
inline constexpr Color kVertexNormalColor{0.20, 0.50, 0.85};
inline constexpr Color kFaceNormalColor{0.15, 0.62, 0.62};
inline constexpr Color kWhite{1.0, 1.0, 1.0};

/// Returns colours of things that are told apart by number; they repeat after eight.
Color category_color(std::size_t number);

}  // namespace lissom
