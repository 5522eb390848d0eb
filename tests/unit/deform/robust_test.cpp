// Meshes as they come: slivers, obtuse triangles, planes, several parts, and hardly any mesh at
// all.

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/repair/repair.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

bool all_finite(const std::vector<Vec3>& points) {
    return std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); });
}

Mesh triangulated(Mesh mesh) {
    triangulate(mesh);
    return mesh;
}

Mesh bar() {
    BarOptions options;
    options.across = 6;
    options.along = 30;
    return triangulated(make_bar(options));
}

// Splits every `stride`-th face into three at a point that all but touches one of its sides.
Mesh with_slivers(const Mesh& mesh, Index stride, double height) {
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    FaceList faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto t = mesh.topology().face(f);
        if (f % stride != 0) {
            faces.add(std::vector<Index>(t.begin(), t.end()));
            continue;
        }
        const auto added = static_cast<Index>(positions.size());
        positions.push_back((0.6 - height) * mesh.position(t[0]) + 0.4 * mesh.position(t[1]) +
                            height * mesh.position(t[2]));
        for (int k = 0; k < 3; ++k) faces.add({t[k], t[(k + 1) % 3], added});
    }
    return {positions, faces};
}

// Parts beside each other in one mesh; handles are added by the tests.
Mesh beside(const std::vector<Mesh>& parts, double distance) {
    std::vector<Vec3> positions;
    FaceList faces;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto first = static_cast<Index>(positions.size());
        for (const Vec3& p : parts[i].positions())
            positions.push_back(p + Vec3(distance * static_cast<double>(i), 0, 0));
        for (Index f = 0; f < parts[i].face_count(); ++f) {
            std::vector<Index> face;
            for (const Index v : parts[i].topology().face(f)) face.push_back(first + v);
            faces.add(face);
        }
    }
    return {positions, faces};
}

// Root mean square.
double mean_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.size()));
}

double max_height(const std::vector<Vec3>& points) {
    double greatest = 0.0;
    for (const Vec3& p : points) greatest = std::max(greatest, std::abs(p.y()));
    return greatest;
}

std::vector<SecondSystem> second_systems() {
    return {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson};
}

}  // namespace

TEST_CASE("slivers: a few hardly change the shape around them") {
    for (const bool flat : {true, false}) {
        const Scene plain = make_scene(flat ? bar() : triangulated(make_torus()));
        Edit reference = make_edit(plain);
        const Affine move = bend(plain, reference.deformer.handle(reference.high).center);
        reference.deformer.set_transform(reference.high, move);
        const std::vector<Vec3> expected = reference.deformer.solve();
        for (const double height : {1e-2, 1e-4, 1e-7}) {
            CAPTURE(height);
            const Scene scene = make_scene(with_slivers(plain.mesh, 37, height));
            Edit edit = make_edit(scene);
            edit.deformer.set_transform(edit.high, move);
            std::vector<Vec3> got = edit.deformer.solve();
            CHECK(all_finite(got));
            CHECK(max_distance(edit.deformer.solve(FrameQuality::preview),
                               solve_first_directly(edit.deformer)) < 1e-11 * scene.size);
            got.resize(expected.size());
            CHECK(mean_distance(got, expected) < 0.03 * plain.size);
            CHECK(max_distance(got, expected) < 0.15 * plain.size);
        }
    }
}

TEST_CASE("obtuse triangles: sheared rows of them bend as regular ones do") {
    for (const double shear : {3.0, 10.0, 30.0}) {
        CAPTURE(shear);
        Mesh grid = triangulated(make_grid({{4.0, 1.0}, {40, 10}}));
        // Rows of vertices slide along their own direction, more the farther they are.
        for (Index v = 0; v < grid.vertex_count(); ++v) {
            Vec3 p = grid.position(v);
            p.x() += 0.2 * p.x() * std::sin(shear * p.z());
            p.y() = 0.1 * std::sin(3.0 * p.x());
            grid.set_position(v, p);
        }
        const Scene scene = make_scene(grid);
        for (const SecondSystem second : second_systems()) {
            DeformOptions options;
            options.second = second;
            Edit edit = make_edit(scene, options);
            edit.deformer.set_transform(edit.high,
                                        bend(scene, edit.deformer.handle(edit.high).center));
            CHECK(all_finite(edit.deformer.solve()));
            CHECK(max_distance(edit.deformer.solve(), rest_positions_of(edit.deformer)) <
                  2.0 * scene.size);
        }
    }
}

TEST_CASE("planes: where every vertex is degenerate, the sheet follows in and out of its plane") {
    const Scene scene = make_scene(make_grid({{4.0, 1.0}, {32, 8}}));
    for (const SecondSystem second : second_systems()) {
        DeformOptions options;
        options.second = second;
        Edit edit = make_edit(scene, options);
        Deformer& d = edit.deformer;
        CHECK(d.solve() == rest_positions_of(d));
        // Turned, moved and stretched in its plane, it stays there, but for what the displacement
        // of degenerate vertices leaves in their rotations.
        for (const Affine& map :
             {rotation(Vec3::UnitY(), 0.6, d.handle(edit.high).center), translation({0.5, 0, 0.3}),
              scaling({1.3, 1.3, 1.3}, d.handle(edit.high).center)}) {
            d.set_transform(edit.high, map);
            CHECK(max_height(d.solve(FrameQuality::preview)) < 1e-3 * scene.size);
            CHECK(max_height(d.solve()) < 1e-2 * scene.size);
        }
        d.set_transform(edit.high, translation({-0.5, 1.5, 0.0}) *
                                       rotation(Vec3::UnitZ(), 1.0, d.handle(edit.high).center));
        CHECK(all_finite(d.solve()));
        CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
              1e-11 * scene.size);
    }
}

