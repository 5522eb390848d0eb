/// PixelScale: the units of a desktop's window and the pixels of its framebuffer.
#pragma once

#include "kernel/core/geometry.h"
#include "viewer/render/gl/gl_objects.h"

namespace lissom::window {

struct PixelScale {
    /// Size of the window in the desktop's units, those of cursors, and of its framebuffer in
    /// pixels.
    gl::Extent window = {1, 1}, framebuffer = {1, 1};
    /// The desktop's scale of letters, as a factor of their usual size in pixels.
    double content = 1.0;

    /// Returns the pixel under a cursor.
    Vec2 pixels(const Vec2& cursor) const;
    /// Pixels in a unit of length of the panel: 1, or 2 on a screen of high density.
    double panel() const;
};

}  // namespace lissom::window
