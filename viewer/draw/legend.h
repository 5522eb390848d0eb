/// Legend: the colour scale beside a picture, with its numbers.
#pragma once

#include <string>
#include <vector>

#include "viewer/draw/drawing.h"
#include "viewer/draw/image.h"

namespace lissom {

struct Legend {
    ValueRange range;
    /// Stands above the scale: what the numbers are.
    std::string label = {};
};

/// A number beside the scale.
struct LegendTick {
    /// 0 is the low end of the scale, 1 the high.
    double place = 0.0;
    std::string text;
};

/// Both ends of the range, and round numbers between them where there is room.
std::vector<LegendTick> legend_ticks(const ValueRange& range);

/// Columns of pixels that a legend takes in a picture of `picture_height` rows.
int legend_width(const Legend& legend, int picture_height);

/// Draws a legend into the last `legend_width` columns of `image`, in `ink`.
void draw_legend(Image& image, const Legend& legend, const Color& ink);

}  // namespace lissom
