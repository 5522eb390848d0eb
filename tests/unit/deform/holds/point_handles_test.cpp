// Points of faces and edges as handles and constraints, and paths: the point of the deformed face
// with the same weights lies where it was asked to.

#include <Eigen/Geometry>
#include <array>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/stats.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene point_bar() {
    BarOptions options;
    options.across = 4;
    options.along = 20;
    return make_scene(make_bar(options));
}

Vec3 place_of(const MeshPoint& point, const std::vector<Vec3>& x) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < point.vertices.size(); ++i) {
        sum += point.weights[i] * x[point.vertices[i]];
    }
    return sum;
}

// The surface point nearest to the mean of `vertices`.
MeshPoint point_near(const Scene& scene, const std::vector<Index>& vertices) {
    Vec3 center = Vec3::Zero();
    for (const Index v : vertices) center += scene.mesh.position(v) / vertices.size();
    const SurfacePoint found = SpatialTree(scene.mesh).nearest(center);
    MeshPoint point = mesh_point(found);
    point.weights = {0.3, 0.5, 0.2};
    return point;
}

// A face of which no vertex is in the lower handle, with uneven weights.
MeshPoint high_face(const Scene& scene) {
    const Index face = scene.mesh.topology().faces_around(scene.high[scene.high.size() / 2])[0];
    const auto corners = static_cast<std::size_t>(scene.mesh.topology().face(face).size());
    std::vector<double> weights(corners, 0.4 / static_cast<double>(corners - 1));
    weights[0] = 0.6;
    return face_point(scene.mesh.topology(), face, weights);
}

}  // namespace

TEST_CASE("face points: a constraint is met by the deformed face, in previews and in results") {
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::poisson, SecondSystem::laplacian}) {
        for (const Scene& scene : {point_bar(), make_scene(make_torus()), make_scene(make_box())}) {
            DeformOptions options;
            options.second = second;
            Deformer d(scene.mesh, scene.all(), options);
            d.add_handle(scene.region({scene.low[0], scene.low[1]}));
            const MeshPoint point = high_face(scene);
            const Vec3 target =
                place_of(point, rest_positions_of(d)) + scene.size * Vec3(0.3, 0.4, -0.2);
            d.constrain({point, target});
            CHECK((place_of(point, d.solve(FrameQuality::preview)) - target).norm() <
                  1e-9 * scene.size);
            CHECK(max_distance(d.positions(), solve_first_directly(d)) < 1e-9 * scene.size);
            CHECK((place_of(point, d.solve()) - target).norm() < 1e-9 * scene.size);

            const Index count = stats_of(d).factorizations;
            d.constrain({point, target + Vec3(0.1, 0, 0)});
            CHECK((place_of(point, d.solve()) - target - Vec3(0.1, 0, 0)).norm() <
                  1e-9 * scene.size);
            CHECK(stats_of(d).factorizations == count);
            d.constrain({point});
            CHECK(d.solve() == rest_positions_of(d));
        }
    }
}

TEST_CASE("face points: real meshes meet them too") {
    for (const char* name : {"armadillo_43k.obj", "lion.off", "cactus_cinolib.off", "dinosaur.obj",
                             "fertility.off", "cad_block.off", "spot.obj", "horse_quad.obj"}) {
        const auto path = data_file(std::string("models/") + name);
        if (!path) continue;
        CAPTURE(name);
        const Scene scene = make_scene(load_mesh(*path));
        Deformer d(scene.mesh, scene.all());
        d.add_handle(scene.region(scene.low));
        const std::vector<MeshPoint> points{point_near(scene, scene.high), high_face(scene)};
        if (points[0].vertices == points[1].vertices) continue;
        const HandleId high = d.add_handle(points);
        const Affine move = bend(scene, d.handle(high).center);
        d.set_transform(high, move);
        for (const bool preview : {true, false}) {
            const std::vector<Vec3>& x = preview ? d.solve(FrameQuality::preview) : d.solve();
            for (const MeshPoint& p : points) {
                CHECK((place_of(p, x) - move(place_of(p, rest_positions_of(d)))).norm() <
                      1e-9 * scene.size);
            }
        }
        for (const Index v : scene.low) CHECK(d.positions()[v] == scene.mesh.position(v));
    }
}

