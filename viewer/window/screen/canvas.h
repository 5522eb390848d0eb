/// Canvas: a rectangle of a window.
#pragma once

namespace lissom::window {

/// In pixels from the window's top left corner.
struct Canvas {
    int x = 0, y = 0, width = 1, height = 1;

    bool operator==(const Canvas&) const = default;
};

}  // namespace lissom::window
