// The same window on a usual screen and on one of high density, which has twice the pixels: the
// hand finds the same, the panel's letters are as large, and the picture has all the pixels.
#include <array>
#include <optional>

#include "kernel/mesh/shapes/shapes.h"
#include "kernel/sketch/picking.h"
#include "tests/unit/viewer/viewer_support.h"
#include "viewer/render/gl/platform.h"
#include "viewer/window/panel/panel.h"
#include "viewer/window/screen/display.h"
#include "viewer/window/screen/screen.h"
#include "viewer/window/tools/tool_input.h"

using namespace lissom;
using namespace lissom::window;

namespace {

constexpr gl::Extent kWindowUnits{760, 500};

// A window as a desktop tells of it: `density` pixels in a unit, letters `content` times as large.
PixelScale scale_of(int density, double content) {
    return {kWindowUnits, {density * kWindowUnits.width, density * kWindowUnits.height}, content};
}
// Of a desktop whose units are pixels everywhere, with a window twice as large.
PixelScale scale_of_pixels() {
    const gl::Extent twice{2 * kWindowUnits.width, 2 * kWindowUnits.height};
    return {twice, twice, 2.0};
}

// What lies between the desktop and what is drawn, without a desktop.
struct MockWindow {
    explicit MockWindow(const PixelScale& of)
        : scale(of), inputs([of] { return of; }), panel({of.panel()}) {}

    const gl::Extent& size() const { return scale.framebuffer; }
    Canvas canvas() const { return panel.canvas(size()); }
    // What a tool hears of a press under this cursor; nothing where it is the panel's.
    std::optional<ToolInput> press(const Vec2& cursor) {
        inputs.move(cursor);
        inputs.button(MouseButton::left, true, {});
        const std::vector<Input> taken = inputs.queue().take();
        REQUIRE(taken.size() == 2);
        const Input& input = taken.back();
        if (panel.wants_mouse(input.at, size())) return std::nullopt;
        const ToolPixels pixels{scale.panel()};
        const Canvas seen = canvas();
        ToolInput made;
        made.at = pixels.at(input.at - Vec2(seen.x, seen.y));
        made.size = pixels.size({1.0 * seen.width, 1.0 * seen.height});
        return made;
    }
    // The panel at rest, as it lies in the window.
    Image draw_panel() {
        PanelContent content;
        content.objects = {"armadillo  (86482 faces)", "a name"};
        content.lines = {{LineKind::message, "Drop meshes here."}, {LineKind::error, "It failed."}};
        DisplaySettings settings;
        for (int i = 0; i < 3; ++i) panel.make(content, settings, size(), 0.02);
        const gl::Framebuffer target = gl::Framebuffer::texture(size(), GL_RGBA8, false);
        target.bind();
        glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        panel.draw(PanelPart::all);
        return read_pixels(target);
    }

    PixelScale scale;
    InputMaker inputs;
    Panel panel;
};

Camera density_camera() {
    return Camera({.eye = {0.5, 0.8, 4.0}});
}

// The vertex of a mesh that is picked where a tool heard of a press.
Index vertex_under(const SpatialTree& tree, const ToolInput& input, PickKind kind) {
    PickScene scene;
    scene.add(tree);
    const View view{density_camera(), {1.0 * input.size.width, 1.0 * input.size.height}};
    const auto hit = pick(scene, view, input.at, {.kinds = {kind}});
    return hit ? hit->vertex : kNoIndex;
}

// The mean of each block of 2 x 2 pixels.
Image halved(const Image& image) {
    Image half(image.width / 2, image.height / 2);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            for (int k = 0; k < 4; ++k) {
                int sum = 0;
                for (int i = 0; i < 4; ++i) sum += image.pixel(2 * x + i % 2, 2 * y + i / 2)[k];
                half.pixel(x, y)[k] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return half;
}

// Pixels that are brighter than any of the panel's surfaces: its letters.
double letters(const Image& image) {
    double count = 0.0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i + 1] > 140;
    return count;
}

double mean_apart(const Image& a, const Image& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        sum += std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    }
    return sum / static_cast<double>(a.rgba.size());
}

}  // namespace

