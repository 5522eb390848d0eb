#include "viewer/lua/picture_check.h"

#include <array>
#include <cstdio>

#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"
#include "viewer/lua/png_file.h"
#include "viewer/render/draw/image/image_difference.h"

namespace lissom::cli {
namespace {

std::string size_text(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

std::string color_text(const Image& image, int x, int y) {
    const std::uint8_t* const p = image.pixel(x, y);
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), p[3] == 255 ? "#%02x%02x%02x" : "#%02x%02x%02x%02x",
                  p[0], p[1], p[2], p[3]);
    return text.data();
}

std::string difference_text(const ImageDifference& found, const PictureCheck& check,
                            const Image& picture, const Image& golden) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "%.3g %% of the pixels differ from %s by more than %g (%g %% may), ",
                  100.0 * found.fraction, check.golden.filename().string().substr(0, 60).c_str(),
                  check.tolerance, 100.0 * check.pixels);
    std::string patch;
    if (double(found.patch) > check.connected) {
        patch = std::to_string(found.patch) + " of them touch one another, at (" +
                std::to_string(found.patch_x) + ", " + std::to_string(found.patch_y) +
                "): another shape, not noise, ";
    }
    return text.data() + patch + std::string("most at (") + std::to_string(found.x) + ", " +
           std::to_string(found.y) + "): expected " + color_text(golden, found.x, found.y) +
           ", got " + color_text(picture, found.x, found.y) +
           "\nthe golden picture, this one and their differences: " + check.difference.string();
}

}  // namespace

std::string compare_pictures(const PictureCheck& check) {
    const Image picture = load_picture(check.picture), golden = load_picture(check.golden);
    if (picture.width != golden.width || picture.height != golden.height) {
        return "expected " + size_text(golden) + " as " + display_name(check.golden) +
               " has, got " + size_text(picture);
    }
    const ImageDifference found = compare_images(picture, golden, check.tolerance);
    if (found.fraction <= check.pixels && double(found.patch) <= check.connected) return "";
    save_picture(found.shown, check.difference);
    return difference_text(found, check, picture, golden);
}

}  // namespace lissom::cli
