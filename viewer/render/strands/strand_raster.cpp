#include "viewer/render/strands/strand_raster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lissom {
namespace {

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
// Samples put into a pixel until its farthest depth is looked for again.
constexpr std::uint8_t kPutsToUpdate = 8;
// Triangles that meet leave no samples out between them, in spite of rounding.
constexpr double kOverlap = 1e-4;

bool finite(const ScreenPoint& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.depth) &&
           std::isfinite(p.radius);
}

// Places of a pixel's samples, 0 to 1: of all 16 x 16 squares of the pixel, one in every row and
// column, and one in every rectangle of 16 squares (Sobol's (0, 2)-net). A strand of any width is
// so covered in proportion. Scrambled by exclusive or and moved within the squares, differently
// from pixel to pixel: strands along a diagonal would else meet the same gaps all the way.
struct Pattern {
    std::array<float, SampleTile::kSamples> x{}, y{};
};

constexpr unsigned kPatterns = 16;

constexpr float fraction(float x) {
    return x - static_cast<int>(x);
}

constexpr std::array<Pattern, kPatterns> make_patterns() {
    std::array<Pattern, kPatterns> patterns;
    for (unsigned i = 0; i < kPatterns; ++i) {
        const float shift_x = fraction(0.7548777f * i + 0.03f);
        const float shift_y = fraction(0.5698403f * i + 0.03f);
        for (unsigned k = 0; k < SampleTile::kSamples; ++k) {
            const unsigned reversed = (k & 1) << 3 | (k & 2) << 1 | (k & 4) >> 1 | (k & 8) >> 3;
            const unsigned column = k ^ i, row = reversed ^ ((7 * i + 5) & 15);
            patterns[i].x[k] = (column + shift_x) / SampleTile::kSamples;
            patterns[i].y[k] = (row + shift_y) / SampleTile::kSamples;
        }
    }
    return patterns;
}

constexpr std::array<Pattern, kPatterns> kPattern = make_patterns();

const Pattern& pattern(int x, int y) {
    auto bits = static_cast<std::uint32_t>(x) + 0x9e3779b9U * static_cast<std::uint32_t>(y);
    bits = (bits ^ bits >> 16) * 0x7feb352dU;
    bits = (bits ^ bits >> 15) * 0x846ca68bU;
    return kPattern[(bits ^ bits >> 16) % kPatterns];
}

// Pixels whose centre line from a to b, `reach` wide on both sides, may lie in: first and last.
struct PixelRange {
    int first, last;
};

PixelRange pixels_between(float a, float b, float reach, int low, int count) {
    const float least = low, end = low + count;
    const float first = std::min(a, b) - reach, last = std::max(a, b) + reach;
    if (!(first < end) || !(last >= least)) return {0, -1};
    // Numbers from 0 on are cut off as they are rounded down, but much faster.
    return {low + static_cast<int>(std::max(first - least, 0.0f)),
            std::min(low + static_cast<int>(std::min(last, end) - least), low + count - 1)};
}

}  // namespace

SampleTile::SampleTile(int left, int top, int width, int height)
    : left_(left), top_(top), width_(width), height_(height) {
    const std::size_t pixels = at(width) * height;
    keys_.assign(pixels * kSamples, kEmpty);
    pixel_depth_.assign(pixels, std::numeric_limits<float>::infinity());
    puts_.assign(pixels, 0);
    block_columns_ = (width + kBlock - 1) / kBlock;
    const int block_rows = (height + kBlock - 1) / kBlock;
    block_depth_.assign(at(block_columns_) * block_rows, std::numeric_limits<float>::infinity());
}

void SampleTile::update_depth_blocks() {
    std::fill(block_depth_.begin(), block_depth_.end(), 0.0f);
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            float& farthest = block_depth_[block(x, y)];
            farthest = std::max(farthest, pixel_depth_[place(left_ + x, top_ + y)]);
        }
    }
}

bool SampleTile::occludes(float left, float top, float right, float bottom, float depth) const {
    const PixelRange columns = pixels_between(left, right, 0.0f, left_, width_);
    const PixelRange rows = pixels_between(top, bottom, 0.0f, top_, height_);
    if (columns.last < columns.first || rows.last < rows.first) return true;
    for (int y = (rows.first - top_) / kBlock; y <= (rows.last - top_) / kBlock; ++y) {
        for (int x = (columns.first - left_) / kBlock; x <= (columns.last - left_) / kBlock; ++x) {
            if (depth <= block_depth_[block(x * kBlock, y * kBlock)]) return false;
        }
    }
    return true;
}

Eigen::Vector2f SampleTile::position(int x, int y, int sample) const {
    const Pattern& samples = pattern(x, y);
    const std::size_t at = sample;
    return {x + samples.x[at], y + samples.y[at]};
}

void SampleTile::put(std::size_t pixel, int sample, float depth, std::uint32_t id) {
    const std::uint64_t key = std::uint64_t{std::bit_cast<std::uint32_t>(depth)} << 32 | id;
    std::uint64_t& seen = keys_[pixel * kSamples + sample];
    if (key >= seen) return;
    seen = key;
    if (++puts_[pixel] == kPutsToUpdate) update_pixel_depth(pixel);
}

void SampleTile::update_pixel_depth(std::size_t pixel) {
    puts_[pixel] = 0;
    const auto* const keys = keys_.data() + pixel * kSamples;
    const auto bits = static_cast<std::uint32_t>(*std::max_element(keys, keys + kSamples) >> 32);
    const bool covered = bits != static_cast<std::uint32_t>(kEmpty >> 32);
    if (covered) pixel_depth_[pixel] = std::bit_cast<float>(bits);
}