TEST_CASE("several parts in one region: the error names the one that nothing holds, with all ids") {
    const Mesh torus = make_torus();
    const Index n = torus.vertex_count();
    const Mesh mesh = beside({torus, torus, torus}, 5.0);
    Deformer d(mesh, Region::all(mesh.shared_topology()));
    const HandleId first = d.add_handle({mesh.shared_topology(), {0, 1, 2}});
    d.add_handle({mesh.shared_topology(), {2 * n, 2 * n + 1}});
    d.set_transform(first, translation({1, 0, 0}));
    const Error error = error_of([&] { d.solve(); });
    CHECK(error.code() == ErrorCode::unconstrained);
    CHECK(error.elements().kind == ElementKind::vertex);
    CHECK(error.elements().count == static_cast<std::size_t>(n));
    CHECK(error.elements().ids.front() == n);
    CHECK(std::is_sorted(error.elements().ids.begin(), error.elements().ids.end()));
    for (const Index v : error.elements().ids) CHECK((v >= n && v < 2 * n));
    CHECK(error.message().find("vertices " + std::to_string(n)) != std::string::npos);
    CHECK(d.positions() == rest_positions_of(d));

    // Held by any handle, it goes; a part that is only partly in the region is held by the rest.
    d.add_handle({mesh.shared_topology(), {n}});
    d.solve();
    CHECK(all_finite(d.positions()));
    std::vector<Index> some;
    for (Index v = 0; v < n + 5; ++v) some.push_back(v);
    Deformer partial(mesh, {mesh.shared_topology(), some});
    partial.set_transform(partial.add_handle({mesh.shared_topology(), {0, 1, 2}}),
                          translation({1, 0, 0}));
    CHECK(all_finite(partial.solve()));
}

TEST_CASE(
    "not manifold before repair: each part that it fell into needs a handle, and then bends") {
    // Three sheets that meet in one edge, and two fans that share one vertex.
    Soup soup;
    const Mesh grid = triangulated(make_grid({{2.0, 1.0}, {8, 4}}));
    for (const double angle : {0.0, 2.0, 4.0}) {
        const auto first = static_cast<Index>(soup.positions.size());
        const Affine turn = rotation(Vec3::UnitZ(), angle, Vec3::Zero());
        for (const Vec3& p : grid.positions()) soup.positions.push_back(turn(p + Vec3(1, 0, 0)));
        for (Index f = 0; f < grid.face_count(); ++f) {
            std::vector<Index> face;
            for (const Index v : grid.topology().face(f)) face.push_back(first + v);
            soup.faces.add(face);
        }
    }
    RepairOptions weld;
    weld.weld = Weld::all;
    const Mesh mesh = repair(soup, weld);
    const Scene scene = make_scene(mesh, 0.2);
    CHECK(mesh.vertex_count() >= 3 * 45 - 10);
    Deformer d(mesh, scene.all());
    CHECK(error_of([&] { d.solve(); }).code() == ErrorCode::unconstrained);
    std::vector<Index> far_ends;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).norm() > 1.7) far_ends.push_back(v);
    }
    const HandleId ends = d.add_handle(scene.region(far_ends));
    d.set_transform(ends, rotation(Vec3::UnitX(), 0.5, Vec3::Zero()));
    CHECK(all_finite(d.solve()));
}

TEST_CASE("hardly a mesh: whatever is held, a result or what is missing") {
    const auto mesh_of = [](std::vector<Vec3> positions, std::vector<std::vector<Index>> list) {
        FaceList faces;
        for (const auto& face : list) faces.add(face);
        return Mesh(std::move(positions), faces);
    };
    const std::vector<Mesh> meshes{
        mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}),
        mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}),
        mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}),
        mesh_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {-0.5, 1, 0}, {-1, 0, 0}, {9, 9, 9}},
                {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}),
        mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 1, 0}}, {{0, 1, 2, 3, 4}}),
        make_box()};
    int solved = 0, refused = 0;
    for (const Mesh& mesh : meshes) {
        const Index n = mesh.vertex_count();
        for (Index held = 0; held < n; ++held) {
            for (const bool gradient : {true, false}) {
                for (const SecondSystem second : second_systems()) {
                    DeformOptions options;
                    options.second = second;
                    Deformer d(mesh, Region::all(mesh.shared_topology()), options);
                    HandleOptions kind;
                    kind.gradient = gradient;
                    const HandleId handle = d.add_handle({mesh.shared_topology(), {held}}, kind);
                    d.set_transform(handle, translation({0.5, 0, 0}) *
                                                rotation({1, 2, 3}, 0.7, mesh.position(held)));
                    try {
                        d.solve();
                        CHECK(all_finite(d.positions()));
                        CHECK((d.positions()[held] - mesh.position(held) - Vec3(0.5, 0, 0)).norm() <
                              1e-12);
                        ++solved;
                    } catch (const Error& error) {
                        const bool expected = error.code() == ErrorCode::unconstrained ||
                                              error.code() == ErrorCode::zero_area;
                        CHECK_MESSAGE(expected, error.message());
                        CHECK(error.elements().count > 0);
                        ++refused;
                    }
                }
            }
        }
    }
    CHECK(solved > 0);
    CHECK(refused > 0);
}
