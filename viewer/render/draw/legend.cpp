#include "viewer/render/draw/legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "viewer/render/draw/image/colormap.h"
#include "viewer/render/draw/image/overlay.h"

namespace lissom {
namespace {

constexpr double kTextShare = 0.0155;     // height of capitals, of the picture's height
constexpr double kMinimumText = 7.0;      // pixels
constexpr double kBarShare = 0.5;         // of the picture's height
constexpr double kLegendIntervals = 5.0;  // between the ends, about
// Magnitudes outside are written with an exponent.
constexpr double kSmall = 1e-3, kLarge = 1e5;

// Distances in heights of capitals.
constexpr double kBarWidth = 1.5, kTickLength = 0.45, kTickGap = 0.55, kMargin = 1.6;

// 1, 2 or 5 times a power of ten, about a share of `extent`.
double round_step(double extent) {
    const double raw = extent / kLegendIntervals;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    const double factor = raw / power;
    return power * (factor < 1.5 ? 1.0 : factor < 3.5 ? 2.0 : factor < 7.5 ? 5.0 : 10.0);
}

std::string with_exponent(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    std::string result = text;
    const std::size_t e = result.find('e');
    if (e == std::string::npos) return result;
    std::string exponent = result.substr(e + 1);
    const bool negative = exponent.front() == '-';
    exponent.erase(0, exponent.find_first_not_of("+-0"));
    return result.substr(0, e) + (negative ? "e-" : "e") + exponent;
}

// With as many decimals as numbers `step` apart need.
std::string number_text(double value, double step, double largest) {
    if (largest < kSmall || largest >= kLarge || step < 1e-5) return with_exponent(value);
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
    const double unit = std::pow(10.0, -decimals);
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value) < 0.5 * unit ? 0.0 : value);
    return text;
}

// Ink that reads on the background.
constexpr Color kDarkInk{0.16, 0.17, 0.20};
constexpr Color kLightInk{0.92, 0.92, 0.93};

// Bytes of a name that are drawn, and the distance of two names in heights of capitals.
constexpr std::size_t kLongestName = 24;
constexpr double kNameStep = 2.2;

// The name, or its beginning; never ends inside a letter of UTF-8.
std::string short_name(const std::string& name) {
    if (name.size() <= kLongestName) return name;
    std::size_t end = kLongestName - 3;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
    return name.substr(0, end) + "...";
}

// Sizes of a legend in pixels.
struct Measures {
    double text, bar_width, bar_height, numbers_width, label_text;

    Measures(const Legend& legend, int picture_height)
        : text(std::max(kTextShare * picture_height, kMinimumText)),
          bar_width(kBarWidth * text),
          bar_height(kBarShare * picture_height),
          numbers_width(0.0),
          label_text(text) {
        const auto widen = [&](const std::string& line) {
            numbers_width = std::max(numbers_width, lay_out_text(line, text).width);
        };
        for (const LegendPart& part : legend.parts) widen(short_name(part.name));
        if (legend.parts.empty()) {
            for (const LegendTick& tick : legend_ticks(legend.range)) widen(tick.text);
        }
        const double label = lay_out_text(legend.label, text).width;
        if (label > content_width()) label_text = text * content_width() / label;
    }

    double content_width() const {
        return std::max(bar_width + (kTickLength + kTickGap) * text + numbers_width, 9.0 * text);
    }
    int width() const {
        return static_cast<int>(std::ceil(content_width() + 2.0 * kMargin * text));
    }
};

void draw_bar(Image& image, int x, int y, int width, int height, const Color& ink) {
    const int border = std::max(1, height / 400);
    fill_rectangle(image, x - border, y - border, width + 2 * border, height + 2 * border, ink);
    for (int row = 0; row < height; ++row) {
        const double t = (height - 0.5 - row) / height;
        fill_rectangle(image, x, y + row, width, 1, colormap(t));
    }
}

void draw_scale(Image& image, const Legend& legend, const Measures& measures, int x,
                const Color& ink) {
    const double text = measures.text;
    const int width = index_of(std::lround(measures.bar_width));
    const int height = index_of(std::lround(measures.bar_height));
    const int y = (image.height - height) / 2;
    draw_bar(image, x, y, width, height, ink);
    for (const LegendTick& tick : legend_ticks(legend.range)) {
        const double at = y + (1.0 - tick.place) * height;
        const double end = x + width + kTickLength * text;
        draw_strokes(image, {{Vec2(x + width, at), Vec2(end, at)}}, std::max(1.0, 0.1 * text), ink);
        draw_text(image, tick.text, end + kTickGap * text, at + 0.5 * text, text, ink);
    }
    draw_text(image, legend.label, x, y - 1.4 * text, measures.label_text, ink);
}

// Draws as many names as fit; the last row counts the others.
void draw_names(Image& image, const Legend& legend, const Measures& measures, int x,
                const Color& ink) {
    const double text = measures.text, step = kNameStep * text;
    const int room = std::max(static_cast<int>(0.9 * image.height / step) - 2, 1);
    const int count = count_of(legend.parts);
    const int shown = count > room ? room - 1 : count;
    const int side = index_of(std::lround(measures.bar_width));
    double base = 0.5 * (image.height - std::min(count, room) * step) + text;
    draw_text(image, legend.label, x, base - 1.4 * step, measures.label_text, ink);
    const double left = x + side + (kTickLength + kTickGap) * text;
    for (const LegendPart& part : std::span(legend.parts).first(at(shown))) {
        const int top = index_of(std::lround(base - 0.5 * (text + side)));
        fill_rectangle(image, x, top, side, side, part.color);
        draw_text(image, short_name(part.name), left, base, text, ink);
        base += step;
    }
    if (shown == count) return;
    draw_text(image, "and " + std::to_string(count - shown) + " more", left, base, text, ink);
}

}  // namespace

Color ink_on(const std::optional<Color>& background) {
    return background && lightness(*background) < 0.5 ? kLightInk : kDarkInk;
}

std::vector<LegendTick> legend_ticks(const ValueRange& range) {
    const double extent = range.high - range.low;
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    if (!(extent > 1e-12 * largest))
        return {{0.5, number_text(range.low, 0.01 * largest, largest)}};
    const double step = round_step(extent);
    std::vector<LegendTick> ticks{{0.0, number_text(range.low, 0.1 * step, largest)}};
    for (double n = std::ceil(range.low / step + 0.5); n * step < range.high - 0.5 * step; ++n) {
        ticks.push_back({(n * step - range.low) / extent, number_text(n * step, step, largest)});
    }
    ticks.push_back({1.0, number_text(range.high, 0.1 * step, largest)});
    return ticks;
}

int legend_width(const Legend& legend, int picture_height) {
    return Measures(legend, picture_height).width();
}

void draw_legend(Image& image, const Legend& legend, const Color& ink) {
    const Measures measures(legend, image.height);
    const double left = image.width - measures.width() + kMargin * measures.text;
    const int x = index_of(std::lround(left));
    if (legend.parts.empty()) {
        draw_scale(image, legend, measures, x, ink);
    } else {
        draw_names(image, legend, measures, x, ink);
    }
}

}  // namespace lissom
