// Pickers for parameters that are meshes and parts of them.
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"
#include "tests/unit/viewer/window/panel/panel_frames.h"
#include "viewer/render/gl/platform.h"
#include "viewer/window/panel/boundary_pick.h"

using namespace lissom;
using namespace lissom::window;
using test::kWindow;
using test::PanelFrames;

namespace {

using lua::ParameterType;
using Names = std::vector<std::string>;

// Moves a tube beside a head.
const Affine kBeside{Mat3::Identity(), {3.0, 0.0, 0.0}};

// A tube, a head and a mesh that the scene has no name for.
Shown shown_meshes() {
    Picture picture;
    picture.meshes.push_back(
        {std::make_shared<const Mesh>(make_cylinder({.caps = false})), {}, kBeside});
    picture.meshes.push_back({std::make_shared<const Mesh>(make_head())});
    picture.meshes.push_back({std::make_shared<const Mesh>(make_bar())});
    Shown shown;
    shown.names = {"tube", "anna", "mesh 3"};
    shown.picture = std::make_shared<const Picture>(std::move(picture));
    return shown;
}

ToolState scene() {
    ToolState state;
    state.objects = {{"tube", "tube"}, {"anna", "anna"}, {"stroke", "stroke", true, true}};
    return state;
}

lua::ScriptParameter parameter(const char* name, ParameterType type, const char* of = "") {
    lua::ScriptParameter p;
    p.name = name;
    p.type = type;
    p.of = of;
    return p;
}

std::vector<lua::ScriptParameter> parameters() {
    std::vector<lua::ScriptParameter> list{parameter("on", ParameterType::mesh),
                                           parameter("edge", ParameterType::boundary, "on")};
    list[0].default_value = list[0].value = "tube";
    return list;
}

bool holds(const Names& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// A panel with the parameters, beside a picture that is seen from the front.
struct PickerFrames : PanelFrames {
    PickerFrames() {
        const Shown shown = shown_meshes();
        content.picks = pick_choices_of(shown, scene());
        content.parameters = parameters();
        const Canvas canvas = panel.canvas(kWindow);
        content.picture_size = {1.0 * canvas.width, 1.0 * canvas.height};
        std::vector<Vec3> points;
        for (const Vec3& p : shown.picture->meshes[0].mesh->positions()) {
            points.push_back(kBeside(p));
        }
        content.camera = frame_points(StandardView::front, points);
        make();
    }
    // In the window, the first point of a boundary of the tube.
    Vec2 place_of(std::size_t loop) const {
        const Vec3 at = content.picks.meshes[0].boundaries[loop].points[0];
        const Canvas canvas = panel.canvas(kWindow);
        return content.camera.project(at, content.picture_size).head<2>() +
               Vec2(canvas.x, canvas.y);
    }
    // Presses along a row from its right end until `done`.
    template <typename Done>
    void press_along(double y, const Done& done) {
        for (double x = panel.canvas(kWindow).x - 12.0; x > 20.0 && !done(); x -= 8.0)
            click({x, y});
    }
    Names value(std::size_t place) const {
        const auto& given = content.parameters[place].value;
        return given ? Names{std::get<std::string>(*given)} : Names{};
    }
};

}  // namespace

TEST_CASE("pickers: a mesh, a head and a curve are picked among the named objects of the scene") {
    const PickChoices choices = pick_choices_of(shown_meshes(), scene());
    const auto picks = [&](ParameterType type) {
        return picks_for(parameter("p", type), {}, choices);
    };
    CHECK(picks(ParameterType::mesh) == Names{"tube", "anna"});
    CHECK(picks(ParameterType::head) == Names{"anna"});
    CHECK(picks(ParameterType::curve) == Names{"stroke"});
    for (const auto type : {ParameterType::mesh, ParameterType::region, ParameterType::boundary,
                            ParameterType::curve, ParameterType::head}) {
        CHECK(is_picked(type));
    }
    for (const auto type : {ParameterType::number, ParameterType::string, ParameterType::file}) {
        CHECK_FALSE(is_picked(type));
    }
}

TEST_CASE("pickers: a region and a boundary are picked on the mesh that the parameter lies on") {
    const PickChoices choices = pick_choices_of(shown_meshes(), scene());
    auto all = parameters();
    const auto region = parameter("part", ParameterType::region, "on");
    CHECK(picks_for(region, all, choices) == Names{"bottom", "top"});
    CHECK(picks_for(all[1], all, choices) == Names{"1", "2"});
    all[0].value = "anna";
    CHECK(holds(picks_for(region, all, choices), "scalp"));
    CHECK_FALSE(holds(picks_for(region, all, choices), "top"));
    // A file, of which nothing is known: all that is seen.
    all[0].value = "anna.obj";
    CHECK(holds(picks_for(region, all, choices), "scalp"));
    CHECK(holds(picks_for(region, all, choices), "top"));
}

TEST_CASE("pickers: a loop is found near a pixel of it, and none far from all") {
    const Shown shown = shown_meshes();
    const PickChoices choices = pick_choices_of(shown, scene());
    const auto& own = choices.meshes[0].boundaries;
    REQUIRE(own.size() == 2);
    const PictureSize size{400.0, 300.0};
    const Camera camera = frame_points(StandardView::front, own[1].points);
    const Vec2 on = camera.project(own[1].points[3], size).head<2>();
    CHECK(loop_near({&own[0], &own[1]}, camera, size, on + Vec2(2.0, 2.0), 10.0) == &own[1]);
    CHECK(loop_near({&own[0], &own[1]}, camera, size, on + Vec2(0.0, 120.0), 10.0) == nullptr);
    CHECK(loop_near({}, camera, size, on, 10.0) == nullptr);
}

TEST_CASE("panel: a boundary is picked by a click in the picture, and Escape takes the pick back") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PickerFrames frames;
    const double low = frames.click_a_field(40.0);
    frames.press(Key::escape);
    const Picking own{false, "edge"};
    const auto arm = [&] {
        frames.press_along(low, [&] { return frames.content.picking == own; });
    };
    arm();
    REQUIRE(frames.content.picking == own);
    frames.press(Key::escape);
    CHECK_FALSE(frames.content.picking);
    frames.click(frames.place_of(1));
    CHECK(frames.changes == 0);
    arm();
    REQUIRE(frames.content.picking == own);
    // Far from every boundary.
    frames.click({kWindow.width - 3.0, 3.0});
    CHECK(frames.content.picking == own);
    CHECK(frames.changes == 0);
    for (const std::size_t loop : {std::size_t{1}, std::size_t{0}}) {
        arm();
        frames.click(frames.place_of(loop));
        CHECK(frames.value(1) == Names{std::to_string(loop + 1)});
        CHECK_FALSE(frames.content.picking);
    }
    CHECK(frames.changes == 2);
}

TEST_CASE("panel: the list of a picker gives a value, and a name can be typed") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PickerFrames frames;
    frames.content.parameters = {parameter("who", ParameterType::head)};
    const double low = frames.click_a_field(40.0);
    REQUIRE(frames.panel.wants_keys());
    frames.type("anna.obj");
    frames.press(Key::enter);
    CHECK(frames.value(0) == Names{"anna.obj"});
    CHECK(frames.changes == 1);
    // The arrow at the end of the row opens the list below it.
    for (double y = low + 12.0; y < low + 60.0 && frames.changes == 1; y += 6.0) {
        frames.click({frames.panel.canvas(kWindow).x - 24.0, low});
        frames.click({frames.panel.canvas(kWindow).x - 24.0, y});
    }
    CHECK(frames.value(0) == Names{"anna"});
    CHECK(frames.changes == 2);
}

TEST_CASE("panel: a pick ends if its parameter goes") {
    const auto platform = test::make_platform();
    if (!platform) return;
    const PlatformScope scope(*platform);
    PickerFrames frames;
    frames.content.picking = Picking{true, "edge"};
    frames.make();
    CHECK_FALSE(frames.content.picking);
}
