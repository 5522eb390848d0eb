#include "viewer/window/makers/painter.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/bindings/cli/program_run.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/lua/png_file.h"

using namespace lissom;
using namespace lissom::window;
using test::shared;

namespace {

std::shared_ptr<const Picture> picture_of(double scale) {
    auto picture = std::make_shared<Picture>();
    DrawnMesh ball{shared(make_sphere())};
    ball.transform.linear *= scale;
    picture->meshes = {ball};
    picture->camera = test::front_camera(4.0);
    picture->options = test::small_options();
    return picture;
}

// Waits until the painter has something.
Painter::Result painted_by(Painter& painter) {
    for (int i = 0; i < 6000; ++i) {
        if (auto result = painter.take()) return std::move(*result);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("nothing was painted");
    return {};
}

void wait_idle(const Painter& painter) {
    for (int i = 0; i < 6000 && painter.busy(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    REQUIRE_FALSE(painter.busy());
}

}  // namespace

TEST_CASE("painter: its picture is that of a renderer, to the pixel, also in a file") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const test::ProgramFolder folder;
    std::atomic<int> told{0};
    Painter painter(2, [&] { ++told; });
    painter.draw(picture_of(1.0), 3, folder.path("ball.png"));
    const Painter::Result result = painted_by(painter);
    CHECK(result.number == 3);
    CHECK(result.error.empty());
    CHECK(result.image == draw_picture(*renderer, *picture_of(1.0)));
    CHECK(load_picture(folder.path("ball.png")) == result.image);
    CHECK_FALSE(painter.take());
    wait_idle(painter);
    CHECK(told == 1);
}

TEST_CASE("painter: of many that follow each other the last is painted, what is stopped is not") {
    if (!test::make_renderer()) return;
    Painter painter(2, [] {});
    for (std::uint64_t i = 1; i <= 30; ++i)
        painter.draw(picture_of(1.0 / static_cast<double>(i)), i);
    std::uint64_t last = 0;
    while (last < 30) {
        const std::uint64_t number = painted_by(painter).number;
        CHECK(number > last);
        last = number;
    }
    wait_idle(painter);
    painter.draw(picture_of(1.0), 31);
    painter.stop();
    wait_idle(painter);
    const auto late = painter.take();
    CHECK((!late || late->error.empty()));
}

TEST_CASE("painter: a picture that fails is told, and the next is painted") {
    if (!test::make_renderer()) return;
    Painter painter(1, [] {});
    painter.draw(picture_of(1.0), 1, "/no such folder/ball.png");
    CHECK(painted_by(painter).error.find("no such folder") != std::string::npos);
    auto wrong = std::make_shared<Picture>(*picture_of(1.0));
    wrong->meshes[0].style.values = {1.0, 2.0};
    painter.draw(wrong, 2);
    const Painter::Result refused = painted_by(painter);
    CHECK(refused.number == 2);
    CHECK(refused.error.find("2 values") != std::string::npos);
    painter.draw(picture_of(1.0), 3);
    CHECK(painted_by(painter).error.empty());
}
