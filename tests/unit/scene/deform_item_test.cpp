#include "kernel/scene/deform_item.h"

#include <doctest/doctest.h>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/description.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "kernel/scene/mesh_item.h"
#include "kernel/scene/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using lissom::test::error_of;

namespace {

// A bar held at its bottom, with a handle at its top, as the one object of a scene.
struct BentBar {
    std::shared_ptr<Mesh> bar = std::make_shared<Mesh>(make_bar());
    std::shared_ptr<Deformer> edit =
        std::make_shared<Deformer>(*bar, Region::all(bar->shared_topology()));
    HandleId bottom = edit->add_handle(*bar->find_region("bottom"));
    HandleId top = edit->add_handle(*bar->find_region("top"));
    Scene scene;

    BentBar() {
        scene.add("bend", std::make_shared<DeformItem>(edit, std::make_shared<MeshItem>(bar)));
    }
    void turn(double degrees) {
        const Vec3 center = edit->handle(top).center;
        edit->set_transform(top, rotation(Vec3::UnitZ(), degrees * kDegree, center));
        edit->solve();
        edit->apply_to(*bar);
    }
};

}  // namespace

TEST_CASE("deform item: a drag is undone in the deformation and in its mesh") {
    BentBar b;
    const std::uint64_t rest = b.scene.hash(), rest_mesh = hash(*b.bar);
    b.scene.step("turn", [&] { b.turn(40.0); });
    const std::uint64_t turned = b.scene.hash();
    const std::vector<Vec3> shown = b.edit->positions();
    b.scene.step("turn on", [&] { b.turn(80.0); });

    b.scene.undo();
    CHECK(b.scene.hash() == turned);
    CHECK(b.edit->positions() == shown);
    b.scene.undo();
    CHECK(b.scene.hash() == rest);
    CHECK(hash(*b.bar) == rest_mesh);
    CHECK(b.edit->pose(b.top).transform.is_identity());
    CHECK(b.edit->positions() == rest_positions_of(*b.edit));
    b.scene.redo();
    CHECK(b.scene.hash() == turned);
    // The next solve goes on from there, to the bit.
    b.edit->solve();
    CHECK(b.edit->positions() == shown);
}

TEST_CASE("deform item: what a preview or a solve left unwritten is undone as well") {
    BentBar b;
    const std::uint64_t rest = b.scene.hash();
    b.edit->set_transform(b.top, translation(Vec3(1, 0, 0)));
    CHECK(b.scene.undo() == Scene::kEdited);
    CHECK(b.edit->pose(b.top).transform.is_identity());
    b.scene.redo();
    b.edit->solve(FrameQuality::preview);
    CHECK(b.scene.undo() == Scene::kEdited);
    CHECK(b.edit->positions() == rest_positions_of(*b.edit));
    CHECK(!b.edit->pose(b.top).transform.is_identity());
    b.scene.undo();
    CHECK(b.scene.hash() == rest);
}

TEST_CASE("deform item: handles, constraints, stiffness and a new rest shape are undone") {
    BentBar b;
    const auto change = [&](const auto& work) {
        const std::uint64_t before = b.scene.hash();
        b.scene.step("change", work);
        const std::uint64_t after = b.scene.hash();
        CHECK(after != before);
        b.scene.undo();
        CHECK(b.scene.hash() == before);
        b.scene.redo();
        CHECK(b.scene.hash() == after);
    };
    change([&] { b.turn(30.0); });
    change([&] { b.edit->remove_handle(b.bottom); });
    change([&] { b.bottom = b.edit->add_handle(*b.bar->find_region("bottom")); });
    change([&] {
        b.edit->constrain(VertexConstraint{b.edit->region().vertices()[40], Vec3(1, 2, 3)});
    });
    change([&] { set_stiffness(*b.edit, b.edit->region(), 2.0); });
    change([&] { b.edit->rebase(); });
    change([&] { b.turn(10.0); });
    change([&] { b.edit->reset(); });
    for (std::size_t steps = b.scene.history().place; steps > 1; --steps) b.scene.undo();
    CHECK(b.scene.history().place == 1);
    CHECK(b.edit->handles().size() == 2);
    b.turn(30.0);
    CHECK(b.scene.undo() == Scene::kEdited);
}

