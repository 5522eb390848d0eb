/// Target of the engine's drawing: a window, or memory if there is none.
#pragma once

#include <memory>
#include <string>

namespace engine {

/// Moves of a hand since the last frame, in the picture: from -1 to 1, upwards and to the right.
struct Hand {
    double x = 0.0, y = 0.0;
    bool is_down = false, has_closed = false;
};

class Screen {
  public:
    virtual ~Screen() = default;
    /// Shows the drawn frame, and waits for the next one.
    virtual void show() = 0;
    virtual Hand hand() = 0;
};

constexpr int kWidth = 1280, kHeight = 720;

/// Returns a window with an OpenGL context of version 3.3 that is current; null if there can be
/// none.
std::unique_ptr<Screen> open_window();
std::unique_ptr<Screen> open_memory();

/// Writes the drawn frame as a PNG file.
bool save_picture(const std::string& path);

}  // namespace engine
