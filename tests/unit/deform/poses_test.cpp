// Handles are put back to where they stood, and the rest shape can be had at any time.

#include "kernel/deform/deformed_surface.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("restored handles give the same shape to the bit") {
    const Scene scene = make_scene(make_bar());
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, bend(scene, d.handle(edit.high).center));
    const std::vector<Vec3> before = d.solve();
    const DeformSnapshot before_moves = d.snapshot();
    d.set_transform(edit.high, {});
    d.set_transform(edit.low, translation({1, 2, 3}));
    d.solve();
    d.restore(before_moves);
    CHECK(d.solve() == before);
    CHECK(d.pose(edit.low).transform.is_identity());
}

TEST_CASE("restoring brings removed handles back, and added ones go") {
    const Scene scene = make_scene(make_bar());
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, translation({1, 0, 0}));
    const DeformSnapshot before = d.snapshot();
    d.remove_handle(edit.high);
    const HandleId added = d.add_handle(scene.region(scene.high));
    d.set_transform(added, translation({0, 1, 0}));
    d.restore(before);
    CHECK(d.handles() == std::vector<HandleId>{edit.low, edit.high});
    CHECK(d.pose(edit.high).transform.translation == Vec3(1, 0, 0));
    CHECK(error_of([&] { d.handle(added); }).code() == ErrorCode::handle_removed);
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
    d.set_transform(edit.high, bend(scene, d.handle(edit.high).center));
    d.solve();
    Mesh mesh = scene.mesh;
    d.apply_to(mesh);
    REQUIRE(hash(mesh) != hash(scene.mesh));
    apply_rest(d, mesh);
    CHECK(hash(mesh) == hash(scene.mesh));
    const Mesh other = make_box();
    Mesh wrong = other;
    CHECK(error_of([&] { apply_rest(d, wrong); }).code() == ErrorCode::topology_mismatch);
}
