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

TEST_CASE("input: every move is kept in its order") {
    InputQueue queue;
    queue.push(input_at(Input::Kind::move, 1.0));
    queue.push(input_at(Input::Kind::move, 2.0));
    queue.push(input_at(Input::Kind::press, 2.0));
    for (int i = 3; i < 1000; ++i) queue.push(input_at(Input::Kind::move, i));
    queue.push(input_at(Input::Kind::release, 999.0));
    queue.push(input_at(Input::Kind::scroll, 999.0));
    queue.push(input_at(Input::Kind::scroll, 999.0));
    const std::vector<Input> inputs = queue.take();
    REQUIRE(inputs.size() == 1003);
    CHECK(inputs[0].at.x() == 1.0);
    CHECK(inputs[2].kind == Input::Kind::press);
    for (std::size_t i = 3; i < 1000; ++i) REQUIRE(inputs[i].at.x() == 1.0 * i);
    CHECK(inputs[1000].kind == Input::Kind::release);
    CHECK(queue.empty());
}

TEST_CASE("input: text says which letter is on its key") {
    InputMaker maker([] { return PixelScale{}; });
    maker.key(Key::character, U'W', true, {});
    maker.text(U'ц');
    maker.key(Key::character, U'W', false, {});
    maker.key(Key::none, 0, true, {});
    maker.text(U'-');
    const std::vector<Input> inputs = maker.queue().take();
    REQUIRE(inputs.size() == 4);
    CHECK(inputs[1].letter == U'W');
    CHECK(inputs[1].character == U'ц');
    CHECK(inputs[3].letter == 0);
}
