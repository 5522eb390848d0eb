#include "kernel/hair/strands/strand_selection.h"

#include <random>

#include "kernel/hair/curve/curve_foot.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Straight strands from (k, 0, 0) to (k, 1, 0).
Strands row(int count) {
    std::vector<float> points;
    std::vector<Index> offsets{0};
    for (int k = 0; k < count; ++k) {
        const auto x = static_cast<float>(k);
        points.insert(points.end(), {x, 0, 0, x, 1, 0});
        offsets.push_back(2 * (k + 1));
    }
    return {points, offsets};
}

}  // namespace

TEST_CASE("selection: distances of segments are those of dense samples") {
    test::RandomPoints random(7);
    const Box box{Vec3::Constant(-1.0), Vec3::Constant(1.0)};
    for (int round = 0; round < 200; ++round) {
        const Vec3 a = random.in_box(box), b = round % 10 == 0 ? a : random.in_box(box),
                   c = random.in_box(box),
                   d = round % 7 == 0 ? Vec3(c + 0.5 * (b - a) + Vec3(0, 0, round % 2 ? 0 : 1e-3))
                                      : random.in_box(box);
        REQUIRE(c != d);
        double least = 10.0;
        const std::vector<Vec3> curve{c, d};
        for (int k = 0; k <= 400; ++k) {
            least = std::min(least, foot_on_curve(curve, a + k / 400.0 * (b - a)).distance);
        }
        const double distance = segment_distance(a, b, c, d);
        CHECK(distance <= least + 1e-12);
        CHECK(distance > least - 0.01);
    }
}

TEST_CASE("selection: strands near a curve, also where only their middles are") {
    const Strands strands = row(10);
    const std::vector<Vec3> curve{{1.6, 0.5, 0.2}, {4.4, 0.5, 0.2}};
    CHECK(strands_near_curve(strands, curve, 0.21) == std::vector<Index>{2, 3, 4});
    CHECK(strands_near_curve(strands, curve, 0.19).empty());
    CHECK(strands_near_curve(strands, curve, 0.7) == std::vector<Index>{1, 2, 3, 4, 5});
    CHECK(strands_near_curve(strands, curve, 0.7, test::threads(2)) ==
          std::vector<Index>{1, 2, 3, 4, 5});
    CHECK(strands_near_curve(Strands(), curve, 1.0).empty());
    CHECK(strands_near_curve(Strands({0, 0, 0}, {0, 1}), curve, 2.0).size() == 1);
    CHECK(test::error_of([&] { strands_near_curve(strands, curve, -1.0); }).code() ==
          ErrorCode::invalid_argument);
    const std::vector<Vec3> point{{0, 0, 0}};
    CHECK(test::error_of([&] { strands_near_curve(strands, point, 1.0); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("selection: strands rooted in a region") {
    const Mesh mesh = make_box();
    const auto corners = mesh.topology().face(2);
    const Region region(mesh.shared_topology(), {corners.begin(), corners.end()});
    const std::vector<Index> faces = region.faces();
    REQUIRE(!faces.empty());
    Strands strands = row(3);
    CHECK(test::error_of([&] { strands_rooted_in(strands, region); }).code() ==
          ErrorCode::invalid_argument);
    StrandRoots roots;
    roots.faces = {faces[0], kNoIndex, faces[0]};
    roots.barycentrics.assign(3, Eigen::Vector3f(1, 0, 0));
    strands.set_roots(roots);
    CHECK(strands_rooted_in(strands, region) == std::vector<Index>{0, 2});
    const Region empty(mesh.shared_topology(), {});
    CHECK(strands_rooted_in(strands, empty).empty());
    roots.faces[1] = mesh.face_count();
    strands.set_roots(roots);
    CHECK(test::error_of([&] { strands_rooted_in(strands, region); }).code() ==
          ErrorCode::invalid_argument);
}
