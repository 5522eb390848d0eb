#include "viewer/window/screen/input.h"

#include <utility>

namespace lissom::window {

std::vector<Input> InputQueue::take() {
    return std::exchange(inputs_, {});
}

Input InputMaker::made(Input::Kind kind) const {
    Input input;
    input.kind = kind;
    input.at = scale_().pixels(cursor_);
    input.modifiers = held_;
    return input;
}

void InputMaker::move(const Vec2& cursor) {
    cursor_ = cursor;
    queue_.push(made(Input::Kind::move));
}

void InputMaker::button(MouseButton button, bool is_down, const Modifiers& held) {
    held_ = held;
    Input input = made(is_down ? Input::Kind::press : Input::Kind::release);
    input.button = button;
    queue_.push(std::move(input));
}

void InputMaker::scroll(const Vec2& lines) {
    Input input = made(Input::Kind::scroll);
    input.scroll = lines;
    queue_.push(std::move(input));
}

void InputMaker::key(Key key, char32_t code, bool is_down, const Modifiers& held) {
    const Modifiers before = std::exchange(held_, held);
    if (is_down) letter_ = key == Key::character ? code : 0;
    if (key == Key::none) {
        if (held_ != before) queue_.push(made(Input::Kind::move));
        return;
    }
    Input input = made(is_down ? Input::Kind::key_down : Input::Kind::key_up);
    input.key = key;
    if (key == Key::character) input.character = code;
    queue_.push(std::move(input));
}

void InputMaker::text(char32_t character) {
    Input input = made(Input::Kind::text);
    input.character = character;
    input.letter = letter_;
    queue_.push(std::move(input));
}

void InputMaker::drop(std::vector<std::string> files) {
    Input input = made(Input::Kind::drop);
    input.files = std::move(files);
    queue_.push(std::move(input));
}

}  // namespace lissom::window
