// What the panel draws again: nothing where nothing has changed, and what lies over the picture by
// itself.
#include "viewer/window/panel/panel.h"

#include "tests/unit/viewer/viewer_support.h"
#include "tests/unit/viewer/window/panel/panel_frames.h"
#include "viewer/render/gl/platform.h"
#include "viewer/render/scene_drawer.h"

using namespace lissom;
using namespace lissom::window;
using test::kWindow;
using test::PanelFrames;

namespace {

// One number of 0 to 100, in whose field the hand types from now on.
struct TypedFrames : PanelFrames {
    TypedFrames() {
        lua::ScriptParameter size;
        size.name = "size";
        size.type = lua::ParameterType::number;
        size.min = 0.0;
        size.max = 100.0;
        size.default_value = 5.0;
        content.parameters = {size};
        click_a_field(140.0, true);
    }
    double value() const { return std::get<double>(content.parameters[0].value.value()); }
};

void add_outline(PanelContent& content, double to) {
    content.tool.marks.outlines = {{{Vec2(10.0, 10.0), Vec2(to, 60.0)}, false, kWhite}};
}

}  // namespace

TEST_CASE(
    "panel: a frame like the one before differs in nothing, also while the hand moves over "
    "the picture") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PanelFrames frames;
    CHECK_FALSE(frames.differs());
    for (int i = 0; i < 20; ++i) {
        frames.feed(Input::Kind::move, {400.0 + i, 200.0});
        CHECK_FALSE(frames.differs());
    }
}

TEST_CASE("panel: what changes in it, or under the hand, is beside the picture") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PanelFrames frames;
    frames.content.lines.push_back({LineKind::error, "another line"});
    frames.make();
    CHECK(frames.panel.lists().beside_differs());
    CHECK_FALSE(frames.panel.lists().over_differs());
    frames.settle();
    CHECK_FALSE(frames.differs());
    // A button is lit.
    frames.feed(Input::Kind::move, {40.0, 20.0});
    CHECK(frames.differs());
    frames.settle();
    frames.settings.dark = false;
    CHECK(frames.differs());
}

TEST_CASE("panel: what a tool draws lies over the picture, and can be drawn alone") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PanelFrames frames;
    frames.content.picture_size = {410.0, 362.0};
    add_outline(frames.content, 100.0);
    frames.make();
    CHECK(frames.panel.lists().over_differs());
    CHECK_FALSE(frames.panel.lists().beside_differs());
    CHECK_FALSE(frames.differs());
    add_outline(frames.content, 101.0);
    frames.make();
    CHECK(frames.panel.lists().over_differs());
    CHECK_FALSE(frames.panel.lists().beside_differs());

    const auto drawn = [&](PanelPart part) {
        const gl::Framebuffer target = gl::Framebuffer::texture(kWindow, GL_RGBA8, false);
        target.bind();
        glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
        glClear(GL_COLOR_BUFFER_BIT);
        frames.panel.draw(part);
        return read_pixels(target);
    };
    const Image all = drawn(PanelPart::all), over = drawn(PanelPart::over_picture);
    const Canvas canvas = frames.panel.canvas(kWindow);
    const auto picture = [&](const Image& image) {
        // Rows count from the bottom.
        return test::crop(image, canvas.x, kWindow.height - canvas.height, canvas.width,
                          canvas.height);
    };
    CHECK(test::difference(picture(all), picture(over)) == 0);
    const auto bright = [](const Image& image) {
        int count = 0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i] > 20;
        return count;
    };
    CHECK(bright(picture(over)) > 50);
    CHECK(bright(over) == bright(picture(over)));
    CHECK(bright(all) > 10 * bright(over));
}

TEST_CASE("panel: what is typed for a number holds when it is entered, not with every key") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    TypedFrames frames;
    REQUIRE(frames.panel.wants_keys());
    frames.type("7");
    frames.type("5");
    CHECK(frames.value() == 5.0);
    CHECK(frames.changes == 0);
    frames.press(Key::enter);
    CHECK(frames.value() == 75.0);
    CHECK(frames.changes == 1);
    CHECK_FALSE(frames.panel.wants_keys());
}

