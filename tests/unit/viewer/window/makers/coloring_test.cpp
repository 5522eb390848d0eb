#include "viewer/window/makers/coloring.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "viewer/window/makers/colorer.h"

using namespace lissom;
using namespace lissom::window;
using By = Coloring::By;

namespace {

Mesh plain_box() {
    Mesh box = make_box();
    while (!box.regions().empty()) box.remove_region(std::string(box.regions().begin()->first));
    return box;
}

Mesh box_with_values() {
    Mesh box = plain_box();
    box.attributes().add({"heat", Domain::vertex, 1, ScalarType::float32, {}}).values = {
        0, 1, 2, 3, 4, 5, 6, 7};
    box.attributes().add({"uv", Domain::vertex, 2, ScalarType::float32, {}}).values.assign(16, 0.0);
    box.attributes().add({"side", Domain::face, 1, ScalarType::float32, {}}).values.assign(6, 1.0);
    box.set_region("top", Region(box.shared_topology(), {0, 1, 2, 3}));
    box.set_region("all", Region::all(box.shared_topology()));
    return box;
}

Picture picture_of(std::vector<Mesh> meshes) {
    Picture picture;
    for (Mesh& mesh : meshes) {
        picture.meshes.push_back({std::make_shared<const Mesh>(std::move(mesh))});
    }
    return picture;
}

bool has(const std::vector<Coloring>& list, const Coloring& one) {
    return std::find(list.begin(), list.end(), one) != list.end();
}

Shown shown_of(const Picture& picture, std::uint64_t number) {
    Shown shown;
    shown.picture = std::make_shared<const Picture>(picture);
    shown.number = number;
    return shown;
}

// What the colorer has made last, once it rests.
std::optional<Colored> last_of(Colorer& colorer) {
    for (int i = 0; i < 10000 && colorer.busy(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK_FALSE(colorer.busy());
    return colorer.take();
}

}  // namespace

TEST_CASE("coloring: what can be drawn is offered, and nothing else") {
    const auto choices = colorings_of(picture_of({box_with_values()}));
    CHECK(choices.front() == Coloring{});
    CHECK(has(choices, {By::regions}));
    CHECK(has(choices, {By::values, "heat"}));
    CHECK_FALSE(has(choices, {By::values, "uv"}));
    CHECK_FALSE(has(choices, {By::values, "side"}));
    CHECK(has(choices, {By::stretch}));
    CHECK_FALSE(has(colorings_of(picture_of({plain_box()})), {By::regions}));
    CHECK(colorings_of(Picture()).size() == 1);
}

TEST_CASE(
    "coloring: an attribute is drawn with its range, instead of what a script has asked for") {
    Picture picture = picture_of({box_with_values(), make_box()});
    picture.range = ValueRange{-9.0, 9.0};
    picture.legend = false;
    picture.meshes[1].style.values.assign(8, 3.0);
    picture.meshes[0].style.region = *picture.meshes[0].mesh->find_region("top");
    const Picture result = colored(picture, {By::values, "heat"}, {});
    CHECK(result.meshes[0].style.values[7] == 7.0);
    CHECK_FALSE(result.meshes[0].style.region);
    CHECK(result.meshes[1].style.values.empty());
    const auto legend = legend_of(result);
    REQUIRE(legend);
    CHECK(legend->label == "heat");
    CHECK(legend->range == ValueRange{0.0, 7.0});
    CHECK(colored(picture, {}, {}).range == picture.range);
}

TEST_CASE("coloring: regions of one name have one colour, small ones over large ones") {
    Mesh other = plain_box();
    other.set_region("top", Region(other.shared_topology(), {4}));
    const Picture result = colored(picture_of({box_with_values(), other}), {By::regions}, {});
    const auto& parts = result.meshes[0].style.parts;
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].region.size() == 8);
    REQUIRE(result.legend_parts.size() == 2);
    CHECK(result.legend_parts[1].name == "top");
    CHECK(result.legend_parts[1].color == parts[1].color);
    REQUIRE(result.meshes[1].style.parts.size() == 1);
    CHECK(result.meshes[1].style.parts[0].color == parts[1].color);
    CHECK_FALSE(parts[0].color == parts[1].color);
    CHECK(legend_of(result)->parts == result.legend_parts);
}

