#include "viewer/window/screen/input.h"

#include <doctest/doctest.h>

using namespace lissom;
using namespace lissom::window;

namespace {

Input input_at(Input::Kind kind, double x) {
    Input input;
    input.kind = kind;
    input.at = {x, 0.0};
    return input;
}

}  // namespace

TEST_CASE("input: of moves that follow each other the last is left, and nothing else is") {
    InputQueue queue;
    queue.push(input_at(Input::Kind::move, 1.0));
    queue.push(input_at(Input::Kind::move, 2.0));
    queue.push(input_at(Input::Kind::press, 2.0));
    for (int i = 3; i < 1000; ++i) queue.push(input_at(Input::Kind::move, i));
    queue.push(input_at(Input::Kind::release, 999.0));
    queue.push(input_at(Input::Kind::scroll, 999.0));
    queue.push(input_at(Input::Kind::scroll, 999.0));
    const std::vector<Input> inputs = queue.take();
    REQUIRE(inputs.size() == 6);
    CHECK(inputs[0].at.x() == 2.0);
    CHECK(inputs[1].kind == Input::Kind::press);
    CHECK(inputs[2].at.x() == 999.0);
    CHECK(inputs[3].kind == Input::Kind::release);
    CHECK(queue.empty());
}

TEST_CASE("input: moves with other modifiers are kept apart") {
    InputQueue queue;
    queue.push(input_at(Input::Kind::move, 1.0));
    Input shifted = input_at(Input::Kind::move, 2.0);
    shifted.modifiers.shift = true;
    queue.push(shifted);
    CHECK(queue.take().size() == 2);
}