TEST_CASE("panel: what is typed for a number holds when the field is left, Escape takes it back") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    {
        TypedFrames frames;
        REQUIRE(frames.panel.wants_keys());
        frames.type("40");
        frames.click({400.0, 200.0});
        CHECK(frames.value() == 40.0);
        CHECK(frames.changes == 1);
    }
    TypedFrames frames;
    REQUIRE(frames.panel.wants_keys());
    frames.type("40");
    frames.press(Key::escape);
    CHECK(frames.value() == 5.0);
    frames.click({400.0, 200.0});
    CHECK(frames.value() == 5.0);
    CHECK(frames.changes == 0);
}

TEST_CASE("panel: keys over the picture move nothing in the panel") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    TypedFrames frames;
    frames.press(Key::enter);
    frames.feed(Input::Kind::move, {400.0, 200.0});
    frames.settle();
    for (const Key key : {Key::home, Key::space, Key::down, Key::enter}) {
        frames.press(key);
        CHECK_FALSE(frames.panel.wants_keys());
    }
    CHECK(frames.changes == 0);
    CHECK(frames.pressed == 0);
}

TEST_CASE("panel: Ctrl-Z in the console takes back what is typed, and not what was entered") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PanelFrames frames;
    frames.click({frames.panel.canvas(kWindow).x + 60.0, kWindow.height - 16.0});
    REQUIRE(frames.panel.wants_keys());
    const auto enter = [&](const std::string& text) {
        frames.type(text);
        frames.press(Key::enter);
    };
    enter("1+1");
    for (int i = 0; i < 5; ++i) frames.take_back();
    enter("a longer line");
    frames.type("another long line");
    frames.press(Key::up);
    frames.press(Key::up);
    for (int i = 0; i < 30; ++i) frames.take_back();
    frames.press(Key::enter);
    frames.type("ab");
    for (int i = 0; i < 30; ++i) frames.take_back();
    enter("c");
    CHECK(frames.entered == std::vector<std::string>{"1+1", "a longer line", "1+1", "c"});
}

TEST_CASE("panel: a preset is saved beside the scene's own button, under a name that is one") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PanelFrames frames;
    frames.content.tool.has_scene = true;
    frames.content.presets.emplace();
    lua::ScriptParameter tall;
    tall.name = "tall";
    tall.type = lua::ParameterType::boolean;
    tall.default_value = false;
    frames.content.parameters = {tall};
    // The lowest is that of the export.
    const double lowest = frames.click_a_field(40.0);
    frames.press(Key::escape);
    REQUIRE(!frames.panel.wants_keys());
    const double y = frames.click_a_field(40.0, false, lowest - 14.0);
    REQUIRE(frames.panel.wants_keys());
    const auto click_along = [&] {
        const double right = frames.panel.canvas(kWindow).x;
        for (double x = 0.5 * right; x < right && frames.saved_presets.empty(); x += 8.0) {
            frames.click({x, y});
        }
    };
    frames.type("  ");
    click_along();
    CHECK(frames.saved_presets.empty());
    frames.click({40.0, y});
    frames.type("tall##x");
    click_along();
    REQUIRE(frames.saved_presets.size() == 1);
    CHECK(frames.saved_presets[0].ends_with("tall##x"));
    CHECK(frames.saved == 0);
}

TEST_CASE("panel: the name of an export is written beside the button that asks for it") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PanelFrames frames;
    frames.content.tool.has_scene = true;
    const double y = frames.click_a_field(40.0);
    REQUIRE(frames.panel.wants_keys());
    frames.type("cup.glb");
    CHECK(frames.content.export_name == "cup.glb");
    CHECK(frames.exports == 0);
    frames.click({frames.panel.canvas(kWindow).x - 30.0, y});
    CHECK(frames.exports == 1);
    CHECK(frames.saved == 0);
}
