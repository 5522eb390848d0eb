/// A small typeface of single strokes, so that pictures can carry numbers and names at any size
/// without a font file. Printable ASCII; other characters are drawn as a box.
#pragma once

#include <string_view>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A pen's path; y points up, 0 is the line that the text stands on.
using Stroke = std::vector<Vec2>;

struct TextStrokes {
    std::vector<Stroke> strokes;
    /// Distance from the left of the first letter to the right of the last.
    double width = 0.0;
};

/// Lays out `text` (UTF-8) in one line that starts at x = 0, with capitals of `height`.
TextStrokes lay_out_text(std::string_view text, double height);

}  // namespace lissom
