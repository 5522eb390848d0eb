// Soft handles and constraints: a weight draws to where a hard one holds.

#include <Eigen/Geometry>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/first_solution.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/deform/stats.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene soft_bar(Index across = 4, double size = 1.0) {
    BarOptions options;
    options.width = size;
    options.length = 5.0 * size;
    options.across = across;
    options.along = 5 * across;
    return make_scene(make_bar(options));
}

HandleOptions weighted(double weight) {
    HandleOptions options;
    options.weight = weight;
    return options;
}

// How far a soft handle, which is asked to move sideways by the size, stays behind: 0 is there.
double shortfall(const Scene& scene, const HandleOptions& handle, const DeformOptions& options = {},
                 bool preview = false) {
    Deformer d(scene.mesh, scene.all(), options);
    d.add_handle(scene.region(scene.low));
    const HandleId high = d.add_handle(scene.region(scene.high), handle);
    d.set_transform(high, translation(scene.size * scene.across));
    const std::vector<Vec3>& x = preview ? d.solve(FrameQuality::preview) : d.solve();
    double sum = 0.0;
    for (const Index v : scene.high) sum += (x[v] - scene.mesh.position(v)).dot(scene.across);
    return 1.0 - sum / (scene.size * static_cast<double>(scene.high.size()));
}

}  // namespace

TEST_CASE("weights: 1 is a compromise, more come nearer, 1e6 is nearly hard") {
    const Scene scene = soft_bar();
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::poisson, SecondSystem::laplacian}) {
        DeformOptions options;
        options.second = second;
        double before = 1.0;
        for (const double weight : {1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
            const double now = shortfall(scene, weighted(weight), options);
            CHECK(now < before);
            before = now;
        }
        CHECK(before < 1e-4);
        CHECK(before > 0.0);
        CHECK(shortfall(scene, weighted(1.0), options) > 0.1);
        CHECK(shortfall(scene, weighted(1.0), options) < 0.9);
    }
    CHECK(shortfall(scene, {}) < 1e-14);
}

TEST_CASE("weights: a real mesh feels them alike") {
    for (const char* name : {"cactus_cinolib.off", "lion.off", "dinosaur.obj"}) {
        const auto path = data_file(std::string("models/") + name);
        if (!path) continue;
        const Scene scene = make_scene(load_mesh(*path));
        CAPTURE(name);
        CHECK(shortfall(scene, weighted(1.0)) > 0.1);
        CHECK(shortfall(scene, weighted(1.0)) < 0.9);
        CHECK(shortfall(scene, weighted(1e6)) < 1e-4);
    }
}

TEST_CASE("weights: neither scale nor resolution changes what they do") {
    const double weight = 2.0;
    for (const bool preview : {false, true}) {
        const double plain = shortfall(soft_bar(), weighted(weight), {}, preview);
        CHECK(std::abs(shortfall(soft_bar(4, 1e3), weighted(weight), {}, preview) - plain) < 1e-9);
        const double fine = shortfall(soft_bar(12), weighted(weight), {}, preview);
        CHECK(std::abs(shortfall(soft_bar(24), weighted(weight), {}, preview) - fine) <
              0.05 * fine);
    }
}

TEST_CASE("soft handles: similarities of everything are exact") {
    const Scene scene = soft_bar();
    DeformOptions options;
    options.local_size = LocalSize::scale;
    for (const bool both_soft : {false, true}) {
        Deformer d(scene.mesh, scene.all(), options);
        const HandleId low =
            d.add_handle(scene.region(scene.low), both_soft ? weighted(3.0) : HandleOptions{});
        const HandleId high = d.add_handle(scene.region(scene.high), weighted(0.5));
        Affine map = rotation({1, 2, 3}, 1.4, {5, 0, 0});
        map.linear *= 1.7;
        d.set_transform(low, map);
        d.set_transform(high, map);
        const std::vector<Vec3> expected = mapped(rest_positions_of(d), map);
        CHECK(max_distance(d.solve(FrameQuality::preview), expected) < 1e-9 * scene.size);
        CHECK(max_distance(d.solve(), expected) < 1e-9 * scene.size);
        d.set_transform(low, {});
        d.set_transform(high, {});
        CHECK(d.solve() == rest_positions_of(d));
    }
}

TEST_CASE("soft handles: a preview before a solution changes no bit of it") {
    const Scene scene = soft_bar();
    for (const int refine : {0, 2}) {
        DeformOptions options;
        options.refine = refine;
        const auto solved = [&](bool preview) {
            Deformer d(scene.mesh, scene.all(), options);
            d.add_handle(scene.region(scene.low));
            const HandleId high = d.add_handle(scene.region(scene.high), weighted(2.0));
            d.set_transform(high, bend(scene, d.handle(high).center));
            if (preview) d.solve(FrameQuality::preview);
            return d.solve();
        };
        CHECK(solved(false) == solved(true));
    }
}