TEST_CASE("deform item: the mesh is captured once, whether it has a name or not") {
    BentBar b;
    CHECK(b.scene.state()->items.size() == 2);
    b.scene.add("bar", std::make_shared<MeshItem>(b.bar));
    CHECK(b.scene.state()->items.size() == 2);
    const std::uint64_t before = b.scene.hash();
    b.scene.step("turn", [&] { b.turn(40.0); });
    b.scene.undo();
    CHECK(b.scene.hash() == before);
}

TEST_CASE("deform item: the hash knows no history of handles") {
    BentBar a, b;
    CHECK(a.scene.hash() == b.scene.hash());
    b.edit->remove_handle(b.top);
    b.top = b.edit->add_handle(*b.bar->find_region("top"));
    CHECK(a.scene.hash() == b.scene.hash());
    a.turn(10.0);
    b.turn(10.0);
    CHECK(a.scene.hash() == b.scene.hash());
}

TEST_CASE("deform item: a drag costs the positions and gradients of its end") {
    BentBar b;
    b.scene.step("turn", [&] { b.turn(20.0); });
    const std::size_t n = at(b.bar->vertex_count());
    const std::size_t bytes = b.scene.history().steps.back().bytes;
    CHECK(bytes >= n * (2 * sizeof(Vec3) + sizeof(Mat3)));
    CHECK(bytes <= n * (2 * sizeof(Vec3) + sizeof(Mat3)) + 20000);
}

TEST_CASE("description: a setup comes back to the bit") {
    BentBar b;
    const Mesh rest = *b.bar;
    b.edit->remove_handle(b.bottom);
    b.bottom = b.edit->add_handle(*rest.find_region("bottom"), {.falloff = 0.2});
    const auto middle = face_point(rest.topology(), 30, std::vector{0.4, 0.3, 0.2, 0.1});
    const HandleId soft =
        b.edit->add_handle(std::vector{middle}, {.gradient = false, .weight = 3.0});
    b.edit->constrain(VertexConstraint{rest.topology().face(50)[0], Vec3(0.1, 0.2, 0.3)});
    b.edit->constrain(
        PointConstraint{face_point(rest.topology(), 60, std::vector{0.1, 0.2, 0.3, 0.4}),
                        Vec3(0.5, 0.0, 0.0), Mat3(Mat3::Identity()), 10.0});
    set_stiffness(*b.edit, *rest.find_region("top"), 4.0);
    b.edit->set_transform(soft, translation(Vec3(0.1, 0, 0)));
    b.turn(50.0);

    const DeformDescription described = describe(b.edit->snapshot());
    CHECK(!described.handles.front());
    CHECK(described.constraints.size() == 2);
    Deformer other(rest, Region::all(rest.shared_topology()));
    other.restore(snapshot_of(described, rest_of(other)));
    other.solve();
    CHECK(other.positions() == b.edit->positions());
    CHECK(other.pose(b.top).turn == b.edit->pose(b.top).turn);
    CHECK(other.handle(soft).options.weight == 3.0);
}

TEST_CASE("description: what fits no deformation is refused") {
    const Mesh mesh = make_cactus();
    Deformer edit(mesh, Region::all(mesh.shared_topology()));
    edit.add_handle(*mesh.find_region("base"));
    const HandleId arm = edit.add_handle(*mesh.find_region("tip"));
    edit.set_transform(arm, translation(Vec3(0, 0.1, 0)));
    const DeformDescription described = describe(edit.snapshot());
    const auto code_of = [&](const auto& change) {
        DeformDescription wrong = described;
        change(wrong);
        return error_of([&] { snapshot_of(wrong, rest_of(edit)); }).code();
    };
    CHECK(code_of([](auto& d) { d.handles[0]->partner = HandleId{1}; }) ==
          ErrorCode::invalid_argument);
    CHECK(code_of([](auto& d) { d.handles[0]->partner = HandleId{17}; }) ==
          ErrorCode::invalid_argument);
    CHECK(code_of([](auto& d) { d.handles[1]->vertices = d.handles[0]->vertices; }) ==
          ErrorCode::handle_overlap);
    CHECK(code_of([](auto& d) { d.handles[1]->vertices.push_back(1 << 30); }) ==
          ErrorCode::out_of_range);
    CHECK(code_of([](auto& d) { d.handles[1]->vertices.clear(); }) == ErrorCode::region_empty);
    CHECK(code_of([](auto& d) { d.handles[1]->pose.transform.linear.setZero(); }) ==
          ErrorCode::singular_transform);
    CHECK(code_of([](auto& d) { d.stiffness = {1.0}; }) == ErrorCode::invalid_argument);
}
