#include "kernel/merge/loop/loop.h"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include <cmath>
#include <numeric>

#include "kernel/core/error.h"
#include "kernel/merge/loop/loop_values.h"
#include "tests/unit/merge/loop/loop_shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

std::vector<Index> ascending(Index count) {
    std::vector<Index> ids(static_cast<std::size_t>(count));
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
}

}  // namespace

TEST_CASE("moments of a loop are those of its curve, however its vertices are spread") {
    // Half of the circle has nine times as many vertices as the other.
    const Mesh mesh = tube(100, 3, [](double angle, double height) {
        const double u = angle / (2.0 * kPi);
        const double a = u < 0.9 ? kPi * u / 0.9 : kPi + kPi * (u - 0.9) / 0.1;
        return Vec3(3.0 * std::cos(a), 3.0 * std::sin(a), height);
    });
    const Loop loop(mesh, ascending(100));
    CHECK(loop.center().norm() < 0.06);
    CHECK(loop.radius() == doctest::Approx(3.0).epsilon(0.01));
    CHECK(loop.length() == doctest::Approx(6.0 * kPi).epsilon(0.01));
}

TEST_CASE("frames of a loop: along it, out of the surface, and the cross product of the two") {
    const Mesh mesh = round_tube(64, 5);
    const Loop loop(mesh, ascending(64));
    for (const double sigma : {0.0, 0.015}) {
        const std::vector<Mat3> frames = loop.frames(sigma);
        for (Index k = 0; k < 64; ++k) {
            const double a = 2.0 * kPi * k / 64;
            CHECK((frames[k].col(0) - Vec3(-std::sin(a), std::cos(a), 0)).norm() < 0.05);
            CHECK((frames[k].col(1) - Vec3(std::cos(a), std::sin(a), 0)).norm() < 0.05);
            CHECK(frames[k].determinant() == doctest::Approx(1.0));
        }
    }
}

TEST_CASE("parameters run from 0 to 1 and come back from places") {
    const Mesh mesh = round_tube(50, 3);
    const Loop loop(mesh, ascending(50));
    CHECK(loop.parameters().front() == 0.0);
    for (const double u : {0.0, 0.013, 0.5, 0.9999}) {
        CHECK(loop.parameter_of(loop.place_at(u)) == doctest::Approx(u).epsilon(1e-12));
        CHECK(loop.place_at(u + 3.0).segment == loop.place_at(u).segment);
    }
    double distance = 0.0;
    const LoopPoint near = loop.nearest(Vec3(0, 2, 0), distance);
    CHECK(distance == doctest::Approx(1.0).epsilon(0.01));
    CHECK(loop.parameter_of(near) == doctest::Approx(0.25).epsilon(0.01));
}

TEST_CASE("teeth do not lengthen a loop where it is measured") {
    const auto jagged = [](double amplitude) {
        return tube(200, 3, [=](double angle, double height) {
            const bool tooth = angle < kPi && std::lround(angle * 200 / (2 * kPi)) % 2 == 1;
            return Vec3(std::cos(angle), std::sin(angle),
                        height + (tooth && height == 0.0 ? amplitude : 0.0));
        });
    };
    const Mesh mesh = jagged(0.06);
    const Loop loop(mesh, ascending(200));
    // The toothed half takes two thirds of the true length.
    CHECK(loop.length() > 1.3 * 2.0 * kPi);
    CHECK(loop.parameters()[100] == doctest::Approx(0.5).epsilon(0.02));
    CHECK(loop.mean_turn() > 0.5);
    const Mesh smooth = jagged(0.0);
    CHECK(Loop(smooth, ascending(200)).mean_turn() == doctest::Approx(2.0 * kPi / 200));
    CHECK(loop_scale(loop, Loop(smooth, ascending(200))) == doctest::Approx(1.0).epsilon(0.03));
}

TEST_CASE("a loop without extent is refused") {
    const Mesh point = tube(4, 2, [](double angle, double height) {
        return Vec3(height * std::cos(angle), height * std::sin(angle), height);
    });
    CHECK_THROWS_AS(Loop(point, ascending(4)), Error);
    CHECK_THROWS_AS(Loop(point, {0, 1}), Error);
}

TEST_CASE("values at a boundary are those of the similarity that moved it") {
    const Mesh source = tube(40, 4, [](double angle, double height) {
        return Vec3((1.0 + 0.2 * std::cos(3.0 * angle)) * std::cos(angle), std::sin(angle),
                    2.0 * height + 0.1 * std::sin(2.0 * angle));
    });
    const Affine turn = rotation(Vec3(1, 2, 3), 1.1, Vec3::Zero());
    Mesh target = source;
    for (Vec3& p : target.edit_positions()) p = 2.5 * (turn(p)) + Vec3(5, 6, 7);
    const Loop from(source, ascending(40)), to(target, ascending(40));
    LoopPair pair{from.vertices(), to.vertices(), {}, {}};
    for (Index k = 0; k < 40; ++k) {
        pair.on_target.push_back({k, 0.0});
        pair.on_source.push_back({k, 0.0});
    }
    LoopValueOptions thesis;
    thesis.sigma = 0.0;
    thesis.tangent_scales = true;
    for (const LoopValueOptions& how : {LoopValueOptions{}, thesis}) {
        for (const BoundaryValue& value : loop_values(from, to, pair, how)) {
            CHECK((value.rotation - turn.linear).norm() < 1e-9);
            CHECK(value.scale == doctest::Approx(2.5).epsilon(1e-9));
        }
    }
}
