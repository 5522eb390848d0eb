#include "viewer/window/screen/display.h"

#include <doctest/doctest.h>

#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;
using namespace lissom::window;

namespace {

Picture two_boxes() {
    Picture picture;
    const auto box = std::make_shared<const Mesh>(make_box());
    picture.meshes = {{box}, {box}};
    picture.meshes[1].transform = translation({3.0, 0.0, 0.0});
    return picture;
}

Strands hair(Index count) {
    std::vector<float> points;
    std::vector<Index> offsets{0};
    for (Index s = 0; s < count; ++s) {
        for (int i = 0; i < 3; ++i) {
            points.insert(points.end(), {static_cast<float>(s), static_cast<float>(i), 0.0f});
        }
        offsets.push_back(3 * (s + 1));
    }
    return {std::move(points), std::move(offsets)};
}

}  // namespace

TEST_CASE("display: settings come on top of what the script has asked for") {
    Picture picture = two_boxes();
    picture.meshes[0].style.wire = true;
    DisplaySettings settings;
    Picture plain = displayed(picture, settings, Camera(), 100, 80);
    CHECK(plain.meshes[0].style.wire);
    CHECK_FALSE(plain.meshes[1].style.wire);
    CHECK(plain.options.width == 100);
    CHECK(plain.options.background == background_of(settings));
    CHECK(plain.meshes[1].style.opacity == 1.0);
    settings.wire = settings.flat = settings.boundaries = settings.see_through = true;
    plain = displayed(picture, settings, Camera(), 100, 80);
    CHECK(plain.meshes[1].style.wire);
    CHECK(plain.meshes[1].style.shading == Shading::flat);
    CHECK(plain.meshes[1].style.boundaries);
    CHECK(plain.meshes[1].style.opacity == 0.5);
}

TEST_CASE("display: hidden meshes are left out, and what grows on them") {
    Picture picture = two_boxes();
    const auto strands = std::make_shared<const Strands>(hair(3));
    picture.strands = {{{strands, {}, {}}, 1}};
    DisplaySettings settings;
    settings.hidden = {false, true};
    const Picture plain = displayed(picture, settings, Camera(), 100, 80);
    REQUIRE(plain.meshes.size() == 1);
    CHECK(plain.meshes[0].transform == Affine());
    CHECK(plain.strands.empty());
}

TEST_CASE("display: the legend of values stands beside them, whichever of them are hidden") {
    Picture picture = two_boxes();
    picture.meshes[1].style.values.assign(8, 2.0);
    picture.meshes[1].style.values[0] = 5.0;
    picture.legend_label = "height";
    DisplaySettings settings;
    const auto legend = shown_legend(picture, settings);
    REQUIRE(legend);
    CHECK(legend->label == "height");
    CHECK(legend->range == ValueRange{2.0, 5.0});
    CHECK(legend_of(displayed(picture, settings, Camera(), 100, 80)) == legend);
    settings.hidden = {true, false};
    CHECK(shown_legend(picture, settings) == legend);
    settings.hidden = {false, true};
    CHECK_FALSE(shown_legend(picture, settings));
    CHECK_FALSE(shown_legend(two_boxes(), {}));
    // One value everywhere has a legend too.
    picture.meshes[1].style.values.assign(8, 2.0);
    REQUIRE(shown_legend(picture, {}));
    CHECK(shown_legend(picture, {})->range == ValueRange{2.0, 2.0});
}

TEST_CASE("display: normals are drawn where they are asked for") {
    DisplaySettings settings;
    settings.vertex_normals = true;
    const Picture plain = displayed(two_boxes(), settings, Camera(), 100, 80);
    CHECK(plain.meshes[1].style.vertex_normals);
    CHECK_FALSE(plain.meshes[1].style.face_normals);
}

TEST_CASE("display: meshes in cells stand side by side") {
    Picture picture = two_boxes();
    picture.meshes[1].transform = {};
    picture.columns = 2;
    const Snapshot snapshot = snapshot_of(picture);
    Box first, second;
    for (const Vec3& p : snapshot.meshes[0].mesh->positions()) {
        first.extend(snapshot.meshes[0].transform(p));
        second.extend(snapshot.meshes[1].transform(p));
    }
    CHECK(first.max.x() < second.min.x());
}

TEST_CASE("display: what moves is all that is shown, strands too") {
    Picture picture;
    const auto many = std::make_shared<const Strands>(hair(1000));
    picture.strands = {{{many, {}, {}}, std::nullopt}};
    const Snapshot snapshot = quick_snapshot(picture, {});
    REQUIRE(snapshot.strands.size() == 1);
    CHECK(snapshot.strands[0].strands == many);
}
