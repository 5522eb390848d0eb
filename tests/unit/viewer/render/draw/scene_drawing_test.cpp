#include "viewer/render/draw/scene_drawing.h"

#include <doctest/doctest.h>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/deform_item.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/polyline_item.h"
#include "kernel/scene/scene.h"
#include "kernel/scene/strands_item.h"

using namespace lissom;

namespace {

struct BarScene {
    std::shared_ptr<Mesh> bar = std::make_shared<Mesh>(make_bar());
    std::shared_ptr<MeshItem> item = std::make_shared<MeshItem>(bar);
    Scene scene;

    SceneDrawing drawing() const { return drawing_of(scene.objects()); }
};

}  // namespace

TEST_CASE("scene drawing: visible objects, where they stand and as they look") {
    BarScene s;
    ObjectLook look;
    look.transform = translation(Vec3(1, 2, 3));
    look.style.color = Vec3(1, 0, 0);
    look.style.flat = true;
    look.style.region = "top";
    const ObjectId id = s.scene.add("bar", s.item, look);
    s.scene.add("again", s.item, {.style = {.region = "no such region"}});
    s.scene.add("hidden", s.item, {.visible = false});
    s.scene.add("empty", std::make_shared<MeshItem>(std::make_shared<Mesh>()));
    const SceneDrawing drawing = s.drawing();
    REQUIRE(drawing.meshes.size() == 2);
    const DrawnMesh& drawn = drawing.meshes[0];
    CHECK(drawn.mesh == s.bar);
    CHECK(drawn.object == id.value);
    CHECK(drawn.transform == look.transform);
    CHECK(drawn.style.color == Color{1, 0, 0});
    CHECK(!drawn.style.vertex_colors);
    CHECK(drawn.style.shading == Shading::flat);
    CHECK(drawn.style.region == *s.bar->find_region("top"));
    CHECK(!drawing.meshes[1].style.region);
    CHECK(drawing.meshes[1].style.color == kClayColor);
}

TEST_CASE("scene drawing: a deformation shows its handles, on its mesh once") {
    BarScene s;
    const Region& top = *s.bar->find_region("top");
    const auto edit = std::make_shared<Deformer>(*s.bar, top.grown(4));
    edit->add_handle(top);
    const ObjectId bend = s.scene.add("bend", std::make_shared<DeformItem>(edit, s.item));
    SceneDrawing drawing = s.drawing();
    REQUIRE(drawing.meshes.size() == 1);
    CHECK(drawing.meshes[0].style.handles.size() == 1);
    CHECK(drawing.meshes[0].style.region == edit->region());

    s.scene.add("bar", s.item, {.transform = translation(Vec3(1, 0, 0))});
    drawing = s.drawing();
    REQUIRE(drawing.meshes.size() == 1);
    CHECK(drawing.meshes[0].transform.translation.x() == 1.0);
    CHECK(drawing.meshes[0].style.handles.size() == 1);

    s.scene.set_look(bend, {.style = {.handles = false}});
    CHECK(s.drawing().meshes[0].style.handles.empty());
    s.scene.set_look(bend, {});
    s.bar->replace_by(make_bar());
    CHECK(s.drawing().meshes[0].style.handles.empty());
}

TEST_CASE("scene drawing: a mesh without faces is its vertices, an even choice of very many") {
    const auto drawn = [](std::vector<Vec3> places) {
        ObjectLook look;
        look.transform = translation(Vec3(1, 2, 3));
        Scene scene;
        scene.add("cloud",
                  std::make_shared<MeshItem>(std::make_shared<Mesh>(std::move(places), FaceList())),
                  look);
        return drawing_of(scene.objects());
    };
    const SceneDrawing few = drawn({Vec3(0, 0, 0), Vec3(1, 0, 0)});
    CHECK(few.meshes.empty());
    REQUIRE(few.points.size() == 2);
    CHECK(few.points[1].position == Vec3(2, 2, 3));
    const SceneDrawing many = drawn(std::vector<Vec3>(1000000, Vec3(1, 1, 1)));
    CHECK(many.points.size() > 25000);
    CHECK(many.points.size() <= 50000);
}

TEST_CASE("scene drawing: strands and free curves") {
    BarScene s;
    const auto hair = std::make_shared<Strands>(Strands({0, 0, 0, 0, 1, 0}, {0, 2}));
    s.scene.add("hair", std::make_shared<StrandsItem>(hair), {.style = {.level = 0.5}});
    const auto line = std::make_shared<Polyline>(Polyline{{Vec3::Zero(), Vec3::UnitX()}, true});
    s.scene.add("line", std::make_shared<PolylineItem>(line),
                {.transform = translation(Vec3(0, 2, 0)), .style = {.line_width = 7.0}});
    const SceneDrawing drawing = s.drawing();
    REQUIRE(drawing.strands.size() == 1);
    CHECK(drawing.strands[0].strands == hair);
    CHECK(drawing.strands[0].style.level == 0.5);
    CHECK(!drawing.strands[0].style.color);
    REQUIRE(drawing.lines.size() == 1);
    CHECK(drawing.lines[0].points[1] == Vec3(1, 2, 0));
    CHECK(drawing.lines[0].closed);
    CHECK(drawing.lines[0].width == 7.0);
}