void SampleTile::draw_segment(const ScreenPoint& begin, const ScreenPoint& end, std::uint32_t id) {
    if (!finite(begin) || !finite(end)) return;
    if (!(std::max(begin.radius, end.radius) > 0.0f)) return;
    if (std::min(begin.depth, end.depth) < 0.0f) return;
    const bool steep = std::abs(end.y - begin.y) >= std::abs(end.x - begin.x);
    steep ? draw_along<true>(begin, end, id) : draw_along<false>(begin, end, id);
}

// Visits rows of pixels along the segment's longer side, and in each the few that it may touch.
template <bool steep>
void SampleTile::draw_along(const ScreenPoint& begin, const ScreenPoint& end, std::uint32_t id) {
    const float a = steep ? begin.y : begin.x, b = steep ? end.y : end.x;
    const float a_across = steep ? begin.x : begin.y, b_across = steep ? end.x : end.y;
    const float radius = std::max(begin.radius, end.radius);
    const float nearest = std::min(begin.depth, end.depth);
    const float slope = a == b ? 0.0f : (b_across - a_across) / (b - a);
    const PixelRange rows =
        pixels_between(a, b, radius, steep ? top_ : left_, steep ? height_ : width_);
    const float low = std::min(a, b), high = std::max(a, b);
    const auto across_at = [&](float along) {
        return a_across + slope * (std::min(std::max(along, low), high) - a);
    };
    for (int row = rows.first; row <= rows.last; ++row) {
        const float from = row - radius;
        const PixelRange columns =
            pixels_between(across_at(from), across_at(from + 1.0f + 2.0f * radius), radius,
                           steep ? left_ : top_, steep ? width_ : height_);
        for (int column = columns.first; column <= columns.last; ++column) {
            const int x = steep ? column : row, y = steep ? row : column;
            if (nearest <= pixel_depth_[place(x, y)]) cover(x, y, begin, end, id);
        }
    }
}

// Puts the samples of a pixel that are no farther from the segment than its radius there.
void SampleTile::cover(int x, int y, const ScreenPoint& begin, const ScreenPoint& end,
                       std::uint32_t id) {
    using Samples = Eigen::Array<float, kSamples, 1>;
    const Pattern& samples = pattern(x, y);
    const float dx = end.x - begin.x, dy = end.y - begin.y;
    const float square = dx * dx + dy * dy;
    const float inverse = square > 1e-12f ? 1.0f / square : 0.0f;
    const Samples px = Eigen::Map<const Samples>(samples.x.data()) + (x - begin.x);
    const Samples py = Eigen::Map<const Samples>(samples.y.data()) + (y - begin.y);
    const Samples share = ((px * dx + py * dy) * inverse).max(0.0f).min(1.0f);
    const Samples radius = begin.radius + share * (end.radius - begin.radius);
    const Samples beyond =
        (px - share * dx).square() + (py - share * dy).square() - radius.square();
    const std::size_t pixel = place(x, y);
    for (Eigen::Index first = 0; first < kSamples; first += 4) {
        if (!(beyond.segment<4>(first).minCoeff() < 0.0f)) continue;
        for (Eigen::Index k = first; k < first + 4; ++k) {
            if (!(beyond[k] < 0.0f)) continue;
            put(pixel, index_of(k), begin.depth + share[k] * (end.depth - begin.depth), id);
        }
    }
}

void SampleTile::draw_triangle(const std::array<ScreenPoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    if (!finite(a) || !finite(b) || !finite(c)) return;
    const double area = (static_cast<double>(b.x) - a.x) * (static_cast<double>(c.y) - a.y) -
                        (static_cast<double>(c.x) - a.x) * (static_cast<double>(b.y) - a.y);
    if (area == 0.0) return;
    const PixelRange rows =
        pixels_between(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), 0.0f, top_, height_);
    const PixelRange columns =
        pixels_between(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), 0.0f, left_, width_);
    // Weights of b and c at a point, each w0 + wx x + wy y.
    const double bx = (static_cast<double>(c.y) - a.y) / area,
                 by = -(static_cast<double>(c.x) - a.x) / area;
    const double cx = -(static_cast<double>(b.y) - a.y) / area,
                 cy = (static_cast<double>(b.x) - a.x) / area;
    const double slack =
        kOverlap * std::max({std::abs(bx) + std::abs(by), std::abs(cx) + std::abs(cy),
                             std::abs(bx + cx) + std::abs(by + cy)});
    for (int y = rows.first; y <= rows.last; ++y) {
        for (int x = columns.first; x <= columns.last; ++x) {
            const Pattern& samples = pattern(x, y);
            for (std::size_t k = 0; k < kSamples; ++k) {
                const double px = static_cast<double>(x) + samples.x[k] - a.x;
                const double py = static_cast<double>(y) + samples.y[k] - a.y;
                const double wb = bx * px + by * py, wc = cx * px + cy * py;
                if (wb < -slack || wc < -slack || wb + wc > 1.0 + slack) continue;
                const double depth = a.depth + wb * (static_cast<double>(b.depth) - a.depth) +
                                     wc * (static_cast<double>(c.depth) - a.depth);
                if (depth < 0.0) continue;
                put(place(x, y), index_of(k), static_cast<float>(depth), kSurface);
            }
        }
    }
}

}  // namespace lissom
