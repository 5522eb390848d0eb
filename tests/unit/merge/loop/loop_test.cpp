#include "kernel/merge/loop/loop.h"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include <cmath>
#include <numeric>

#include "kernel/core/error.h"
#include "kernel/merge/loop/loop_values.h"
#include "kernel/mesh/measure/triangulation.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

std::vector<Index> ascending(Index count) {
    std::vector<Index> ids(static_cast<std::size_t>(count));
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
}

// A tube whose vertices crowd on one side, bent out of round.
Mesh uneven_tube(Index count) {
    return tube(count, 4, [](double angle, double height) {
        const double a = angle + 0.6 * std::sin(angle);
        return Vec3(1.3 * std::cos(a), std::sin(a), height + 0.2 * std::sin(2.0 * a + 1.0));
    });
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

TEST_CASE("parameters of a loop ascend, even where it runs to and fro at one place") {
    for (const int width : {0, 10, 20}) {
        // Of 64 vertices some are at two places in turn, so that smoothing brings them together.
        const Mesh mesh = tube(64, 3, [=](double angle, double height) {
            const int k = static_cast<int>(std::lround(angle * 32 / kPi));
            const double a = k < width ? 0.0 : angle, r = k < width && k % 2 == 1 ? 9.0 : 1.0;
            return Vec3(r * std::cos(a), r * std::sin(a), height);
        });
        const Loop loop(mesh, ascending(64));
        const std::vector<double>& u = loop.parameters();
        CHECK(u.front() == 0.0);
        CHECK(u.back() < 1.0);
        for (std::size_t k = 1; k < u.size(); ++k) CHECK(u[k] > u[k - 1]);
    }
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

TEST_CASE("normals of a loop are the surface's at the loop, wherever a sphere is cut") {
    for (const double cut : {0.8, 1.2, 1.57, 2.0, 2.5}) {
        const Mesh mesh = tube(96, 13, [=](double angle, double height) {
            const double polar = cut - 0.6 * height;
            return Vec3(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                        std::cos(polar));
        });
        const Loop loop(mesh, ascending(96));
        for (const double sigma : {0.0, 0.015}) {
            const std::vector<Mat3> frames = loop.frames(sigma);
            // The faces at the cut themselves lean by almost twice that.
            for (Index k = 0; k < 96; ++k) {
                CHECK((frames[k].col(1) - mesh.position(k)).norm() < 0.013);
            }
        }
    }
}

TEST_CASE("where a loop begins and which way it runs changes nothing but the sign of tangents") {
    const Index n = 60;
    const Mesh mesh = uneven_tube(n);
    std::vector<Index> later(n), back(n);
    for (Index k = 0; k < n; ++k) {
        later[k] = (k + 17) % n;
        back[k] = n - 1 - k;
    }
    const Loop loop(mesh, ascending(n)), turned(mesh, later), reversed(mesh, back);
    for (const double sigma : {0.0, 0.015, 0.1, 0.4}) {
        CAPTURE(sigma);
        const auto frames = loop.frames(sigma), other = turned.frames(sigma);
        const auto backwards = reversed.frames(sigma);
        for (Index k = 0; k < n; ++k) {
            CHECK((frames[later[k]] - other[k]).norm() < 1e-9);
            CHECK((frames[back[k]].col(0) + backwards[k].col(0)).norm() < 1e-9);
            CHECK((frames[back[k]].col(1) - backwards[k].col(1)).norm() < 1e-9);
        }
    }
    CHECK((loop.center() - turned.center()).norm() < 1e-12);
    CHECK((loop.axis() + reversed.axis()).norm() < 1e-9);
    CHECK(loop.mean_turn() == doctest::Approx(reversed.mean_turn()));
}

TEST_CASE("moments of a loop are exact: points on its edges add nothing, far away or near") {
    const std::vector<Vec3> corners{{0, 0, 0}, {3, 0, 0.5}, {4, 2, 0}, {1, 3, -0.5}, {-1, 1, 0}};
    const auto polygon = [&](Index split, const Vec3& place, double size) {
        return tube(5 * split, 2, [=](double angle, double height) {
            const auto k = std::lround(angle / (2.0 * kPi) * 5 * split);
            // Points gather at the beginning of each edge.
            const double t = std::pow(double(k % split) / split, 2.0);
            const Vec3 &a = corners[k / split % 5], &b = corners[(k / split + 1) % 5];
            return Vec3(place + size * (a + t * (b - a) + 3.0 * height * Vec3::UnitZ()));
        });
    };
    const Loop plain(polygon(1, Vec3::Zero(), 1.0), ascending(5));
    for (const Index split : {2, 9}) {
        for (const double size : {0.01, 1.0, 50.0}) {
            const Vec3 place = size * Vec3(300, -200, 100);
            const Mesh mesh = polygon(split, place, size);
            const Loop loop(mesh, ascending(5 * split));
            CHECK((loop.center() - place - size * plain.center()).norm() < 1e-9 * size);
            CHECK(loop.radius() == doctest::Approx(size * plain.radius()).epsilon(1e-9));
            CHECK(loop.length() == doctest::Approx(size * plain.length()).epsilon(1e-9));
            CHECK((loop.axis() - plain.axis()).norm() < 1e-9);
        }
    }
}

TEST_CASE("the nearest place of a loop is nearer than any sample of it, from anywhere") {
    const Mesh mesh = uneven_tube(60);
    const Loop loop(mesh, ascending(60));
    for (int i = 0; i < 200; ++i) {
        const Vec3 point(2.0 * std::sin(1.0 * i), 2.0 * std::cos(2.3 * i), std::sin(3.7 * i));
        double distance = 0.0;
        const LoopPoint place = loop.nearest(point, distance);
        CHECK((point_of(loop.points(), place) - point).norm() == doctest::Approx(distance));
        for (Index k = 0; k < 60; ++k) {
            for (const double t : {0.0, 0.3, 0.5, 0.8}) {
                const Vec3 sample = point_of(loop.points(), {k, t});
                CHECK((sample - point).norm() >= distance - 1e-12);
            }
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

TEST_CASE("a raw loop is measured as it is: its own arc length, and the normals of its faces") {
    const Mesh mesh = tube(90, 4, [](double angle, double height) {
        // A row of teeth, on a cone that curves.
        const double tooth = height == 0.0 ? 0.02 * std::cos(45.0 * angle) : 0.0;
        const double r = 1.0 + 0.3 * height * height + tooth;
        return Vec3(r * std::cos(angle), 0.7 * r * std::sin(angle), height + tooth);
    });
    const Loop raw(mesh, ascending(90), LoopMeasure::raw), robust(mesh, ascending(90));
    double arc = 0.0, apart = 0.0;
    for (Index k = 0; k < 90; ++k) {
        CHECK(raw.parameters()[k] == doctest::Approx(arc / raw.length()));
        apart = std::max(apart, std::abs(raw.parameters()[k] - robust.parameters()[k]));
        arc += (mesh.position((k + 1) % 90) - mesh.position(k)).norm();
        // Each face counts by its angle, and there are no others.
        Vec3 normal = Vec3::Zero();
        const Triangulation around =
            triangulate_faces(mesh.topology(), mesh.positions(), mesh.topology().faces_around(k));
        for (const Triangle& t : around.triangles) {
            for (std::size_t c = 0; c < 3; ++c) {
                if (t[c] != k) continue;
                const Vec3 a = mesh.position(t[(c + 1) % 3]) - mesh.position(k);
                const Vec3 b = mesh.position(t[(c + 2) % 3]) - mesh.position(k);
                normal += std::atan2(a.cross(b).norm(), a.dot(b)) * a.cross(b).normalized();
            }
        }
        const Mat3 frame = raw.frames(0.0)[k];
        const Vec3 tangent = frame.col(0);
        normal -= normal.dot(tangent) * tangent;
        CHECK((frame.col(1) - normal.normalized()).norm() < 1e-9);
    }
    CHECK(apart > 1e-4);
    CHECK((raw.frames(0.0)[7].col(1) - robust.frames(0.0)[7].col(1)).norm() > 1e-3);
    const Loop same = raw.renumbered(std::vector<Index>(90, 5));
    CHECK(same.vertices().front() == 5);
    CHECK(same.parameters() == raw.parameters());
}
