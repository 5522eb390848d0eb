// Operators that bend, cut, remove and collide.
#include <cmath>

#include "kernel/hair/operators/strand_cut.h"
#include "kernel/hair/strands/strand_guides.h"
#include "tests/unit/hair/operators/operator_scenes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Strands upright() {
    return strands_of({{{0, 0, 0}, {0, 0.05, 0}, {0, 0.1, 0}, {0, 0.15, 0}, {0, 0.2, 0}}});
}

double below_sphere(const Vec3& p) {
    return p.norm() - 0.1;
}

// Strands that run down through and beside a ball of 0.1 metres, rooted on top of it.
Strands through_ball(Index count) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double angle = 2.0 * kPi * s / count, tilt = 0.2 + 0.9 * (s % 7) / 7.0;
        const Vec3 out(std::cos(angle) * std::sin(tilt), std::cos(tilt),
                       std::sin(angle) * std::sin(tilt));
        std::vector<Vec3> points = {0.1 * out};
        for (int k = 1; k <= 20; ++k) {
            points.push_back(points.back() + 0.01 * Vec3(0.3 * out.x(), -0.95, 0.3 * out.z()));
        }
        lists.push_back(points);
    }
    return strands_of(lists);
}

double deepest(const Strands& strands) {
    double depth = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        for (Index k = 1; k < strands.point_count(s); ++k) {
            const Vec3 a = point_of(strands.strand(s), k - 1), b = point_of(strands.strand(s), k);
            for (const double u : {0.25, 0.5, 0.75, 1.0}) {
                if (k > 1) depth = std::max(depth, -below_sphere(a + u * (b - a)));
            }
        }
    }
    return depth;
}

}  // namespace

TEST_CASE("straightened strands are straight and as long as they were") {
    Strands strands = random_hair(20);
    const Strands before = strands;
    straighten(strands);
    for (Index s = 0; s < 20; ++s) {
        const StrandView strand = strands.strand(s);
        const auto chord = double((strand.col(strand.cols() - 1) - strand.col(0)).norm());
        CHECK(chord == doctest::Approx(length(before.strand(s))).epsilon(1e-4));
    }
}

TEST_CASE("a rotation turns strands as wholes, or their tips the most") {
    RotateOptions options;
    options.axis = Vec3(0, 0, 2);
    options.angle = kPi / 2;
    Strands strands = upright();
    rotate(strands, options);
    CHECK((strands.strand(0).col(4) - Eigen::Vector3f(-0.2f, 0, 0)).norm() < 1e-5f);
    options.shape = 1.0;
    strands = upright();
    rotate(strands, options);
    const Eigen::Vector3f last = strands.strand(0).col(4) - strands.strand(0).col(3);
    CHECK((last - Eigen::Vector3f(-0.05f, 0, 0)).norm() < 1e-5f);
    CHECK(strands.strand(0)(1, 1) > 0.04f);
}

TEST_CASE("rolled ends lie on a circle of the radius, towards the head or away") {
    std::vector<Vec3> points;
    for (int k = 0; k <= 200; ++k) points.emplace_back(0.1, -0.001 * k, 0.0);
    for (const bool outward : {false, true}) {
        Strands strands = strands_of({points});
        RollOptions options;
        options.outward = outward;
        options.center = Vec3(0, -0.1, 0);
        options.radius = 0.01;
        roll(strands, options);
        const Vec3 middle(outward ? 0.11 : 0.09, -0.1, 0);
        for (Index k = 101; k <= 200; ++k) {
            CHECK((point_of(strands.strand(0), k) - middle).norm() ==
                  doctest::Approx(0.01).epsilon(0.02));
        }
    }
}

TEST_CASE("puff lifts hair off the center") {
    Strands strands = upright();
    PuffOptions options;
    options.center = Vec3(-1, 0.1, 0);
    options.profile = {1.0};
    options.keep_length = false;
    puff(strands, options);
    CHECK(strands.strand(0)(0, 2) == doctest::Approx(0.01));
}

