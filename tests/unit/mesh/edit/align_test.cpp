#include "kernel/mesh/edit/align.h"

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

Affine near_placement(double scale) {
    return translation(Vec3(0.05, -0.04, 0.06)) * scaling(Vec3::Constant(scale), Vec3::Zero()) *
           rotation(Vec3(1, 2, 3).normalized(), 15.0 * kDegree, Vec3::Zero());
}

}  // namespace

TEST_CASE("a moved copy comes back onto its original") {
    const Mesh cactus = make_cactus({.vertices = 3000});
    Mesh moved = cactus;
    transform(moved, near_placement(1.0));
    const AlignReport report = align(moved, cactus);
    CHECK(report.scale == 1.0);
    CHECK(report.residual < 1e-4 * report.residual_before);
    transform(moved, report.transform);
    for (Index v = 0; v < cactus.vertex_count(); ++v) {
        CHECK((moved.position(v) - cactus.position(v)).norm() < 1e-4 * surface_radius(cactus));
    }
}

TEST_CASE("the scale is found, and does not shrink the mesh into a part of the target") {
    const Mesh cactus = make_cactus({.vertices = 3000});
    for (const double scale : {0.8, 1.25}) {
        Mesh moved = cactus;
        transform(moved, near_placement(scale));
        const AlignReport report = align(moved, cactus, {.scale = true});
        CHECK(report.scale == Approx(1.0 / scale).epsilon(1e-4));
        CHECK(report.residual < 1e-4 * surface_radius(cactus));
    }
}

TEST_CASE("axes find any place, size and turn") {
    test::Random random(7);
    const Mesh cactus = make_cactus({.vertices = 3000});
    for (int i = 0; i < 4; ++i) {
        Mesh moved = cactus;
        transform(moved, test::similarity(random, 2.5));
        const AlignReport report = align(moved, cactus, {.start = AlignStart::axes, .scale = true});
        CHECK(report.scale == Approx(0.4).epsilon(1e-3));
        CHECK(report.residual < 1e-3 * surface_radius(cactus));
    }
}

TEST_CASE("a part is put onto the whole if it says how much they share") {
    const Mesh cactus = make_cactus({.vertices = 3000});
    std::vector<Index> upper;
    for (Index v = 0; v < cactus.vertex_count(); ++v) {
        if (cactus.position(v).y() > 0.3) upper.push_back(v);
    }
    Mesh part = extract(cactus, Region(cactus.shared_topology(), upper)).mesh;
    transform(part, translation(Vec3(0.02, 0.01, -0.02)));
    const AlignReport report = align(part, cactus, {.overlap = 0.6});
    CHECK(report.residual < 1e-3 * surface_radius(cactus));
    CHECK((report.transform.translation - Vec3(-0.02, -0.01, 0.02)).norm() < 1e-2);
}

TEST_CASE("alignment refuses surfaces without faces and options out of range") {
    const Mesh box = make_box();
    CHECK_THROWS_AS(align(box, Mesh()), Error);
    const std::vector<Vec3> line{{0, 0, 0}, {0.1, 0.2, 0.3}, {0.7, 1.4, 2.1}};
    FaceList faces;
    faces.add({0, 1, 2});
    CHECK_THROWS_AS(align(box, Mesh(std::vector<Vec3>(line), FaceList(faces))), Error);
    CHECK_THROWS_AS(align(Mesh(std::vector<Vec3>(3, Vec3(1, 1, 1)), FaceList(faces)), box), Error);
    CHECK_THROWS_AS(align(box, box, {.overlap = 0.0}), Error);
    CHECK_THROWS_AS(align(box, box, {.samples = 1}), Error);
    CHECK_THROWS_AS(align(box, box, {.iterations = -1}), Error);
    const AlignReport still = align(box, box);
    CHECK(still.residual == 0.0);
    CHECK(still.converged);
}
