// When events of a recording are due, and how a picture of another size shows what was recorded.
#include "viewer/window/session/player.h"

#include <doctest/doctest.h>

using namespace lissom;
using namespace lissom::window;

TEST_CASE("player: events are due at their times, faster or slower as asked") {
    Player player({0.0, 0.05, 0.05, 0.2, 1.0}, 1.0);
    CHECK(player.advance(0.0) == 1);
    CHECK(player.wait() == doctest::Approx(0.05));
    CHECK(player.advance(0.05) == 3);
    player.change_speed(2.0);
    CHECK(player.wait() == doctest::Approx(0.075));
    CHECK(player.advance(0.076) == 4);
    player.change_speed(0.25);
    CHECK(player.speed() == 0.5);
    for (int i = 0; i < 15; ++i) CHECK(player.advance(0.1) == 4);
    CHECK(player.advance(0.1) == 5);
    CHECK(player.wait() > 1e6);
    for (int i = 0; i < 30; ++i) player.change_speed(2.0);
    CHECK(player.speed() == 64.0);
}

TEST_CASE("player: whoever is slow gets a tenth of a second at once, not all that is late") {
    Player player({0.0, 0.09, 0.11, 5.0}, 1.0);
    CHECK(player.advance(60.0) == 2);
    CHECK(player.advance(60.0) == 3);
}

TEST_CASE("player: while it pauses nothing is due but single steps") {
    Player player({0.0, 0.5, 0.6}, 1.0);
    player.advance(0.0);
    player.pause_or_go_on();
    CHECK(player.advance(0.1) == 1);
    CHECK(player.wait() > 1e6);
    player.step();
    CHECK(player.is_paused());
    CHECK(player.advance(0.1) == 2);
    player.pause_or_go_on();
    // Time goes on from the event that was stepped to.
    CHECK(player.advance(0.05) == 2);
    CHECK(player.advance(0.06) == 3);
    player.step();
    CHECK(player.advance(0.1) == 3);
}

TEST_CASE(
    "player: a recorded picture lies in the middle of another, and points where they were seen") {
    const PictureSize recorded{640.0, 480.0};
    const Vec3 point(0.3, -0.4, 0.2);
    for (const bool ortho : {false, true}) {
        const Camera camera(
            {.eye = {1.0, 2.0, 5.0}, .ortho = ortho ? std::optional<double>(3.0) : std::nullopt});
        for (const PictureSize now : {PictureSize{640.0, 480.0}, PictureSize{1000.0, 480.0},
                                      PictureSize{320.0, 900.0}, PictureSize{1280.0, 960.0}}) {
            const Vec2 then = camera.project(point, recorded).head<2>();
            const Vec2 seen = fitted(camera, recorded, now).project(point, now).head<2>();
            CHECK((PictureFit(recorded, now)(then) - seen).norm() < 1e-9 * now.height);
        }
    }
}
