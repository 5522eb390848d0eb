/// Legend: the colour scale beside a picture, with its numbers, or names with their colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/render/draw/drawing.h"
#include "viewer/render/draw/image/image.h"

namespace lissom {

struct LegendPart {
    std::string name;
    Color color = {};

    bool operator==(const LegendPart&) const = default;
};

struct Legend {
    ValueRange range = {};
    /// Title above the scale or the names: the meaning of the numbers.
    std::string label = {};
    /// Names drawn instead of the scale, if there are any; names that do not fit are counted.
    std::vector<LegendPart> parts = {};

    bool operator==(const Legend&) const = default;
};

/// A number beside the scale.
struct LegendTick {
    /// 0 is the low end of the scale, 1 the high.
    double place = 0.0;
    std::string text;
};

/// Returns both ends of the range, and round numbers between them if there is room.
std::vector<LegendTick> legend_ticks(const ValueRange& range);

/// Returns the columns of pixels that a legend takes in a picture of `picture_height` rows.
int legend_width(const Legend& legend, int picture_height);

/// Draws a legend into the last `legend_width` columns of `image`, in `ink`.
void draw_legend(Image& image, const Legend& legend, const Color& ink);

/// Returns ink that reads on a background; on none, that of a white one.
Color ink_on(const std::optional<Color>& background);

}  // namespace lissom