TEST_CASE("face points: a handle of them turns the faces, and follows similarities") {
    const Scene scene = point_bar();
    DeformOptions options;
    options.local_size = LocalSize::scale;
    Deformer d(scene.mesh, scene.all(), options);
    const HandleId low = d.add_handle(scene.region(scene.low));
    const std::vector<MeshPoint> points{high_face(scene)};
    const HandleId high = d.add_handle(points);
    CHECK((d.handle(high).center - points[0].position(scene.mesh)).norm() < 1e-12);
    d.set_transform(high, rotation(Vec3::UnitY(), 0.7, d.handle(high).center));
    d.solve();
    for (const Index v : points[0].vertices) {
        CHECK(Eigen::AngleAxisd(gradients_of(d)[v]).angle() == doctest::Approx(0.7));
    }
    // The face lies as its gradient says, and so does what the second system makes of it.
    const std::vector<Index>& face = points[0].vertices;
    const Vec3 side = scene.mesh.position(face[1]) - scene.mesh.position(face[0]);
    const Vec3 now = d.positions()[face[1]] - d.positions()[face[0]];
    CHECK((now - Eigen::AngleAxisd(0.7, Vec3::UnitY()) * side).norm() < 0.1 * side.norm());
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-11 * scene.size);

    Affine map = rotation({1, 2, 3}, 1.4, {5, 0, 0});
    map.linear *= 1.7;
    d.set_transform(low, map);
    d.set_transform(high, map);
    CHECK(max_distance(d.solve(), mapped(rest_positions_of(d), map)) < 1e-9 * scene.size);
}

TEST_CASE("face points: four of them hold a surface without any handle") {
    const Scene scene = make_scene(make_torus());
    Deformer d(scene.mesh, scene.all());
    const Affine move = rotation({1, 1, 0}, 0.9, {0, 3, 0});
    const Index faces = scene.mesh.face_count();
    for (const Index f : {Index{0}, faces / 3, faces / 2, faces - 7}) {
        const MeshPoint point =
            face_point(scene.mesh.topology(), f, std::array{0.1, 0.2, 0.3, 0.4});
        d.constrain({point, move(point.position(scene.mesh))});
    }
    CHECK(max_distance(d.solve(FrameQuality::preview), mapped(rest_positions_of(d), move)) <
          1e-8 * scene.size);
    CHECK(max_distance(d.solve(), mapped(rest_positions_of(d), move)) < 1e-8 * scene.size);
}

TEST_CASE("face points: soft ones are drawn") {
    const Scene scene = point_bar();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    const MeshPoint point = high_face(scene);
    const Vec3 target = point.position(scene.mesh) + Vec3(1, 0, 0);
    const auto distance = [&](double weight) {
        d.constrain({point, target, {}, weight});
        return (place_of(point, d.solve()) - target).norm();
    };
    CHECK(distance(0.1) > 0.5);
    CHECK(distance(1.0) > 0.1);
    CHECK(distance(1.0) < 0.9);
    CHECK(distance(1e6) < 1e-4);
}

TEST_CASE("edge points and paths: a handle moves the curve as one") {
    const Scene scene = point_bar();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    // Around the bar at its middle, across the edges that run along it.
    std::vector<MeshPoint> ring;
    for (Index e = 0; e < scene.mesh.topology().edge_count(); ++e) {
        const auto [a, b] = scene.mesh.topology().edge(e);
        const double ya = scene.mesh.position(a).y() - 0.06, yb = scene.mesh.position(b).y() - 0.06;
        if (ya * yb < 0.0) ring.push_back(edge_point(a, b, ya / (ya - yb)));
    }
    REQUIRE(ring.size() == 16);
    const HandleId waist = d.add_handle(ring);
    const Affine move = translation({0.4, 0, 0.1}) * rotation(Vec3::UnitZ(), 0.5, {0, 0, 0});
    d.set_transform(waist, move);
    d.solve();
    for (const MeshPoint& p : ring) {
        CHECK((place_of(p, d.positions()) - move(p.position(scene.mesh))).norm() <
              1e-9 * scene.size);
    }

    const Path free({{0.5, 1.0, 0.1}, {0.2, 1.1, 0.51}, {-0.2, 1.3, 0.5}}, false);
    const HandleId drawn = d.add_handle(path_points(scene.mesh, free));
    const std::vector<Index> along{scene.high[0], scene.high[1], scene.high[0]};
    const Path vertices(scene.mesh.shared_topology(), along, false);
    const HandleId held = d.add_handle(path_points(scene.mesh, vertices));
    CHECK(d.handle(held).region.size() == 2);
    d.set_transform(drawn, translation({0.1, 0.2, 0.3}));
    d.set_transform(held, translation({0.3, 0.0, 0.0}));
    d.solve();
    for (const MeshPoint& p : path_points(scene.mesh, free)) {
        CHECK((place_of(p, d.positions()) - p.position(scene.mesh) - Vec3(0.1, 0.2, 0.3)).norm() <
              1e-9 * scene.size);
    }
    CHECK(d.positions()[scene.high[0]] == scene.mesh.position(scene.high[0]) + Vec3(0.3, 0.0, 0.0));
}

