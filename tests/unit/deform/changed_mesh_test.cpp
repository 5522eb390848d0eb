// A mesh that moves under its deformation, and calls that run out of memory.

#include <new>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/failing_memory.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("a mesh that was moved around the region is refused, and stays as it is") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Mesh mesh = scene.mesh;
    Deformer d(mesh, select_plane(mesh, Vec3::Zero(), Vec3::UnitY()));
    const HandleId high = d.add_handle(scene.region(scene.high));
    d.set_transform(high, bend(scene, d.handle(high).center));
    d.solve();
    d.apply_to(mesh);
    transform(mesh, translation({0.1, 0, 0}));
    const auto before = hash(mesh);
    for (const auto& write :
         {+[](Deformer&e, Mesh&m) { e.apply_to(m); }, +[](Deformer&e, Mesh&m) { apply_rest(e, m); },
          +[](Deformer&e, Mesh&m) { (void)subdivided_mesh(e, m); }}) {
        const Error error = error_of([&] { write(d, mesh); });
        CHECK(error.code() == ErrorCode::topology_mismatch);
        CHECK(error.elements().count > 0);
        CHECK(error.message().find("mesh has changed") != std::string::npos);
        CHECK(hash(mesh) == before);
    }
    // Back again, up to rounding, and moved where it does not matter.
    transform(mesh, translation({-0.1, 0, 0}));
    mesh.set_position(scene.low.front(), mesh.position(scene.low.front()) + Vec3(0, -0.1, 0));
    d.apply_to(mesh);
    CHECK(mesh.position(scene.high.back()) == d.positions().back());
}

TEST_CASE("a deformation of the whole mesh has no surroundings that could change") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    Edit edit = make_edit(scene);
    Mesh mesh = scene.mesh;
    transform(mesh, translation({1, 0, 0}));
    edit.deformer.apply_to(mesh);
    CHECK(hash(mesh) == hash(scene.mesh));
}

TEST_CASE("gradients that run out of memory leave the handles where they were asked to go") {
    const Scene scene = make_scene(make_bar({1.0, 5.0, 4, 20}));
    const auto prepared = [&] {
        Edit edit = make_edit(scene);
        edit.deformer.set_transform(edit.high, bend(scene, Vec3(0, 2.5, 0)));
        edit.deformer.solve(FrameQuality::preview);
        edit.deformer.set_transform(edit.high, translation({1, 0, 0}));
        return edit;
    };
    Edit whole = prepared();
    const std::vector<Mat3> gradients = gradients_of(whole.deformer);
    const std::vector<Vec3> wanted = whole.deformer.solve();
    int failures = 0;
    for (long count = 0; count < 1000; ++count) {
        Edit edit = prepared();
        bool failed = false;
        allocations_left = count;
        try {
            gradients_of(edit.deformer);
        } catch (const std::bad_alloc&) {
            failed = true;
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::memory_limit);
            failed = true;
        }
        allocations_left = -1;
        CHECK(transform_about(edit.deformer, edit.high, Vec3::Zero()) == translation({1, 0, 0}));
        CHECK(gradients_of(edit.deformer) == gradients);
        CHECK(edit.deformer.solve() == wanted);
        if (!failed) break;
        ++failures;
    }
    CHECK(failures > 0);
}
