/// Strands and triangles as samples of a picture's pixels. A strand is a ribbon that faces the
/// viewer, as wide as it is: below a pixel it covers a part of the pixel's
/// samples, so that thin strands fade instead of breaking into dots.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A point as it lies in the picture.
struct ScreenPoint {
    /// Pixels from the top left.
    float x = 0.0f, y = 0.0f;
    /// 0 at the near end of the depth range, 1 at the far one; linear in the picture.
    float depth = 0.0f;
    /// Half the width of the strand in pixels.
    float radius = 0.0f;
};

/// A rectangle of a picture with sixteen samples a pixel. A sample shows the nearest surface, in
/// any order of drawing; of two at the same depth, the lower id.
class SampleTile {
  public:
    static constexpr int kSamples = 16;
    /// Ids of samples that no strand is seen at.
    static constexpr std::uint32_t kNothing = 0xffffffff, kSurface = 0xfffffffe;

    /// Covers the pixels (left, top) to (left + width - 1, top + height - 1).
    SampleTile(int left, int top, int width, int height);

    int left() const { return left_; }
    int top() const { return top_; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// Draws a piece of a strand, with round ends; `id` is less than kSurface. Nothing if a number
    /// is not finite or both ends have no width.
    void draw_segment(const ScreenPoint& begin, const ScreenPoint& end, std::uint32_t id);
    /// Draws a triangle that hides everything behind it, on both of its sides.
    void draw_triangle(const std::array<ScreenPoint, 3>& corners);

    /// Updates the hierarchical depth: the greatest depth in each block of pixels, for `occludes`.
    void update_depth_blocks();
    /// Returns whether content drawn before `update_depth_blocks` hides everything at `depth` or
    /// beyond in a rectangle of the picture; false if that is not certain.
    bool occludes(float left, float top, float right, float bottom, float depth) const;

    /// Returns the id at a sample. Pixels count from the top left of the picture.
    std::uint32_t id(int x, int y, int sample) const {
        return static_cast<std::uint32_t>(keys_[place(x, y) * kSamples + sample]);
    }
    /// Returns the position of a sample in the picture.
    Eigen::Vector2f position(int x, int y, int sample) const;

  private:
    // Pixels along a side of a block, for `occludes`.
    static constexpr int kBlock = 4;

    std::size_t place(int x, int y) const { return at(y - top_) * width_ + (x - left_); }
    std::size_t block(int x, int y) const { return at(y / kBlock) * block_columns_ + (x / kBlock); }
    template <bool steep>
    void draw_along(const ScreenPoint& begin, const ScreenPoint& end, std::uint32_t id);
    void cover(int x, int y, const ScreenPoint& begin, const ScreenPoint& end, std::uint32_t id);
    void update_pixel_depth(std::size_t pixel);
    void put(std::size_t pixel, int sample, float depth, std::uint32_t id);

    int left_, top_, width_, height_;
    /// Key of each sample: bits of the depth, which grow with it, before those of the id.
    std::vector<std::uint64_t> keys_;
    /// Greatest depth seen in each pixel, and the number of samples put since it was
    /// found.
    std::vector<float> pixel_depth_;
    std::vector<std::uint8_t> puts_;
    int block_columns_ = 0;
    /// The farthest of the pixels of each block.
    std::vector<float> block_depth_;
};

}  // namespace lissom