TEST_CASE("points of one handle may determine each other") {
    const Scene scene = make_scene(make_torus());
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    std::vector<MeshPoint> points;
    for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        points.push_back(face_point(scene.mesh.topology(), 5,
                                    std::array{t, 0.5 * (1 - t), 0.3 * (1 - t), 0.2 * (1 - t)}));
    }
    const HandleId h = d.add_handle(points);
    const Affine move = rotation({1, 0, 0}, 0.3, d.handle(h).center);
    d.set_transform(h, move);
    d.solve();
    for (const MeshPoint& p : points) {
        CHECK((place_of(p, d.positions()) - move(p.position(scene.mesh))).norm() <
              1e-9 * scene.size);
    }
}

TEST_CASE("points that others determine already are refused") {
    const Scene scene = point_bar();
    const Index face = scene.mesh.topology().faces_around(scene.high[0])[0];
    const std::span<const Index> corners = scene.mesh.topology().face(face);
    const MeshPoint point = face_point(scene.mesh.topology(), face, std::array{0.4, 0.3, 0.2, 0.1});
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region({corners.begin(), corners.end()}));
    d.constrain({point, Vec3(0, 0, 0)});
    const Error error = error_of([&] { d.solve(); });
    CHECK(error.code() == ErrorCode::handle_overlap);
    CHECK(error.elements().count == 4);
    // A weight makes it a wish that cannot be met.
    d.constrain({point, Vec3(0, 0, 0), {}, 1.0});
    CHECK(d.solve() == rest_positions_of(d));

    Deformer twice(scene.mesh, scene.all());
    twice.add_handle(scene.region(scene.low));
    const MeshPoint a = edge_point(corners[0], corners[1], 0.25);
    twice.constrain({a, Vec3(0, 0, 0)});
    twice.constrain({edge_point(corners[0], corners[1], 0.5), Vec3(0, 0, 1)});
    twice.solve();
    twice.constrain({edge_point(corners[0], corners[1], 0.75), Vec3(0, 1, 1)});
    CHECK(error_of([&] { twice.solve(); }).code() == ErrorCode::handle_overlap);
}

TEST_CASE("points: weights and vertices that are no point of a face are refused") {
    const Scene scene = point_bar();
    Deformer d(scene.mesh, scene.all());
    const Vec3 p(0, 0, 0);
    const auto code = [&](const MeshPoint& point) {
        return error_of([&] { d.constrain({point, p}); }).code();
    };
    const Index a = scene.low[0], b = scene.high[0];
    CHECK(code(edge_point(a, b, 0.5)) == ErrorCode::invalid_argument);
    CHECK(code(edge_point(a, scene.mesh.topology().neighbors(a)[0], 1.5)) ==
          ErrorCode::invalid_argument);
    CHECK(code({{a}, {0.5}}) == ErrorCode::invalid_argument);
    CHECK(code({{-1}, {1.0}}) == ErrorCode::out_of_range);
    CHECK(error_of([&] {
              face_point(scene.mesh.topology(), 0, std::array{0.5, 0.5});
          }).code() == ErrorCode::invalid_argument);
    const Error few = error_of([&] { face_point(scene.mesh.topology(), 3, std::array{0.5, 0.5}); });
    CHECK(few.elements().kind == ElementKind::face);
    CHECK(few.elements().count == 1);
    CHECK(few.elements().ids == std::vector<Index>{3});
    Deformer part(scene.mesh, scene.region(scene.high));
    CHECK(error_of([&] {
              part.constrain({edge_point(a, scene.mesh.topology().neighbors(a)[0], 0.5), p});
          }).code() == ErrorCode::handle_outside_region);
}
