#include "kernel/mesh/resample/remesh.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string_view>

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

double smallest_angle(const Mesh& mesh) {
    double smallest = kPi;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> v = mesh.topology().face(f);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.position(v[k]);
            const Vec3 a = mesh.position(v[(k + 1) % 3]) - p, b = mesh.position(v[(k + 2) % 3]) - p;
            smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)));
        }
    }
    return smallest;
}

}  // namespace

TEST_CASE("remeshing makes edges of one length on the same surface") {
    const Mesh sphere = make_sphere({.segments = 24});
    for (const double part : {0.08, 0.2}) {
        const double edge = part * surface_radius(sphere);
        const Mesh even = remesh(sphere, {.edge = edge}).mesh;
        CHECK(even.topology().is_closed());
        CHECK(euler_characteristic(even.topology()) == 2);
        CHECK(mean_edge_length(even) == Approx(edge).epsilon(0.15));
        CHECK(smallest_angle(even) > 25.0 * kDegree);
        CHECK(volume(even) == Approx(volume(sphere)).epsilon(part * part / 2.0));
        CHECK(self_intersections(even).empty());
        const SpatialTree tree(sphere);
        for (const Vec3& p : even.positions()) {
            CHECK(tree.nearest(p).distance < 1e-9 * surface_radius(sphere));
        }
    }
}

TEST_CASE("creases and corners stay to rounding") {
    const Mesh box = make_box({.size = {1, 2, 3}});
    const Mesh even = remesh(box, {.edge = 0.25}).mesh;
    CHECK(volume(even) == Approx(6.0).epsilon(1e-9));
    CHECK(area(even) == Approx(22.0).epsilon(1e-9));
    CHECK(smallest_angle(even) > 15.0 * kDegree);
    const Mesh grid = make_grid({.segments = {10, 4}});
    CHECK(area(remesh(grid).mesh) == Approx(area(grid)).epsilon(1e-9));
}

TEST_CASE("edges adapt to the curvature") {
    const Mesh torus = make_torus({.segments = 96, .tube_segments = 48});
    const double size = surface_radius(torus);
    const Mesh even = remesh(torus, {.edge = 0.4 * size}).mesh;
    const Mesh adapted = remesh(torus, {.edge = 0.4 * size, .error = 0.002 * size}).mesh;
    CHECK(adapted.face_count() > even.face_count());
    CHECK(std::abs(volume(adapted) - volume(torus)) < 0.5 * std::abs(volume(even) - volume(torus)));
}

TEST_CASE("remeshing carries what the mesh holds, and stays in its region") {
    Mesh mesh = make_sphere({.segments = 12});
    triangulate(mesh);
    Attribute height{"height", Domain::vertex, 1, ScalarType::float64, {}};
    for (const Vec3& p : mesh.positions()) height.values.push_back(p.y());
    mesh.attributes().add(std::move(height));
    std::vector<Index> half;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).x() > 0.0) half.push_back(v);
    }
    const Region region(mesh.shared_topology(), half);
    mesh.set_region("half", region);
    const RemeshResult made = remesh(mesh, {.edge = 0.05, .region = region});
    const Attribute& values = *made.mesh.attributes().find("height");
    for (Index v = 0; v < made.mesh.vertex_count(); ++v) {
        CHECK(values.at(v)[0] == Approx(made.mesh.position(v).y()).epsilon(1e-6));
    }
    std::size_t outside = 0, old_outside = 0;
    const std::vector<char> in = region.mask();
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.topology().face(f);
        old_outside +=
            std::all_of(face.begin(), face.end(), [&](Index v) { return in[at(v)]; }) ? 0 : 1;
    }
    const std::vector<Index> inner = made.mesh.region("half").faces();
    outside = at(made.mesh.face_count()) - inner.size();
    CHECK(outside == old_outside);
    CHECK(inner.size() > region.faces().size());
}

TEST_CASE("remeshing refuses lengths that are none") {
    const Mesh box = make_box();
    CHECK_THROWS_AS(remesh(box, {.edge = 0.0}), Error);
    CHECK_THROWS_AS(remesh(box, {.edge = test::kNaN}), Error);
    CHECK_THROWS_AS(remesh(box, {.error = -1.0}), Error);
    CHECK_THROWS_AS(remesh(box, {.edge = 1.0, .shortest = 2.0}), Error);
    CHECK_THROWS_AS(remesh(box, {.edge = 1e-6}), Error);
    CHECK(remesh(Mesh()).mesh.vertex_count() == 0);
}

TEST_CASE("remeshing refuses lengths beyond the mesh, and more faces than it can hold at once") {
    const Mesh box = make_box();
    const double size = bounds(box).diagonal();
    CHECK_THROWS_AS(remesh(box, {.edge = 1.01 * size}), Error);
    CHECK(remesh(box, {.edge = 0.9 * size}).mesh.topology().is_closed());
    CHECK_THROWS_AS(remesh(box, {.error = 0.1, .shortest = 1.01 * size}), Error);
    for (const double edge : {1e-4, 1e-30}) {
        try {
            remesh(box, {.edge = edge});
            FAIL("it was remeshed");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::out_of_range);
        }
    }
    // A thin triangle asks for as many faces as its length has edges.
    FaceList faces;
    faces.add({0, 1, 2});
    const Mesh thin({{0, 0, 0}, {1, 0, 0}, {1, 1e-12, 0}}, std::move(faces));
    CHECK_THROWS_AS(remesh(thin, {.edge = 1e-8}), Error);
    // Edges that are short where they adapt only do not count everywhere.
    const Mesh sphere = make_sphere();
    CHECK(remesh(sphere, {.error = 0.05 * size, .shortest = 1e-5 * size}).mesh.face_count() > 0);
}

TEST_CASE("remeshing is cancelled within a round, not after it") {
    using Clock = std::chrono::steady_clock;
    const Mesh sphere = make_sphere({.segments = 24});
    const RemeshOptions options{.edge = 0.012 * surface_radius(sphere), .iterations = 1};
    const auto start = Clock::now();
    remesh(sphere, options);
    const auto whole = Clock::now() - start;
    // It is cancelled at the first progress, before the round.
    std::optional<Context> context;
    ContextOptions settings;
    settings.progress = [&](std::string_view, double) { context->cancel(); };
    context.emplace(settings);
    const auto begin = Clock::now();
    CHECK(test::error_of([&] { remesh(sphere, options, *context); }).code() ==
          ErrorCode::cancelled);
    CHECK(4 * (Clock::now() - begin) < whole);
}