TEST_CASE("soft handles: the basis is the direct solution, and linear in their transforms") {
    const Scene scene = soft_bar();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    const HandleId high = d.add_handle(scene.region(scene.high), weighted(2.0));
    const Affine move = bend(scene, d.handle(high).center);
    d.set_transform(high, move);
    const std::vector<Vec3> x = d.solve(FrameQuality::preview);
    CHECK(max_distance(x, solve_first_directly(d)) < 1e-11 * scene.size);

    const HandleBasis basis = basis_of(d);
    REQUIRE(basis.handles.size() == 2);
    double worst = 0.0;
    for (std::size_t row = 0; row < x.size(); ++row) {
        Vec3 at = basis.fixed[row];
        for (std::size_t h = 0; h < 2; ++h) {
            const Affine& t = d.pose(basis.handles[h]).transform;
            at += t.linear * basis.weights[h][row].head<3>() +
                  t.translation * basis.weights[h][row][3];
        }
        worst = std::max(worst, (at - x[row]).norm());
    }
    CHECK(worst < 1e-11 * scene.size);
}

TEST_CASE("soft handles: gradients alone turn the end some of the way") {
    const Scene scene = soft_bar();
    const auto turned = [&](double weight) {
        Deformer d(scene.mesh, scene.all());
        d.add_handle(scene.region(scene.low));
        HandleOptions options = weighted(weight);
        options.position = false;
        const HandleId high = d.add_handle(scene.region(scene.high), options);
        d.set_transform(high, rotation(Vec3::UnitX(), 0.8, d.handle(high).center));
        d.solve();
        return Eigen::AngleAxisd(gradients_of(d)[scene.high.back()]).angle();
    };
    CHECK(turned(0.5) > 0.1);
    CHECK(turned(0.5) < 0.7);
    CHECK(turned(50.0) > turned(0.5));
    CHECK(turned(1e6) == doctest::Approx(0.8).epsilon(1e-3));
}

TEST_CASE("soft constraints: a vertex is drawn, and is free again when they go") {
    const Scene scene = soft_bar();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low));
    const Index tip = scene.high.back();
    const Vec3 target = scene.mesh.position(tip) + Vec3(1.0, 0.0, 0.0);
    const auto distance = [&](double weight) {
        d.constrain(VertexConstraint{tip, target, {}, weight});
        return (d.solve()[tip] - target).norm();
    };
    CHECK(distance(0.1) > 0.5);
    CHECK(distance(1.0) < 0.9);
    CHECK(distance(1e6) < 1e-4);
    CHECK(max_distance(d.solve(FrameQuality::preview), solve_first_directly(d)) <
          1e-11 * scene.size);

    // Another target of the same weight costs no factorisation; a hard one replaces it.
    const Index count = stats_of(d).factorizations;
    d.constrain(VertexConstraint{tip, target + Vec3(0, 0, 1), {}, 1e6});
    CHECK((d.solve()[tip] - target - Vec3(0, 0, 1)).norm() < 1e-4);
    CHECK(stats_of(d).factorizations == count);
    d.constrain(VertexConstraint{tip, target, {}});
    CHECK(d.solve()[tip] == target);
    d.constrain(VertexConstraint{tip, {}, {}});
    CHECK(d.solve() == rest_positions_of(d));
}

TEST_CASE("soft handles: they alone hold a surface") {
    const Scene scene = soft_bar();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.low), weighted(1.0));
    const Affine move = rotation(Vec3::UnitX(), 2.0, Vec3(0, 1, 0));
    d.set_transform(d.handles()[0], move);
    CHECK(max_distance(d.solve(), mapped(rest_positions_of(d), move)) < 1e-9 * scene.size);
}

TEST_CASE("weights: zero, negative and not finite ones are refused") {
    const Scene scene = soft_bar();
    Deformer d(scene.mesh, scene.all());
    for (const double weight : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        CHECK(error_of([&] { d.add_handle(scene.region(scene.low), weighted(weight)); }).code() ==
              ErrorCode::invalid_argument);
        CHECK(error_of([&] {
                  d.constrain(VertexConstraint{scene.high[0], Vec3(0, 0, 0), {}, weight});
              }).code() == ErrorCode::invalid_argument);
    }
    CHECK(d.handles().empty());
}

TEST_CASE("soft handles: a vertex has one handle, hard or soft") {
    const Scene scene = soft_bar();
    Deformer d(scene.mesh, scene.all());
    d.add_handle(scene.region(scene.high), weighted(1.0));
    CHECK(error_of([&] { d.add_handle(scene.region({scene.high[0]})); }).code() ==
          ErrorCode::handle_overlap);
    d.constrain(VertexConstraint{scene.low[0], Vec3(0, 0, 0), {}, 1.0});
    CHECK(error_of([&] { d.add_handle(scene.region(scene.low)); }).code() ==
          ErrorCode::handle_overlap);
}
