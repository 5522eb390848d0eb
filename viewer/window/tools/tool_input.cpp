#include "viewer/window/tools/tool_input.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace lissom::window {

gl::Extent ToolPixels::size(const PictureSize& pixels) const {
    return {std::max(index_of(std::lround(pixels.width / scale)), 1),
            std::max(index_of(std::lround(pixels.height / scale)), 1)};
}

void push_input(std::vector<ToolInput>& inputs, ToolInput input) {
    using Kind = ToolInput::Kind;
    const bool piles_up =
        input.kind == Kind::look || input.kind == Kind::wheel || input.kind == Kind::tick;
    const bool replaces = piles_up && !inputs.empty() && inputs.back().kind == input.kind &&
                          inputs.back().modifiers == input.modifiers;
    if (replaces) {
        if (input.kind == Kind::wheel) input.lines += inputs.back().lines;
        if (input.kind == Kind::tick) input.seconds += inputs.back().seconds;
        inputs.back() = std::move(input);
    } else {
        inputs.push_back(std::move(input));
    }
}

bool is_followed(const std::vector<ToolInput>& inputs, std::size_t place) {
    if (inputs[place].kind != ToolInput::Kind::move || place + 1 == inputs.size()) return false;
    const ToolInput& next = inputs[place + 1];
    return next.kind == ToolInput::Kind::move && next.modifiers == inputs[place].modifiers;
}

std::string tool_key(const Input& input) {
    switch (input.key) {
        case Key::enter:
            return "enter";
        case Key::tab:
            return "tab";
        case Key::backspace:
            return "backspace";
        case Key::del:
            return "delete";
        case Key::space:
            return "space";
        case Key::left:
            return "left";
        case Key::right:
            return "right";
        case Key::up:
            return "up";
        case Key::down:
            return "down";
        default:
            break;
    }
    if (input.kind != Input::Kind::text) return "";
    const bool has_latin = input.letter >= U'A' && input.letter <= U'Z';
    const char32_t typed = input.character > 127 && has_latin ? input.letter : input.character;
    if (typed <= 32 || typed >= 127) return "";
    return std::string(1, static_cast<char>(std::tolower(static_cast<int>(typed))));
}

}  // namespace lissom::window
