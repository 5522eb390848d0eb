// Inputs of a hand for tools: what piles up, and what keys are called.
#include <doctest/doctest.h>

#include <vector>

#include "tests/unit/viewer/window/session/tool_host.h"

using namespace lissom;
using namespace lissom::window;
using namespace lissom::test;

TEST_CASE("tool input: looks, turns of the wheel and ticks do not pile up, and no move is lost") {
    std::vector<ToolInput> inputs;
    push_input(inputs, input(Kind::move, 1.0));
    push_input(inputs, input(Kind::move, 2.0));
    push_input(inputs, input(Kind::press, 2.0));
    for (int i = 0; i < 100; ++i) push_input(inputs, input(Kind::move, i));
    push_input(inputs, key("a"));
    push_input(inputs, key("a"));
    push_input(inputs, input(Kind::look));
    push_input(inputs, input(Kind::look));
    ToolInput shifted = input(Kind::move, 7.0);
    push_input(inputs, input(Kind::move, 6.0));
    shifted.modifiers.shift = true;
    push_input(inputs, shifted);
    ToolInput turned = input(Kind::wheel);
    for (const double lines : {1.0, 2.0, -0.5}) {
        turned.lines = lines;
        push_input(inputs, turned);
    }
    ToolInput ticked = input(Kind::tick);
    for (int i = 0; i < 3; ++i) {
        ticked.seconds = 0.25;
        push_input(inputs, ticked);
    }
    REQUIRE(inputs.size() == 110);
    CHECK(inputs[109].seconds == 0.75);
    CHECK(inputs[0].at.x() == 1.0);
    CHECK(inputs[102].at.x() == 99.0);
    CHECK(inputs[108].lines == 2.5);
    CHECK(is_followed(inputs, 0));
    CHECK_FALSE(is_followed(inputs, 1));
    CHECK_FALSE(is_followed(inputs, 2));
    // The modifiers of the next one differ.
    CHECK_FALSE(is_followed(inputs, 106));
}

TEST_CASE("tool input: keys have the names that tools know") {
    Input typed;
    typed.kind = Input::Kind::text;
    typed.character = U'P';
    CHECK(tool_key(typed) == "p");
    typed.character = U'+';
    CHECK(tool_key(typed) == "+");
    typed.character = U'é';
    typed.letter = U'2';
    CHECK(tool_key(typed).empty());
    typed.character = U'ц';
    typed.letter = U'W';
    CHECK(tool_key(typed) == "w");
    Input pressed;
    pressed.kind = Input::Kind::key_down;
    pressed.key = Key::enter;
    CHECK(tool_key(pressed) == "enter");
}
