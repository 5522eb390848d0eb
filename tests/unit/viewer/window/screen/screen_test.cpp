#include "viewer/window/screen/screen.h"

#include <epoxy/gl.h>

#include <memory>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/gl/platform.h"
#include "viewer/window/screen/display.h"

using namespace lissom;
using namespace lissom::window;

namespace {

// Buffers on the card, by the names that drivers give first.
int buffers_alive() {
    int count = 0;
    for (GLuint name = 1; name < 4096; ++name) count += glIsBuffer(name);
    return count;
}

}  // namespace

TEST_CASE("screen: a camera that moves sends nothing, a mesh that moves its vertices alone") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    Picture picture;
    // Quads: their diagonals would change with the shape.
    picture.meshes = {{std::make_shared<const Mesh>(make_sphere())}};
    CHECK(screen.update(quick_snapshot(picture, {})).colors > 0);
    screen.draw(test::front_camera(4.0), {0, 0, 80, 60}, kWhite, 1);
    CHECK(screen.update(quick_snapshot(picture, {})).bytes() == 0);
    for (const double factor : {1.2, 1.4}) {
        Mesh moved = *picture.meshes[0].mesh;
        for (Vec3& p : moved.edit_positions()) p.x() *= factor;
        picture.meshes[0].mesh = std::make_shared<const Mesh>(moved);
        const Uploads uploads = screen.update(quick_snapshot(picture, {}));
        CHECK(uploads.vertices > 0);
        CHECK(uploads.bytes() == uploads.vertices);
    }
}

TEST_CASE("screen: the legend takes the columns that it takes of a finished picture") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    const Canvas canvas{290, 0, 900, 600};
    CHECK(screen.beside_legend(canvas) == canvas);
    const Legend legend{{0.0, 2.0}, "stretch"};
    screen.set_legend(legend, canvas.height, kWhite);
    const Canvas beside = screen.beside_legend(canvas);
    CHECK(beside.x == canvas.x);
    CHECK(beside.width == canvas.width - legend_width(legend, canvas.height));
    CHECK(screen.beside_legend({0, 0, 20, 600}).width == 1);
    screen.set_legend(std::nullopt, canvas.height, kWhite);
    CHECK(screen.beside_legend(canvas) == canvas);
}

TEST_CASE(
    "screen: while it moves, too, lines are seen through meshes that are to be seen through") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    Picture picture;
    picture.meshes = {{std::make_shared<const Mesh>(test::make_square())}};
    picture.marks.lines = {{{Vec3(-0.9, 0, -0.5), Vec3(0.9, 0, -0.5)}, false, {0, 0, 1}, 12.0}};
    const auto blue = [&](bool through) {
        DisplaySettings settings;
        settings.see_through = through;
        screen.update(quick_snapshot(picture, settings));
        screen.draw(test::front_camera(2.4), {0, 0, 96, 96}, kWhite, 1);
        const Image image = screen.picture();
        int count = 0;
        for (int y = 44; y < 52; ++y) {
            for (int x = 20; x < 76; ++x) {
                const Color color = image.color(x, y);
                count += color.b > color.r + 0.3;
            }
        }
        return count;
    };
    CHECK(blue(false) == 0);
    CHECK(blue(true) == doctest::Approx(0.5 * 8 * 56).epsilon(0.05));
}

TEST_CASE("screen: an orbit and a drag make no buffers, and a screen frees what it has made") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    const int before = buffers_alive();
    auto screen = std::make_unique<Screen>();
    Picture picture;
    picture.meshes = {{std::make_shared<const Mesh>(make_sphere())}};
    const auto drawn = [&](double distance, int width) {
        screen->update(quick_snapshot(picture, {}));
        screen->draw(test::front_camera(distance), {0, 0, width, 60}, kWhite, 1);
        return buffers_alive();
    };
    const int alive = drawn(4.0, 80);
    CHECK(alive > before);
    CHECK(drawn(5.0, 80) == alive);
    Mesh moved = *picture.meshes[0].mesh;
    for (Vec3& p : moved.edit_positions()) p.x() *= 1.2;
    picture.meshes[0].mesh = std::make_shared<const Mesh>(std::move(moved));
    CHECK(drawn(5.0, 80) == alive);
    CHECK(drawn(5.0, 120) == alive);
    screen.reset();
    CHECK(buffers_alive() == before);
}

TEST_CASE("screen: a hidden mesh is left out of the picture, and nothing is sent for it") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Screen screen;
    Picture picture;
    Mesh beside = make_sphere();
    for (Vec3& p : beside.edit_positions()) p.x() += 1.5;
    picture.meshes = {{std::make_shared<const Mesh>(make_sphere())},
                      {std::make_shared<const Mesh>(std::move(beside))}};
    const auto drawn = [&](const DisplaySettings& settings, bool sends) {
        CHECK((screen.update(quick_snapshot(picture, settings)).bytes() > 0) == sends);
        screen.draw(test::front_camera(6.0), {0, 0, 80, 60}, kWhite, 1);
        return screen.picture();
    };
    const Image both = drawn({}, true);
    const Image one = drawn({.hidden = {false, true}}, false);
    CHECK(test::difference(both, one) > 50);
    picture.meshes.pop_back();
    CHECK(drawn({}, false) == one);
}
