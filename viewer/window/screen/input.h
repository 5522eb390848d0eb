/// Input: what a hand did, as the window tells it, and a queue in which moves do not pile up.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"

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
    /// Of a scroll: lines to the right and up.
    Vec2 scroll = Vec2::Zero();
    Key key = Key::none;
    /// Of text: the character. Of Key::character: the letter or digit on the key, in capitals.
    char32_t character = 0;
    /// Of a drop: paths.
    std::vector<std::string> files = {};
};

/// Inputs in their order. Of moves that follow each other only the last is kept, so that whoever is
/// slower than the hand is never behind it by more than one.
class InputQueue {
  public:
    void push(Input input);
    /// All of it; the queue is empty afterwards.
    std::vector<Input> take();
    bool empty() const { return inputs_.empty(); }

  private:
    std::vector<Input> inputs_;
};

}  // namespace lissom::window
