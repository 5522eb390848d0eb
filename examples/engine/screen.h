/// Where the engine draws: a window, or memory where there is none.
#pragma once

#include <memory>
#include <string>

namespace engine {

/// What a hand did since the last frame, in the picture: from -1 to 1, upwards and to the right.
struct Hand {
    double x = 0.0, y = 0.0;
    bool is_down = false, has_closed = false;
};

class Screen {
  public:
    virtual ~Screen() = default;
    /// Shows what was drawn, and waits for the next frame.
    virtual void show() = 0;
    virtual Hand hand() = 0;
};

constexpr int kWidth = 1280, kHeight = 720;

/// With an OpenGL context of version 3.3 that is current; null where there can be none.
std::unique_ptr<Screen> open_window();
std::unique_ptr<Screen> open_memory();

/// Writes what was drawn as a PNG file.
bool save_picture(const std::string& path);

}  // namespace engine
