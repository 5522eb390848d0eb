/// Options of a picture: the size of the picture, its samples and its shading.
#pragma once

#include <optional>

#include "viewer/render/draw/image/color.h"

namespace lissom {

/// Options that turn a drawing into pixels.
struct RenderOptions {
    /// Size in pixels: at least 1, at most `Renderer::maximum_size`.
    int width = 1280;
    int height = 960;
    /// Nothing: transparent.
    std::optional<Color> background = kWhite;
    /// Samples a pixel along edges of meshes: 1, 2, 4, ... as far as the driver has them. Strands
    /// always have 16.
    int samples = 4;
    /// Pixels that are drawn along each side of one in the picture, 1 to 4; 2 is for print.
    int supersample = 1;
    /// Pixels of the picture for one that styles count widths of lines and points in: a coarse
    /// picture that is shown enlarged has fewer. Above 0.
    double mark_scale = 1.0;
    /// Darkness of folds and contacts, 0 (none; quicker) to 1.
    double occlusion = 1.0;
};

}  // namespace lissom
