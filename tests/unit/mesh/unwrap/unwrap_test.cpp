#include "kernel/mesh/unwrap/unwrap.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

// Triangles in the square, each with its chart: fans of the faces.
struct UnwrappedTriangle {
    Vec2 a, b, c;
    Index chart = 0;
};

std::vector<UnwrappedTriangle> triangles_of(const Mesh& mesh, const Unwrapping& made) {
    std::vector<UnwrappedTriangle> list;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::size_t first = at(mesh.topology().first_corner(f));
        for (std::size_t k = 2; k < mesh.topology().face(f).size(); ++k) {
            list.push_back(
                {made.uv[first], made.uv[first + k - 1], made.uv[first + k], made.chart[at(f)]});
        }
    }
    return list;
}

double side_of(const Vec2& a, const Vec2& b, const Vec2& p) {
    const Vec2 u = b - a, v = p - a;
    return u.x() * v.y() - u.y() * v.x();
}

bool holds_point(const UnwrappedTriangle& t, const Vec2& p) {
    return side_of(t.a, t.b, p) > 1e-9 && side_of(t.b, t.c, p) > 1e-9 &&
           side_of(t.c, t.a, p) > 1e-9;
}

// Every point of the square is covered once at most, and points of two charts are apart.
void check_unwrapping(const Mesh& mesh, const Unwrapping& made, double gap = 1.0 / 256.0) {
    REQUIRE(count_of(made.uv) == mesh.topology().corner_count());
    REQUIRE(count_of(made.chart) == mesh.face_count());
    CHECK(made.flipped.empty());
    for (const Vec2& p : made.uv) {
        CHECK(p.minCoeff() >= 0.0);
        CHECK(p.maxCoeff() <= 1.0);
    }
    const std::set<Index> charts(made.chart.begin(), made.chart.end());
    CHECK(count_of(charts) == made.chart_count);
    CHECK(*charts.rbegin() == made.chart_count - 1);
    const auto triangles = triangles_of(mesh, made);
    std::mt19937 generator(3);
    int doubled = 0, covered = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec2 p(generator() / 4294967296.0, generator() / 4294967296.0);
        int count = 0;
        for (const UnwrappedTriangle& t : triangles) count += holds_point(t, p) ? 1 : 0;
        doubled += count > 1 ? 1 : 0;
        covered += count > 0 ? 1 : 0;
    }
    CHECK(doubled == 0);
    CHECK(covered / 2000.0 == doctest::Approx(made.coverage).epsilon(0.1));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        for (std::size_t j = i + 1; j < triangles.size(); j += 2) {
            if (triangles[i].chart == triangles[j].chart) continue;
            nearest = std::min(nearest, (triangles[i].a - triangles[j].b).norm());
        }
    }
    CHECK(nearest >= 0.8 * gap);
}

Mesh moved(Mesh mesh, const Affine& map) {
    transform(mesh, map);
    return mesh;
}

Mesh open_tube() {
    return make_cylinder({.radius = 0.5, .height = 2.0, .caps = false});
}