TEST_CASE("high density: cursors become pixels, whatever a desktop's units are") {
    CHECK(scale_of(1, 1.0).pixels({10.5, 20.0}) == Vec2(10.5, 20.0));
    CHECK(scale_of(2, 2.0).pixels({10.5, 20.0}) == Vec2(21.0, 40.0));
    CHECK(scale_of_pixels().pixels({10.5, 20.0}) == Vec2(10.5, 20.0));
    CHECK(PixelScale{{100, 100}, {150, 150}, 1.5}.pixels({10.0, 20.0}) == Vec2(15.0, 30.0));
    // An icon, and a desktop that wants small letters.
    CHECK(PixelScale{{0, 0}, {0, 0}, 0.5}.pixels({10.0, 20.0}) == Vec2(0.0, 0.0));
    CHECK(PixelScale{{0, 0}, {0, 0}, 0.5}.panel() == 1.0);
}

TEST_CASE("high density: a hand at the same place of the window picks the same vertex") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    const Mesh mesh = make_sphere();
    const SpatialTree tree(mesh);
    const auto all = [&](const PixelScale& scale, double units) {
        MockWindow window(scale);
        std::vector<Index> found;
        for (double y = 5.0; y < kWindowUnits.height; y += 19.0) {
            for (double x = 5.0; x < kWindowUnits.width; x += 23.0) {
                const auto input = window.press(units * Vec2(x, y));
                for (const PickKind kind : {PickKind::vertex, PickKind::face}) {
                    found.push_back(input ? vertex_under(tree, *input, kind) : -2);
                }
            }
        }
        return found;
    };
    const std::vector<Index> usual = all(scale_of(1, 1.0), 1.0);
    CHECK(std::count(usual.begin(), usual.end(), -2) > 100);
    CHECK(std::count(usual.begin(), usual.end(), kNoIndex) > 100);
    CHECK(std::count_if(usual.begin(), usual.end(), [](Index v) { return v >= 0; }) > 100);
    CHECK(all(scale_of(2, 2.0), 1.0) == usual);
    CHECK(all(scale_of_pixels(), 2.0) == usual);
}

TEST_CASE("high density: the panel is as large, and its letters have the pixels of the screen") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Image usual, dense;
    Canvas canvas, dense_canvas;
    {
        MockWindow window(scale_of(1, 1.0));
        usual = window.draw_panel();
        canvas = window.canvas();
    }
    {
        MockWindow window(scale_of(2, 2.0));
        dense = window.draw_panel();
        dense_canvas = window.canvas();
    }
    CHECK(dense_canvas == Canvas{2 * canvas.x, 0, 2 * canvas.width, 2 * canvas.height});
    CHECK(letters(usual) > 1000);
    CHECK(letters(dense) == doctest::Approx(4.0 * letters(usual)).epsilon(0.15));
    // The same picture, but sharper: not each pixel four times.
    const Image half = halved(dense);
    CHECK(mean_apart(half, usual) < 4.0);
    double equal = 0.0, blocks = 0.0;
    for (int y = 0; y + 1 < dense.height; y += 2) {
        for (int x = 0; x + 1 < dense.width; x += 2) {
            const bool letter = dense.pixel(x, y)[1] > 140;
            blocks += letter;
            equal += letter && dense.pixel(x + 1, y)[1] == dense.pixel(x, y)[1] &&
                     dense.pixel(x, y + 1)[1] == dense.pixel(x, y)[1];
        }
    }
    CHECK(equal < 0.7 * blocks);
}

TEST_CASE("high density: the picture has the pixels of the screen, and shows the same") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    Picture picture;
    picture.meshes = {{std::make_shared<const Mesh>(make_sphere())}};
    picture.meshes[0].style.wire = true;
    picture.tool_marks.points = {{Vec3(0.0, 0.0, 1.0)}};
    const auto seen = [&](const PixelScale& scale, int coarseness) {
        const MockWindow window(scale);
        DisplaySettings settings;
        settings.scale = scale.panel();
        Screen screen;
        screen.update(quick_snapshot(picture, settings));
        screen.draw(density_camera(), window.canvas(), kWhite, coarseness);
        return screen.picture();
    };
    const Image usual = seen(scale_of(1, 1.0), 1), dense = seen(scale_of(2, 2.0), 1);
    CHECK(dense.width == 2 * usual.width);
    CHECK(dense.height == 2 * usual.height);
    // To the byte where half the pixels are drawn; nearly where all are.
    CHECK(seen(scale_of(2, 2.0), 2).rgba == usual.rgba);
    CHECK(mean_apart(halved(dense), usual) < 2.0);
}
