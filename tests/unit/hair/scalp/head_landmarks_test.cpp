// Landmarks of heads: pairs of spots as eyes are, and the greatest opening.

#include "kernel/hair/scalp/head_landmarks.h"

#include <numeric>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;

namespace {

struct Ball {
    Vec3 center;
    double radius;
};

// A large ball, and small ones beside it.
Mesh with_balls(const std::vector<Ball>& balls) {
    std::vector<Vec3> positions;
    FaceList faces;
    const auto add = [&](const Ball& ball, Index segments) {
        const Mesh mesh = make_sphere({.radius = ball.radius, .segments = segments});
        const auto first = static_cast<Index>(positions.size());
        for (const Vec3& p : mesh.positions()) positions.push_back(ball.center + p);
        for (Index f = 0; f < mesh.face_count(); ++f) {
            std::vector<Index> corners(mesh.topology().face(f).begin(),
                                       mesh.topology().face(f).end());
            for (Index& corner : corners) corner += first;
            faces.add(corners);
        }
    };
    add({Vec3::Zero(), 10.0}, 16);
    for (const Ball& ball : balls) add(ball, 6);
    return Mesh(std::move(positions), std::move(faces));
}

Landmarks landmarks(const Mesh& mesh) {
    const std::vector<Index> part = largest_component(mesh);
    const std::vector<double> areas = face_areas(mesh);
    return landmarks_of(mesh, part, std::accumulate(areas.begin(), areas.end(), 0.0));
}

}  // namespace

TEST_CASE("landmarks: two spots are a pair where they are alike and as far apart as eyes are") {
    // The distance in mean radii, and the ratio of both.
    for (const double apart : {2.5, 3.5, 6.0, 8.5, 9.5}) {
        for (const double ratio : {0.7, 0.85, 1.0, 1.2, 1.4}) {
            CAPTURE(apart);
            CAPTURE(ratio);
            const double mean = 0.5 * (1.0 + ratio);
            const Landmarks found =
                landmarks(with_balls({{Vec3(20, 0, 0), 1.0}, {Vec3(20, apart * mean, 0), ratio}}));
            const bool alike = ratio > 0.8 && ratio<1.25, eyes = apart> 3.0 && apart < 9.0;
            REQUIRE(found.pairs.size() == (alike && eyes ? 1u : 0u));
            if (found.pairs.empty()) continue;
            const EyePair& pair = found.pairs.front();
            CHECK((pair.one.center - pair.other.center).norm() ==
                  doctest::Approx(apart * mean).epsilon(1e-6));
            CHECK(std::min(pair.one.radius, pair.other.radius) ==
                  doctest::Approx(std::min(1.0, ratio)));
        }
    }
}

TEST_CASE("landmarks: of many spots every pair is looked at once") {
    std::vector<Ball> row;
    for (int k = 0; k < 5; ++k) row.push_back({Vec3(20, 4.0 * k, 0), 1.0});
    // Neighbours, and those two apart.
    CHECK(landmarks(with_balls(row)).pairs.size() == 4 + 3);
    CHECK(landmarks(with_balls({})).pairs.empty());
}

TEST_CASE("landmarks: the greatest opening, and the way from it to the surface") {
    const Mesh ball = make_sphere({.radius = 2.0, .segments = 24});
    for (const double height : {-1.8, -1.0, 0.0}) {
        FaceList faces;
        std::vector<Vec3> positions(ball.positions().begin(), ball.positions().end());
        for (Index f = 0; f < ball.face_count(); ++f) {
            const auto face = ball.topology().face(f);
            if (std::all_of(face.begin(), face.end(),
                            [&](Index v) { return ball.position(v).y() > height; })) {
                faces.add(face);
            }
        }
        const Mesh open(positions, faces);
        const Landmarks found = landmarks(open);
        const auto& loop = open.topology().boundary_loops()[0];
        double length = 0.0, area = 0.0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            length += (open.position(loop[(i + 1) % loop.size()]) - open.position(loop[i])).norm();
        }
        for (const double a : face_areas(open)) area += a;
        const double opening = length / std::sqrt(area);
        if (opening > 1.0) {
            CHECK(found.opening == doctest::Approx(opening));
            CHECK((found.from_opening - Vec3::UnitY()).norm() < 0.05);
        } else {
            CHECK(found.opening == 0.0);
            CHECK(found.from_opening.isZero());
        }
    }
}
