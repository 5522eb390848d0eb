// Handles are put back to where they stood, and the rest shape can be had at any time.

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("restored handles give the same shape to the bit") {
    const Scene scene = make_scene(make_bar());
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, bend(scene, d.handle_center(edit.high)));
    const std::vector<Vec3> before = d.solve();
    const auto poses = d.poses();
    d.set_transform(edit.high, {});
    d.set_transform(edit.low, translation({1, 2, 3}));
    d.solve();
    d.restore(*poses);
    CHECK(d.solve() == before);
    CHECK(d.transform(edit.low).is_identity());
}

TEST_CASE("restoring leaves removed and added handles as they are") {
    const Scene scene = make_scene(make_bar());
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, translation({1, 0, 0}));
    const auto poses = d.poses();
    d.remove_handle(edit.high);
    const HandleId added = d.add_handle(scene.region(scene.high));
    d.set_transform(added, translation({0, 1, 0}));
    d.restore(*poses);
    CHECK(d.handles() == std::vector<HandleId>{edit.low, added});
    CHECK(d.transform(added).translation == Vec3(0, 1, 0));
    CHECK(error_of([&] { d.transform(edit.high); }).code() == ErrorCode::handle_removed);
}

TEST_CASE("the rest shape is written to the bit, normals included") {
    Scene scene = make_scene(make_bar());
    std::vector<double> normals;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        for (const double x : {0.6, 0.0, 0.8}) normals.push_back(x);
    }
    scene.mesh.attributes().add({"normal", Domain::vertex, 3, ScalarType::float32, normals});
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, bend(scene, d.handle_center(edit.high)));
    d.solve();
    Mesh mesh = scene.mesh;
    d.apply_to(mesh);
    REQUIRE(hash(mesh) != hash(scene.mesh));
    d.apply_rest_to(mesh);
    CHECK(hash(mesh) == hash(scene.mesh));
    const Mesh other = make_box();
    Mesh wrong = other;
    CHECK(error_of([&] { d.apply_rest_to(wrong); }).code() == ErrorCode::topology_mismatch);
}
