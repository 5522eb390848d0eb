#include "viewer/window/screen/pixel_scale.h"

#include <algorithm>

namespace lissom::window {

Vec2 PixelScale::pixels(const Vec2& cursor) const {
    return {cursor.x() * framebuffer.width / std::max(window.width, 1),
            cursor.y() * framebuffer.height / std::max(window.height, 1)};
}

double PixelScale::panel() const {
    return std::max(content, 1.0);
}

}  // namespace lissom::window
