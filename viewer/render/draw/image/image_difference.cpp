#include "viewer/render/draw/image/image_difference.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace lissom {
namespace {

using Levels = std::array<int, 4>;

// Red, green and blue by their part of the pixel, and alpha; 0 to 255 * 255.
Levels levels(const Image& image, int x, int y) {
    const std::uint8_t* const p = image.pixel(x, y);
    return {p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3] * 255};
}

// How far the colour of a pixel of `image` lies outside of those around it in `other`, 0 to 1.
double outside(const Image& image, const Image& other, int x, int y) {
    const Levels own = levels(image, x, y);
    Levels low = levels(other, x, y), high = low;
    for (int v = std::max(0, y - 1); v <= std::min(y + 1, other.height - 1); ++v) {
        for (int u = std::max(0, x - 1); u <= std::min(x + 1, other.width - 1); ++u) {
            const Levels around = levels(other, u, v);
            for (std::size_t k = 0; k < 4; ++k) {
                low[k] = std::min(low[k], around[k]);
                high[k] = std::max(high[k], around[k]);
            }
        }
    }
    int distance = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        distance = std::max({distance, low[k] - own[k], own[k] - high[k]});
    }
    return distance / (255.0 * 255.0);
}

// Returns red for pixels that differ, a faint grey of the golden picture elsewhere.
Color marked(const Image& golden, int x, int y, bool differs) {
    if (differs) return {0.9, 0.0, 0.1};
    const double gray = 1.0 - 0.3 * (1.0 - lightness(golden.color(x, y)));
    return {gray, gray, gray};
}

void set_pixel(Image& image, int x, int y, const Color& color) {
    const auto bytes = to_bytes(color);
    std::copy(bytes.begin(), bytes.end(), image.pixel(x, y));
}

// The pictures with a grey gap between them.
Image side_by_side(const std::array<const Image*, 3>& images) {
    constexpr int kGap = 8;
    const int width = images[0]->width, height = images[0]->height;
    Image result(3 * width + 2 * kGap, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < result.width; ++x) set_pixel(result, x, y, {0.5, 0.5, 0.5});
    }
    for (int i = 0; i < 3; ++i) result.paste(*images[at(i)], i * (width + kGap), 0);
    return result;
}

// Counts the pixels of the patch that holds (x, y), and clears them.
std::size_t take_patch(std::vector<char>& differs, int width, int height, int x, int y) {
    std::vector<std::pair<int, int>> open{{x, y}};
    differs[at(y) * at(width) + at(x)] = 0;
    std::size_t count = 0;
    while (!open.empty()) {
        const auto [u, v] = open.back();
        open.pop_back();
        ++count;
        for (int b = std::max(0, v - 1); b <= std::min(v + 1, height - 1); ++b) {
            for (int a = std::max(0, u - 1); a <= std::min(u + 1, width - 1); ++a) {
                char& there = differs[at(b) * at(width) + at(a)];
                if (there) open.emplace_back(a, b);
                there = 0;
            }
        }
    }
    return count;
}

void find_largest_patch(std::vector<char> differs, int width, int height, ImageDifference& result) {
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (!differs[at(y) * at(width) + at(x)]) continue;
            const std::size_t count = take_patch(differs, width, height, x, y);
            if (count <= result.patch) continue;
            result.patch = count;
            result.patch_x = x;
            result.patch_y = y;
        }
    }
}

}  // namespace

ImageDifference compare_images(const Image& picture, const Image& golden, double tolerance) {
    ImageDifference result;
    Image marks(golden.width, golden.height);
    std::size_t count = 0;
    std::vector<char> differing;
    differing.reserve(at(golden.width) * at(golden.height));
    for (int y = 0; y < golden.height; ++y) {
        for (int x = 0; x < golden.width; ++x) {
            const double distance =
                std::max(outside(picture, golden, x, y), outside(golden, picture, x, y));
            const bool differs = distance > tolerance;
            count += differs ? 1 : 0;
            differing.push_back(differs ? 1 : 0);
            set_pixel(marks, x, y, marked(golden, x, y, differs));
            if (distance <= result.greatest) continue;
            result.greatest = distance;
            result.x = x;
            result.y = y;
        }
    }
    result.fraction = static_cast<double>(count) / (at(golden.width) * golden.height);
    find_largest_patch(std::move(differing), golden.width, golden.height, result);
    result.shown = side_by_side({&golden, &picture, &marks});
    return result;
}

}  // namespace lissom
