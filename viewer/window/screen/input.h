/// Input: actions of a hand, as the window tells them, and a queue that keeps all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "viewer/window/screen/pixel_scale.h"

namespace lissom::window {

enum class MouseButton { left, right, middle };

/// Keys that the window acts upon; all others only type.
enum class Key {
    none,
    escape,
    enter,
    tab,
    backspace,
    del,
    left,
    right,
    up,
    down,
    home,
    end,
    page_up,
    page_down,
    space,
    f5,
    f12,
    // Letters and digits are their own: see Input::character.
    character
};

struct Modifiers {
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const Modifiers&) const = default;
};

/// One thing that happened. Positions are pixels of the picture from its top left corner.
struct Input {
    enum class Kind { press, release, move, scroll, key_down, key_up, text, drop };

    Kind kind = Kind::move;
    Vec2 at = Vec2::Zero();
    MouseButton button = MouseButton::left;
    Modifiers modifiers = {};
    /// For a scroll: lines to the right and up.
    Vec2 scroll = Vec2::Zero();
    Key key = Key::none;
    /// For text: the character. For Key::character: the letter or digit on the key, in capitals.
    char32_t character = 0;
    /// For text: the letter or digit of the key that was pressed last; 0 for none.
    char32_t letter = 0;
    /// For a drop: paths.
    std::vector<std::string> files = {};
};

/// Inputs in their order. Every move stays: a stroke is its whole course.
class InputQueue {
  public:
    void push(Input input) { inputs_.push_back(std::move(input)); }
    /// All of it; the queue is empty afterwards.
    std::vector<Input> take();
    bool empty() const { return inputs_.empty(); }

  private:
    std::vector<Input> inputs_;
};

/// InputMaker: converts events of a desktop to inputs. Cursors are in the desktop's units; if none
/// is given, the last one counts: when an input is taken, the hand may have moved on.
class InputMaker {
  public:
    /// `scale` tells that of the window at the time of an input.
    explicit InputMaker(std::function<PixelScale()> scale) : scale_(std::move(scale)) {}

    /// Sets the place of the cursor before the first event.
    void begin(const Vec2& cursor) { cursor_ = cursor; }
    void move(const Vec2& cursor);
    void button(MouseButton button, bool is_down, const Modifiers& held);
    /// Lines to the right and up.
    void scroll(const Vec2& lines);
    /// `code` is the character of Key::character. Key::none is a key that only modifies: tools act
    /// on that at once, also while the cursor rests.
    void key(Key key, char32_t code, bool is_down, const Modifiers& held);
    void text(char32_t character);
    void drop(std::vector<std::string> files);

    InputQueue& queue() { return queue_; }

  private:
    Input made(Input::Kind kind) const;

    std::function<PixelScale()> scale_;
    InputQueue queue_;
    Modifiers held_;
    Vec2 cursor_ = Vec2::Zero();
    char32_t letter_ = 0;
};

}  // namespace lissom::window
