// Going on from a result: a new rest shape, and handles with other vertices.

#include <Eigen/Geometry>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/stats.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene resumed_bar() {
    BarOptions options;
    options.across = 4;
    options.along = 20;
    return make_scene(make_bar(options));
}

Affine half_turn(const Deformer& d, HandleId h) {
    return translation({0.2, 0, 0}) * rotation(Vec3::UnitX(), 0.6, d.handle(h).center);
}

}  // namespace

TEST_CASE("new rest shape: the same as deforming a mesh that has it") {
    const Scene scene = resumed_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, half_turn(d, edit.high));
    const std::vector<Vec3> first = d.solve();
    d.rebase();
    CHECK(d.positions() == first);
    CHECK(rest_positions_of(d) == first);
    CHECK(d.pose(edit.high).transform.is_identity());
    CHECK(d.solve() == first);

    Scene after = scene;
    d.apply_to(after.mesh);
    Edit other = make_edit(after);
    CHECK((d.handle(edit.high).center - other.deformer.handle(other.high).center).norm() < 1e-12);
    const Affine move = half_turn(d, edit.high);
    d.set_transform(edit.high, move);
    other.deformer.set_transform(other.high, move);
    CHECK(d.solve(FrameQuality::preview) == other.deformer.solve(FrameQuality::preview));
    CHECK(d.solve() == other.deformer.solve());
    d.reset();
    CHECK(d.positions() == first);
}

TEST_CASE("new rest shape: of a region, with what is around it") {
    const Scene scene = make_scene(make_torus());
    Mesh mesh = scene.mesh;
    std::vector<Index> part;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).x() > 0.2) part.push_back(v);
    }
    const Region region(mesh.shared_topology(), part);
    Deformer d(mesh, region);
    const HandleId h = d.add_handle(scene.region({part[part.size() / 2]}));
    d.set_transform(h, translation({0.3, 0.2, 0.0}));
    d.solve();
    d.apply_to(mesh);
    d.rebase();
    Deformer other(mesh, region);
    const HandleId same = other.add_handle(scene.region({part[part.size() / 2]}));
    for (const auto& [deformer, handle] : {std::pair<Deformer*, HandleId>{&d, h}, {&other, same}}) {
        deformer->set_transform(handle, translation({0.0, -0.3, 0.1}));
        deformer->solve();
    }
    CHECK(max_distance(d.positions(), other.positions()) < 1e-12);
}

TEST_CASE("new rest shape: constraints hold where they are") {
    const Scene scene = resumed_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    const auto near = [&](double y) {
        return SpatialTree(scene.mesh).nearest(Vec3(0.5, y, 0.0)).vertex;
    };
    const Index v = near(0.0), other = near(1.0);
    const MeshPoint point = edge_point(v, scene.mesh.topology().neighbors(v)[0], 0.3);
    d.constrain(VertexConstraint{
        scene.mesh.topology().neighbors(v)[2], scene.mesh.position(v) + Vec3(1, 0, 0), {}, 0.5});
    d.constrain({point, point.position(scene.mesh) + Vec3(0.2, 0.1, 0)});
    d.constrain(VertexConstraint{other, scene.mesh.position(other) + Vec3(0.1, 0, 0),
                                 Mat3(Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix())});
    const std::vector<Vec3> first = d.solve();
    d.rebase();
    CHECK(d.solve() == first);
    d.set_transform(edit.high, translation({0, 0.1, 0}));
    d.solve();
    CHECK(d.positions()[other] == first[other]);
    d.reset();
    CHECK(d.positions() == first);
    CHECK(d.solve() == first);
}

TEST_CASE("new rest shape: normals turn on from where they were") {
    Scene scene = resumed_bar();
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        for (const double x : {0.0, 0.0, 1.0}) normals.values.push_back(x);
    }
    scene.mesh.attributes().add(normals);
    Mesh mesh = scene.mesh;
    Deformer d(mesh, scene.all());
    const HandleId all = d.add_handle(scene.all());
    for (int step = 0; step < 2; ++step) {
        d.set_transform(all, rotation(Vec3::UnitX(), 0.3, Vec3::Zero()));
        d.solve();
        d.apply_to(mesh);
        d.rebase();
    }
    const std::span<const double> n = mesh.attributes().find("normal")->at(3);
    CHECK((Vec3(n[0], n[1], n[2]) - Vec3(0, -std::sin(0.6), std::cos(0.6))).norm() < 1e-12);
}

