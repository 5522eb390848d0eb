/// Difference of two pictures of the same scene, which different drivers may have drawn.
#pragma once

#include <cstddef>

#include "viewer/render/draw/image/image.h"

namespace lissom {

struct ImageDifference {
    /// The part of the pixels that differ, and by how much at most: 0 to 1 of a colour's range.
    double fraction = 0.0, greatest = 0.0;
    /// The pixel that differs most.
    int x = 0, y = 0;
    /// Pixels of the largest patch of differing pixels that touch one another, corners included,
    /// and the first of them: noise is scattered, another shape is not.
    std::size_t patch = 0;
    int patch_x = 0, patch_y = 0;
    /// The golden picture, the other one, and their difference, side by side.
    Image shown;
};

/// Compares pictures of one size. A pixel differs if its colour lies, by more than `tolerance`,
/// outside of the colours that the other picture has within one pixel of it, in either direction:
/// an edge may lie half a pixel elsewhere, but nothing may be missing. Colours count by their
/// alpha.
ImageDifference compare_images(const Image& picture, const Image& golden, double tolerance);

}  // namespace lissom