TEST_CASE("unwrap: flat and unrolled surfaces are laid out as they are") {
    const Mesh grid = make_grid({});
    const Unwrapping flat = unwrap(grid);
    check_unwrapping(grid, flat);
    CHECK(flat.chart_count == 1);
    CHECK(flat.stretch == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(flat.seam_length == 0.0);
    CHECK(flat.coverage * flat.side * flat.side == doctest::Approx(area(grid)));
    const Mesh tube = open_tube();
    const Unwrapping unrolled = unwrap(tube);
    check_unwrapping(tube, unrolled);
    CHECK(unrolled.chart_count == 1);
    CHECK(unrolled.stretch == doctest::Approx(1.0).epsilon(1e-3));
    CHECK(unrolled.seam_length == doctest::Approx(2.0).epsilon(1e-6));
    const Mesh box = make_box();
    const Unwrapping cut = unwrap(box);
    check_unwrapping(box, cut);
    CHECK(cut.stretch == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(cut.chart_count <= 4);
}

TEST_CASE("unwrap: closed surfaces, handles, open ones and several parts") {
    Mesh two = make_sphere();
    append(two, moved(make_box(), translation({5.0, 0.0, 0.0})));
    for (const Mesh& mesh : {make_sphere(), make_sphere({.kind = SphereKind::triangles}),
                             make_torus(), make_cylinder(), make_bar(),
                             make_head({.vertices = 3000}), make_cactus({.vertices = 3000}), two}) {
        const Unwrapping made = unwrap(mesh);
        check_unwrapping(mesh, made);
        CHECK(made.stretch < 1.3);
        CHECK(made.mean_stretch < made.stretch);
        CHECK(made.coverage > 0.35);
        CHECK(made.chart_count < 40);
        CHECK(made.seam_length > 0.0);
    }
}

TEST_CASE("unwrap: less stretch takes more charts") {
    const Mesh sphere = make_sphere({.segments = 32});
    Index before = 0;
    for (const double stretch : {2.0, 1.3, 1.1, 1.03}) {
        const Unwrapping made = unwrap(sphere, {.stretch = stretch});
        CHECK(made.stretch <= stretch);
        CHECK(made.chart_count >= before);
        before = made.chart_count;
    }
    CHECK(before > 6);
}

TEST_CASE("unwrap: seams keep to creases") {
    // Twelve edges of a fine box, of length 1: charts that end elsewhere have longer seams.
    const Mesh box = make_bar({.width = 1.0, .length = 1.0, .across = 12, .along = 12});
    const Unwrapping made = unwrap(box, {.stretch = 1.05});
    double off = 0.0, on = 0.0;
    const Topology& topology = box.topology();
    for (Index e = 0; e < topology.edge_count(); ++e) {
        const auto [a, b] = topology.edge(e);
        Index first = kNoIndex, second = kNoIndex;
        for (const Index f : topology.faces_around(a)) {
            const auto face = topology.face(f);
            if (std::find(face.begin(), face.end(), b) == face.end()) continue;
            (first == kNoIndex ? first : second) = made.chart[at(f)];
        }
        if (first == second) continue;
        const Vec3 middle = 0.5 * (box.position(a) + box.position(b));
        int outer = 0;
        for (Index c = 0; c < 3; ++c) {
            const double low = bounds(box).min[c], high = bounds(box).max[c];
            outer += std::abs(middle[c] - low) < 1e-6 || std::abs(middle[c] - high) < 1e-6 ? 1 : 0;
        }
        (outer >= 2 ? on : off) += (box.position(a) - box.position(b)).norm();
    }
    CHECK(on > 0.0);
    CHECK(off < 0.15 * on);
}

TEST_CASE("unwrap: the gap is kept, and costs room") {
    const Mesh torus = make_torus();
    double before = 1.0;
    for (const double gap : {0.002, 0.01, 0.03}) {
        const Unwrapping made = unwrap(torus, {.stretch = 1.1, .gap = gap});
        check_unwrapping(torus, made, gap);
        CHECK(made.coverage < before);
        before = made.coverage;
    }
}

TEST_CASE("unwrap: place and size of the mesh do not matter, nor threads") {
    const Mesh head = make_head({.vertices = 3000});
    const Unwrapping here = unwrap(head);
    const Unwrapping far = unwrap(moved(head, translation({1e4, -2e4, 5e3})));
    CHECK(far.chart_count == here.chart_count);
    CHECK(far.chart == here.chart);
    const Unwrapping large = unwrap(moved(head, scaling(Vec3::Constant(64.0), Vec3::Zero())));
    CHECK(large.chart == here.chart);
    CHECK(large.side == doctest::Approx(64.0 * here.side).epsilon(1e-6));
    ContextOptions four;
    four.threads = 4;
    const Unwrapping threaded = unwrap(head, {}, Context(four));
    CHECK(threaded.uv == here.uv);
}

TEST_CASE("unwrap: faces without area are laid out too") {
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({1, 3, 2});
    faces.add({1, 4, 3});
    const Mesh thin({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0.5, 0}}, faces);
    const Unwrapping made = unwrap(thin);
    CHECK(count_of(made.uv) == 9);
    for (const Vec2& p : made.uv) CHECK(p.allFinite());
    FaceList lone;
    lone.add({0, 1, 2});
    const Mesh point({Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, lone);
    for (const Vec2& p : unwrap(point).uv) CHECK(p.allFinite());
}

TEST_CASE("unwrap: written coordinates take the place of old ones, bad input changes nothing") {
    Mesh box = make_box();
    const Unwrapping made = unwrap(box);
    write_unwrapping(box, made);
    write_unwrapping(box, made, "uv2");
    const Attribute* uv = box.attributes().find("uv");
    REQUIRE(uv);
    CHECK(uv->domain == Domain::corner);
    CHECK(uv->values[0] == made.uv[0].x());
    CHECK(error_of([&] { write_unwrapping(box, made, ""); }).code() == ErrorCode::invalid_argument);
    Mesh other = make_sphere();
    CHECK(error_of([&] { write_unwrapping(other, made); }).code() == ErrorCode::topology_mismatch);
    CHECK(error_of([&] { (void)unwrap(Mesh()); }).code() == ErrorCode::mesh_empty);
    const double inf = std::numeric_limits<double>::infinity();
    for (const UnwrapOptions& bad :
         {UnwrapOptions{.stretch = 1.0}, UnwrapOptions{.stretch = inf},
          UnwrapOptions{.crease = -1.0}, UnwrapOptions{.gap = 0.0}, UnwrapOptions{.gap = 0.5}}) {
        CHECK(error_of([&] { (void)unwrap(box, bad); }).code() == ErrorCode::invalid_argument);
    }
    ContextOptions small;
    small.memory_limit = 1000;
    CHECK(error_of([&] { (void)unwrap(box, {}, Context(small)); }).code() ==
          ErrorCode::memory_limit);
    Context cancelled;
    cancelled.cancel();
    CHECK(error_of([&] { (void)unwrap(box, {}, cancelled); }).code() == ErrorCode::cancelled);
}

}  // namespace
}  // namespace lissom::test