TEST_CASE("lengths are set, scaled and varied, shapes stay, and arcs of guides follow") {
    Strands strands = random_hair(200);
    assign_guides(strands, {.count = 5});
    const float arc = strands.guides().arcs[50];
    LengthOptions options;
    options.scale = 2.0;
    Strands made = strands;
    set_length(made, options);
    CHECK(length(made.strand(9)) == doctest::Approx(2.0 * length(strands.strand(9))));
    CHECK(made.guides().arcs[50] == doctest::Approx(2.0 * arc));
    options = {};
    options.length = 0.1;
    options.variation = 0.25;
    made = strands;
    set_length(made, options);
    double least = 1.0, most = 0.0;
    for (Index s = 0; s < 200; ++s) {
        least = std::min(least, length(made.strand(s)));
        most = std::max(most, length(made.strand(s)));
    }
    CHECK(least > 0.0749);
    CHECK(least < 0.08);
    CHECK(most < 0.1251);
    CHECK(most > 0.12);
}

TEST_CASE("cuts follow a plane, an ellipsoid, a hem and any function") {
    StrandCutOptions options;
    options.inside = inside_plane({0, 0.12, 0}, {0, 3, 0});
    Strands strands = upright();
    cut(strands, options);
    CHECK(length(strands.strand(0)) == doctest::Approx(0.12));
    options.inside = inside_ellipsoid({0, 0, 0}, {1, 0.07, 1});
    strands = upright();
    cut(strands, options);
    CHECK(length(strands.strand(0)) == doctest::Approx(0.07).epsilon(0.01));
    options.inside = [](const Vec3& p, Index) { return 0.16 - p.y(); };
    strands = upright();
    cut(strands, options);
    CHECK(length(strands.strand(0)) == doctest::Approx(0.16));
    options.factor = 0.5;
    strands = upright();
    cut(strands, options);
    CHECK(length(strands.strand(0)) == doctest::Approx(0.18));

    options.factor = 1.0;
    options.inside = above_hem({{0.0, -0.05}, {kPi / 2, -0.1}});
    strands = strands_of({{{0, 0.1, 0.1}, {0, -0.2, 0.1}},
                          {{-0.1, 0.1, 0}, {-0.1, -0.2, 0}},
                          {{0.1, 0.1, 0.1}, {0.1, -0.2, 0.1}}});
    cut(strands, options);
    CHECK(strands.strand(0)(1, 1) == doctest::Approx(-0.05));
    CHECK(strands.strand(1)(1, 1) == doctest::Approx(-0.1));
    CHECK(strands.strand(2)(1, 1) == doctest::Approx(-0.075));
}

TEST_CASE("jitter moves cuts strand by strand, that of guides lock by lock") {
    std::vector<std::vector<Vec3>> lists;
    for (int s = 0; s < 100; ++s) {
        const double x = 0.1 * (s % 4) + 0.0001 * s;
        lists.push_back({{x, 0, 0}, {x, 0.2, 0}});
    }
    Strands strands = strands_of(lists);
    assign_guides(strands, {.count = 4});
    StrandCutOptions options;
    options.inside = inside_plane({0, 0.1, 0}, {0, 1, 0});
    options.guide_jitter = 0.02;
    Strands made = strands;
    cut(made, options);
    for (Index s = 4; s < 100; ++s) {
        CHECK(length(made.strand(s)) == doctest::Approx(length(made.strand(s % 4))));
    }
    CHECK(std::abs(length(made.strand(0)) - length(made.strand(1))) > 1e-4);
    options.guide_jitter = 0.0;
    options.jitter = 0.01;
    made = strands;
    cut(made, options);
    double least = 1.0, most = 0.0;
    for (Index s = 0; s < 100; ++s) {
        least = std::min(least, length(made.strand(s)));
        most = std::max(most, length(made.strand(s)));
    }
    CHECK(least < 0.092);
    CHECK(least > 0.0899);
    CHECK(most > 0.108);
}