TEST_CASE("coloring: the field of hairstyles is shown where there is one") {
    Picture picture = picture_of({box_with_values()});
    CHECK_FALSE(has(colorings_of(picture), {By::field}));
    picture.meshes[0].style.color = {1.0, 0.0, 0.0};
    picture.marks.lines.resize(1);
    picture.field_marks = {std::vector<DrawnLine>(3), {{"field", {0.0, 0.0, 1.0}}}};
    REQUIRE(has(colorings_of(picture), {By::field}));
    const Picture result = colored(picture, {By::field}, {});
    CHECK(result.marks.lines.size() == 4);
    CHECK(result.meshes[0].style.color == picture.meshes[0].style.color);
    REQUIRE(legend_of(result));
    CHECK(legend_of(result)->parts == picture.field_marks.names);
    CHECK(colored(picture, {}, {}).marks.lines.size() == 1);
}

TEST_CASE("coloring: shapes are compared with the first of the same faces") {
    RestShapes rest;
    const Picture first = picture_of({make_box()});
    rest.see(first);
    // Made again, as a script that runs again does: another topology of the same faces.
    Mesh larger = make_box();
    for (Vec3& p : larger.edit_positions()) p.x() *= 3.0;
    const Picture second = picture_of({larger});
    rest.see(second);
    const Picture result = colored(second, {By::stretch}, rest.shapes());
    const auto& values = result.meshes[0].style.values;
    REQUIRE(values.size() == 8);
    for (const double value : values) CHECK(value == doctest::Approx(3.0));
    CHECK(result.range == ValueRange{0.99, 3.0});
    // What is as at rest is of one colour, whatever rounding does.
    const Picture same = colored(first, {By::area}, rest.shapes());
    CHECK(same.meshes[0].style.values[0] == 1.0);
    CHECK(same.range == ValueRange{0.99, 1.01});
    rest.forget();
    rest.see(second);
    CHECK(colored(second, {By::angle}, rest.shapes()).meshes[0].style.values[0] == 0.0);
    // Other faces are a shape of their own.
    const Picture torus = picture_of({make_torus()});
    rest.see(torus);
    CHECK(rest.shapes()[0] == torus.meshes[0].mesh);
}

TEST_CASE("colorer: own colours pass at once, others when they are made, and a choice stays") {
    std::atomic<int> done{0};
    Colorer colorer([&] { ++done; });
    const Picture picture = picture_of({box_with_values()});
    colorer.show(shown_of(picture, 1));
    auto colored = colorer.take();
    REQUIRE(colored);
    CHECK(colored->shown.picture->meshes[0].style.values.empty());
    CHECK(done == 0);
    colorer.choose({By::values, "heat"});
    colored = last_of(colorer);
    REQUIRE(colored);
    CHECK(done == 1);
    CHECK(colored->shown.picture->meshes[0].style.values.size() == 8);
    // Meshes without it keep their own; it is there again when the attribute is.
    colorer.show(shown_of(picture_of({make_torus()}), 2));
    colored = last_of(colorer);
    REQUIRE(colored);
    CHECK(colored->shown.picture->meshes[0].style.values.empty());
    colorer.show(shown_of(picture, 3));
    CHECK(last_of(colorer)->shown.picture->meshes[0].style.values.size() == 8);
}

TEST_CASE("colorer: of many shown after each other the last is seen last") {
    Colorer colorer([] {});
    colorer.choose({By::stretch});
    const Picture picture = picture_of({make_torus()});
    for (std::uint64_t i = 1; i <= 200; ++i) colorer.show(shown_of(picture, i));
    auto colored = last_of(colorer);
    REQUIRE(colored);
    CHECK(colored->shown.number == 200);
    // What is asked for in own colours is not overtaken by what was under way.
    colorer.show(shown_of(picture, 201));
    colorer.choose({});
    colored = last_of(colorer);
    CHECK(colored->shown.picture->meshes[0].style.values.empty());
    colorer.compare_with_this();
    CHECK(last_of(colorer)->shown.number == 201);
}
