/// Flat drawing on a finished picture: text, lines and rectangles.
#pragma once

#include <string_view>
#include <vector>

#include "viewer/render/draw/image/image.h"
#include "viewer/render/draw/image/stroke_font.h"

namespace lissom {

/// Paints the pixels of columns [x, x + width) and rows [y, y + height) that the image has.
void fill_rectangle(Image& image, int x, int y, int width, int height, const Color& color);

/// Draws with a round pen of `width` pixels. Points are pixel positions from the top left. Pixels
/// covered by several strokes are painted once.
void draw_strokes(Image& image, const std::vector<Stroke>& strokes, double width,
                  const Color& color);

/// Draws `text` with capitals of `height` pixels; it starts at (x, y) on its base line.
void draw_text(Image& image, std::string_view text, double x, double y, double height,
               const Color& color);

}  // namespace lissom