TEST_CASE("culling removes the strands that are marked, and their locks if asked") {
    Strands strands = random_hair(300);
    assign_guides(strands, {.count = 10});
    std::vector<char> marks(300, 0);
    marks[250] = 1;
    Strands made = strands;
    cull(made, marks);
    CHECK(made.size() == 299);
    made = strands;
    cull(made, marks, true);
    CHECK(made.size() < 295);
    for (const std::uint32_t guide : made.guides().ids) CHECK(guide != strands.guides().ids[250]);
    const std::vector<char> some = random_marks(strands, 0.3, 1);
    const auto count = std::count(some.begin(), some.end(), 1);
    CHECK(count > 60);
    CHECK(count < 120);
    CHECK(error_of([&] { cull(made, marks); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("hair is pushed out of a body, segments too, and strands outside stay to the bit") {
    Strands strands = through_ball(300);
    const Strands before = strands;
    REQUIRE(deepest(strands) > 0.03);
    PushOutOptions options;
    options.distance = below_sphere;
    push_out(strands, options);
    CHECK(deepest(strands) < 0.001);
    for (Index s = 0; s < strands.size(); ++s) {
        CHECK(length(strands.strand(s)) == doctest::Approx(length(before.strand(s))).epsilon(0.1));
    }
    Strands outside = upright();
    for (Index k = 0; k < 5; ++k) outside.edit_strand(0)(0, k) += 0.2f;
    const std::uint64_t hash_before = hash(outside);
    push_out(outside, options);
    CHECK(hash(outside) == hash_before);
    // A rough distance that leaves no doubt far away changes nothing.
    Strands again = before;
    options.rough = below_sphere;
    options.rough_error = 0.01;
    push_out(again, options);
    CHECK(hash(again) == hash(strands));
}

TEST_CASE("a shrinkwrap lays hair on the surface") {
    Strands strands = through_ball(50);
    ShrinkwrapOptions options;
    options.distance = below_sphere;
    options.keep_length = false;
    shrinkwrap(strands, options);
    for (Index s = 0; s < strands.size(); ++s) {
        for (Index k = 1; k < strands.point_count(s); ++k) {
            CHECK(below_sphere(point_of(strands.strand(s), k)) ==
                  doctest::Approx(0.003).epsilon(0.02));
        }
    }
}

TEST_CASE("operators of shapes refuse options out of range") {
    Strands strands = random_hair(5);
    const auto refused = [&](auto options, const auto& change, const auto& run) {
        change(options);
        return error_of([&] { run(strands, options, Context()); }).code() ==
               ErrorCode::invalid_argument;
    };
    CHECK(refused(
        RotateOptions(), [](auto& o) { o.axis = Vec3::Zero(); }, rotate));
    CHECK(refused(
        RollOptions(), [](auto& o) { o.radius = 0.0; }, roll));
    CHECK(refused(
        RollOptions(), [](auto& o) { o.start = 1.0; }, roll));
    CHECK(refused(
        PuffOptions(), [](auto& o) { o.amount = std::nan(""); }, puff));
    CHECK(refused(
        DisplaceOptions(), [](auto& o) { o.offsets = {Vec3::Zero()}; }, displace));
    CHECK(refused(
        LengthOptions(), [](auto& o) { o.length = 0.0; }, set_length));
    CHECK(refused(
        LengthOptions(), [](auto& o) { o.variation = 1.0; }, set_length));
    CHECK(refused(
        StrandCutOptions(), [](auto&) {}, cut));
    CHECK(refused(
        PushOutOptions(), [](auto&) {}, push_out));
    CHECK(refused(
        ShrinkwrapOptions(), [](auto&) {}, shrinkwrap));
    CHECK(error_of([] { inside_plane(Vec3::Zero(), Vec3::Zero()); }).code() ==
          ErrorCode::invalid_argument);
    CHECK(error_of([] {
              inside_ellipsoid(Vec3::Zero(), {1, 0, 1});
          }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([] { above_hem({}); }).code() == ErrorCode::invalid_argument);
}
