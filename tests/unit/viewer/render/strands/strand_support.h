/// Strands and scenes shared by the tests of how strands are drawn.
#pragma once

#include <cmath>
#include <initializer_list>
#include <vector>

#include "kernel/hair/strands/strands.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/strands/strand_layer.h"

namespace lissom::test {

inline Strands strands_of(const std::vector<std::vector<Vec3>>& lines, double width = kHairWidth) {
    std::vector<float> points;
    std::vector<Index> offsets = {0};
    for (const std::vector<Vec3>& line : lines) {
        for (const Vec3& p : line) {
            for (const double x : p) points.push_back(static_cast<float>(x));
        }
        offsets.push_back(offsets.back() + static_cast<Index>(line.size()));
    }
    Strands strands(std::move(points), std::move(offsets));
    StrandWidths widths;
    widths.common = static_cast<float>(width);
    strands.set_widths(widths);
    return strands;
}

/// Upright strands side by side in the xy plane at depth z, evenly over -1 to 1.
inline Strands curtain(Index count, double z, double width) {
    std::vector<std::vector<Vec3>> lines;
    for (Index s = 0; s < count; ++s) {
        // A shuffled order, of which every beginning is even.
        const double x = 2.0 * std::fmod(0.5 + 0.6180339887498949 * s, 1.0) - 1.0;
        lines.push_back({Vec3(x, 1, z), Vec3(x, 0, z), Vec3(x, -1, z)});
    }
    return strands_of(lines, width);
}

/// Sees x and y from -1 to 1 from +z without perspective.
inline ViewParameters front_view() {
    ViewParameters view;
    view.projection(2, 2) = -0.1;
    view.half_extent = Vec2(1, 1);
    view.perspective = false;
    view.near = -9.0;
    view.projection(2, 3) = 0.0;
    return view;
}

inline Snapshot drawing_of(const Strands& strands, const StrandStyle& style = {}) {
    Snapshot drawing;
    drawing.strands.push_back({shared(strands), style, {}});
    return drawing;
}

/// Strands of an opaque drawing are at least so many pixels wide.
inline StrandLayer layer_of_least(double min_width, const Snapshot& drawing,
                                  const ViewParameters& view,
                                  const RenderOptions& options = small_options(),
                                  const Context& context = {}) {
    const StrandScene scene{view_strands(drawing, view.view, Vec3::Zero()),
                            view_triangles(drawing, view.view, Vec3::Zero()), view, min_width};
    const StrandShadow shadow(scene.strands, scene.triangles, context);
    return draw_strands(scene, shadow, options, context);
}

inline StrandLayer layer_of(const Snapshot& drawing, const ViewParameters& view,
                            const RenderOptions& options = small_options(),
                            const Context& context = {}) {
    return layer_of_least(0.0, drawing, view, options, context);
}

/// Pixels that strands cover, partly covered ones by their share.
inline double covered_by_strands(const StrandLayer& layer) {
    double sum = 0.0;
    for (const StrandPixel& pixel : layer.pixels) sum += pixel.strands;
    return sum;
}

}  // namespace lissom::test