TEST_CASE("other vertices for a handle: the old result stays, then the transform goes on") {
    const Scene scene = resumed_bar();
    Edit edit = make_edit(scene), same = make_edit(scene);
    Deformer& d = edit.deformer;
    const Affine move = half_turn(d, edit.high);
    d.set_transform(edit.high, move);
    same.deformer.set_transform(same.high, move);
    const std::vector<Vec3> before = d.solve(FrameQuality::preview);
    same.deformer.solve(FrameQuality::preview);
    const std::vector<Mat3> gradients = gradients_of(same.deformer);
    const std::vector<Index> fewer(scene.high.begin() + 4, scene.high.end());
    set_handle_region(d, edit.high, scene.region(fewer));
    CHECK(d.positions() == before);
    CHECK(gradients_of(d) == gradients);
    CHECK(d.pose(edit.high).transform == move);
    CHECK(d.handle(edit.high).region == scene.region(fewer));
    const Index count = stats_of(d).factorizations;
    d.solve();
    CHECK(stats_of(d).factorizations == count + 1);

    Deformer fresh(scene.mesh, scene.all());
    fresh.add_handle(scene.region(scene.low));
    fresh.set_transform(fresh.add_handle(scene.region(fewer)), move);
    CHECK(fresh.solve() == d.positions());
}

TEST_CASE("adding, removing and constraining: the old result stays until the next solve") {
    const Scene scene = resumed_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    d.set_transform(edit.high, half_turn(d, edit.high));
    const std::vector<Vec3> before = d.solve();
    const Index middle = scene.mesh.vertex_count() / 2;
    const HandleId extra = d.add_handle(scene.region({middle}));
    CHECK(d.positions() == before);
    d.constrain(VertexConstraint{middle + 20, Vec3(0, 0, 0)});
    CHECK(d.positions() == before);
    d.remove_handle(extra);
    set_stiffness(d, scene.region(scene.low), 3.0);
    CHECK(d.positions() == before);
    CHECK(gradients_of(d).size() == before.size());
    d.solve();
    CHECK(d.positions()[middle + 20] == Vec3(0, 0, 0));
}

TEST_CASE("other vertices for a handle: bad ones are refused, and the handle stays") {
    const Scene scene = resumed_bar();
    Edit edit = make_edit(scene);
    Deformer& d = edit.deformer;
    std::vector<Index> mixed = scene.high;
    mixed.push_back(scene.low[0]);
    CHECK(error_of([&] { set_handle_region(d, edit.high, scene.region(mixed)); }).code() ==
          ErrorCode::handle_overlap);
    CHECK(error_of([&] { set_handle_region(d, edit.high, scene.region({})); }).code() ==
          ErrorCode::region_empty);
    CHECK(error_of([&] { set_handle_region(d, {99}, scene.region({0})); }).code() ==
          ErrorCode::handle_removed);
    CHECK(d.handle(edit.high).region == scene.region(scene.high));
}

TEST_CASE("new rest shape: of real meshes, in many small steps") {
    for (const char* name : {"cactus_cinolib.off", "lion.off", "cad_block.off"}) {
        const auto path = data_file(std::string("models/") + name);
        if (!path) continue;
        CAPTURE(name);
        const Scene scene = make_scene(load_mesh(*path));
        Edit edit = make_edit(scene);
        Deformer& d = edit.deformer;
        for (int step = 0; step < 3; ++step) {
            const Affine move = half_turn(d, edit.high);
            const std::vector<Vec3> rest = rest_positions_of(d);
            d.set_transform(edit.high, move);
            d.solve();
            for (const Index v : scene.high) CHECK(d.positions()[v] == move(rest[v]));
            d.rebase();
        }
        bool finite = true;
        for (const Vec3& p : d.solve()) finite = finite && p.allFinite();
        CHECK(finite);
    }
}
