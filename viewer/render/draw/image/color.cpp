#include "viewer/render/draw/image/color.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "kernel/core/error.h"

namespace lissom {
namespace {

struct NamedColor {
    std::string_view name;
    Color color;
};

constexpr std::array<NamedColor, 14> kNamedColors{{
    {"white", kWhite},
    {"black", {0.0, 0.0, 0.0}},
    {"gray", {0.5, 0.5, 0.5}},
    {"lightgray", {0.85, 0.85, 0.85}},
    {"darkgray", {0.25, 0.25, 0.25}},
    {"clay", kClayColor},
    {"red", {0.84, 0.21, 0.20}},
    {"orange", {0.93, 0.53, 0.18}},
    {"yellow", {0.94, 0.80, 0.28}},
    {"green", {0.30, 0.66, 0.36}},
    {"teal", {0.16, 0.62, 0.62}},
    {"blue", kRegionColor},
    {"purple", kHandleColor},
    {"sand", {0.87, 0.74, 0.56}},
}};

constexpr std::string_view kNames =
    "white, black, gray, lightgray, darkgray, clay, red, orange, yellow, green, teal, blue, "
    "purple, sand";

std::optional<int> hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return std::nullopt;
}

// "rrggbb" or "rgb".
std::optional<Color> parse_hex(std::string_view digits) {
    if (digits.size() != 3 && digits.size() != 6) return std::nullopt;
    const std::size_t step = digits.size() / 3;
    std::array<double, 3> parts{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<int> high = hex_digit(digits[i * step]);
        const std::optional<int> low = hex_digit(digits[i * step + step - 1]);
        if (!high || !low) return std::nullopt;
        parts[i] = (16 * *high + *low) / 255.0;
    }
    return Color{parts[0], parts[1], parts[2]};
}

}  // namespace

Color parse_color(std::string_view text) {
    for (const NamedColor& named : kNamedColors) {
        if (named.name == text) return named.color;
    }
    if (text.starts_with('#')) {
        if (const std::optional<Color> color = parse_hex(text.substr(1))) return *color;
    }
    throw Error(ErrorCode::invalid_argument, "'" + std::string(text) +
                                                 "' is not a colour; write #rrggbb or one of " +
                                                 std::string(kNames));
}

std::string_view color_names() {
    return kNames;
}

double srgb_to_linear(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double value) {
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

Vec3 linear(const Color& color) {
    return {srgb_to_linear(color.r), srgb_to_linear(color.g), srgb_to_linear(color.b)};
}

double lightness(const Color& color) {
    const double luminance = 0.2126 * srgb_to_linear(color.r) + 0.7152 * srgb_to_linear(color.g) +
                             0.0722 * srgb_to_linear(color.b);
    return std::clamp(1.16 * std::cbrt(luminance) - 0.16, 0.0, 1.0);
}

Color mix(const Color& a, const Color& b, double fraction) {
    return {a.r + fraction * (b.r - a.r), a.g + fraction * (b.g - a.g),
            a.b + fraction * (b.b - a.b)};
}

std::array<std::uint8_t, 4> to_bytes(const Color& color) {
    const auto to_byte = [](double part) {
        return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
    };
    return {to_byte(color.r), to_byte(color.g), to_byte(color.b), 255};
}

Color category_color(std::size_t number) {
    static constexpr std::array<Color, 8> kCategories{{
        {0.89, 0.30, 0.18},
        {0.13, 0.60, 0.55},
        {0.95, 0.66, 0.15},
        {0.28, 0.42, 0.80},
        {0.80, 0.28, 0.58},
        {0.42, 0.65, 0.22},
        {0.48, 0.35, 0.70},
        {0.60, 0.42, 0.28},
    }};
    return kCategories[number % kCategories.size()];
}

}  // namespace lissom
