#include "viewer/window/screen/input.h"

#include <utility>

namespace lissom::window {

void InputQueue::push(Input input) {
    const bool repeats = !inputs_.empty() && input.kind == Input::Kind::move &&
                         inputs_.back().kind == Input::Kind::move &&
                         inputs_.back().modifiers == input.modifiers;
    if (repeats) {
        inputs_.back() = std::move(input);
    } else {
        inputs_.push_back(std::move(input));
    }
}

std::vector<Input> InputQueue::take() {
    return std::exchange(inputs_, {});
}

}  // namespace lissom::window
