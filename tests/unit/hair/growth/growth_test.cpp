#include "kernel/hair/growth/growth.h"

#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/strands/groomed.h"

using namespace lissom;
using doctest::Approx;
using test::Groomed;
using test::groomed;
using test::points_of;

TEST_CASE("hair field: between grid points as at them, with the distance beside") {
    const HairField& field = groomed().field;
    const GridLayout& grid = field.layout();
    for (Index k = 1; k < grid.counts[2]; k += 5) {
        for (Index j = 1; j < grid.counts[1]; j += 4) {
            const Vec3 p = grid.point(3, j, k);
            const HairField::Sample s = field.sample(p);
            const float* v = field.values().data() + 4 * grid.index(3, j, k);
            CHECK((s.direction - Vec3(v[0], v[1], v[2])).norm() < 1e-6);
            CHECK(s.distance == Approx(field.distances().value(p)).epsilon(1e-5));
        }
    }
    const Vec3 inside = groomed().scalp.frame().center;
    CHECK(field.sample(inside).distance < 0.0);
    CHECK(field.contains(inside));
    CHECK_FALSE(field.contains(inside + Vec3(0, 10, 0)));
}

TEST_CASE("hair field: it follows its streams, and is zero without any") {
    const Groomed& scene = groomed();
    HairField field(DistanceGrid(scene.head, scene.field.layout()));
    field.solve();
    CHECK(field.sample(scene.scalp.at({0, 1}, 0.02).position).direction.norm() == 0.0);
    const Vec3 a = scene.scalp.at({3.1, 0.8}, 0.01).position, b = a - Vec3(0, 0.1, 0);
    const auto curve = resampled_curve(std::vector{a, b}, field.layout().step);
    field.set_constraints(1, stream_constraints(field.layout(), curve, {}));
    field.solve();
    CHECK((field.sample(0.5 * (a + b)).direction - Vec3(0, -1, 0)).norm() < 0.05);
    field.set_constraints(1, {});
    field.solve();
    CHECK(field.sample(0.5 * (a + b)).direction.norm() == 0.0);
}

TEST_CASE("growth: strands begin at their roots and have about the length asked for") {
    const Groomed& scene = groomed();
    GrowthOptions options;
    options.length = 0.1;
    const Strands strands = scene.grown(options);
    REQUIRE(strands.size() == static_cast<Index>(scene.roots.size()));
    int full = 0;
    for (Index s = 0; s < strands.size(); ++s) {
        const Root& root = scene.roots[static_cast<std::size_t>(s)];
        CHECK((strands.root(s).cast<double>() - root.position).norm() < 1e-6);
        CHECK(strands.roots().faces[static_cast<std::size_t>(s)] == root.face);
        const double size = length(strands.strand(s));
        CHECK(size < 0.11 * 1.01 + 0.002);
        full += size > 0.085;
    }
    CHECK(full > 0.6 * strands.size());
}

TEST_CASE("growth: nothing grows into the head, and without avoidance some does") {
    const Groomed& scene = groomed();
    StrandStatisticsOptions measure;
    measure.distance = [&](const Vec3& p) { return scene.field.distances().value(p); };
    measure.depth = 0.5 * scene.field.layout().step;
    GrowthOptions options;
    const StrandStatistics avoiding = strand_statistics(scene.grown(options), measure);
    options.avoid = false;
    const StrandStatistics free = strand_statistics(scene.grown(options), measure);
    CHECK(avoiding.penetrating < 0.001 * scene.roots.size());
    CHECK(free.penetrating > avoiding.penetrating);
    CHECK(avoiding.not_finite == 0);
}

TEST_CASE("growth: the same strands on one and two threads, and whatever other roots there are") {
    const Groomed& scene = groomed();
    ContextOptions one, two;
    one.threads = 1;
    two.threads = 2;
    const Strands all = scene.grown({}, Context(one));
    CHECK(points_of(all) == points_of(scene.grown({}, Context(two))));
    Strands few;
    grow(scene.head, scene.field, std::span(scene.roots).first(100), {}, few);
    CHECK(few.roots().faces.size() == 100);
    CHECK(points_of(few) == points_of(prefix(all, 100)));
    // Into strands that were there before.
    grow(scene.head, scene.field, scene.roots, {}, few);
    CHECK(points_of(few) == points_of(all));
}

TEST_CASE("growth: a length map shortens strands where it says so") {
    const Groomed& scene = groomed();
    GrowthOptions options;
    options.variation = 0.0;
    options.length = 0.08;
    for (const Vec3& p : scene.head.positions()) {
        options.length_map.push_back(p.x() > 0.0 ? 1.0 : 0.25);
    }
    const Strands strands = scene.grown(options);
    for (Index s = 0; s < strands.size(); ++s) {
        const double x = scene.roots[static_cast<std::size_t>(s)].position.x();
        if (x < -0.01) CHECK(length(strands.strand(s)) < 0.25 * 0.08 + 0.003);
    }
}

TEST_CASE("growth: no roots, no segments, and bad options") {
    const Groomed& scene = groomed();
    Strands strands;
    grow(scene.head, scene.field, {}, {}, strands);
    CHECK(strands.empty());
    GrowthOptions options;
    options.length = 0.0;
    CHECK(scene.grown(options).point_count() == static_cast<Index>(scene.roots.size()));
    const auto code = [&](const auto& change) {
        GrowthOptions bad;
        change(bad);
        return test::error_of([&] { scene.grown(bad); }).code();
    };
    CHECK(code([](auto& o) { o.segment = 0.0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.length = -1.0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.max_segments = 0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.length_map = {1.0}; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.placement.linear.setZero(); }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.cuts.push_back({.normal = Vec3::Zero()}); }) ==
          ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.ties.push_back({.radius = -1.0}); }) == ErrorCode::invalid_argument);
    std::vector<Root> strange(1);
    CHECK(test::error_of([&] { StrandGrower(scene.head, strange); }).code() ==
          ErrorCode::invalid_argument);
    strange = {scene.roots.front()};
    strange[0].position.x() = test::kNaN;
    CHECK(test::error_of([&] { StrandGrower(scene.head, strange); }).code() ==
          ErrorCode::not_finite);
}

TEST_CASE("growth: no turn beyond a right angle, no segment without length, whatever the field") {
    const Groomed& scene = groomed();
    // Curves that run against each other, so that hair meets sources, sinks and vortices.
    HairField field(DistanceGrid(scene.head, scene.field.layout()));
    test::RandomPoints random(5);
    std::vector<GridConstraint> constraints;
    for (Index i = 0; i < scene.field.layout().size(); i += 97) {
        const Vec3 v = random.in_box({Vec3::Constant(-1.0), Vec3::Constant(1.0)});
        constraints.push_back({i, v.normalized()});
    }
    field.set_constraints(1, constraints);
    field.solve();
    for (const bool avoid : {true, false}) {
        GrowthOptions options;
        options.avoid = avoid;
        options.segment = avoid ? 0.5 : 2.0;
        options.placement = translation({30.0, 0.0, -5.0});
        Strands strands;
        const GrowthReport report = grow(scene.head, field, scene.roots, options, strands);
        const StrandStatistics found = strand_statistics(strands);
        CHECK(found.sharp == 0);
        CHECK(found.zero_segments == 0);
        CHECK(found.not_finite == 0);
        CHECK(report.ended_by(StrandEnd::turned) > 0);
        Index ended = 0;
        for (const Index count : report.ends) ended += count;
        CHECK(ended == strands.size());
    }
}

TEST_CASE("growth: the greatest turn can be set, and no strand turns by more") {
    const Groomed& scene = groomed();
    const auto grown = [&](double degrees, Index& turned) {
        GrowthOptions options;
        options.max_turn = degrees * kPi / 180.0;
        options.avoid = false;
        Strands strands;
        const GrowthReport report = grow(scene.head, scene.field, scene.roots, options, strands);
        turned = report.ended_by(StrandEnd::turned);
        double sharpest = 0.0;
        for (Index s = 0; s < strands.size(); ++s) {
            const StrandView points = strands.strand(s);
            for (Eigen::Index i = 2; i < points.cols(); ++i) {
                const Vec3 a = (points.col(i - 1) - points.col(i - 2)).cast<double>(),
                           b = (points.col(i) - points.col(i - 1)).cast<double>();
                sharpest = std::max(sharpest, std::atan2(a.cross(b).norm(), a.dot(b)));
            }
        }
        return sharpest * 180.0 / kPi;
    };
    Index few = 0, many = 0, none = 0;
    CHECK(grown(88, few) < 88.1);
    CHECK(grown(10, many) < 10.1);
    grown(180, none);
    CHECK(many > few);
    CHECK(none == 0);
    GrowthOptions wrong;
    wrong.max_turn = 4.0;
    Strands strands;
    CHECK(test::error_of([&] {
              grow(scene.head, scene.field, scene.roots, wrong, strands);
          }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("growth: hair without a field is roots, and a slow field still gives the full length") {
    const Groomed& scene = groomed();
    HairField field(DistanceGrid(scene.head, scene.field.layout()));
    field.solve();
    Strands strands;
    const GrowthReport none = grow(scene.head, field, scene.roots, {}, strands);
    CHECK(none.ended_by(StrandEnd::slow) == strands.size());
    CHECK(strands.point_count() == strands.size());

    field.set_constraints(1, {{0, Vec3(0.0, 0.3, 0.0)}});
    field.solve();
    GrowthOptions options;
    options.length = 0.03;
    options.variation = 0.0;
    options.avoid = false;
    options.lift = 0.0;
    grow(scene.head, field, std::span(scene.roots).first(50), options, strands);
    for (Index s = 0; s < strands.size(); ++s) {
        CHECK(length(strands.strand(s)) == Approx(0.03).epsilon(2e-3));
    }
}

TEST_CASE("growth: strands are placed, and a grower can be used again") {
    const Groomed& scene = groomed();
    StrandGrower grower(scene.head, scene.roots);
    CHECK(grower.size() == static_cast<Index>(scene.roots.size()));
    Strands plain, placed;
    grower.grow(scene.field, {}, plain);
    GrowthOptions options;
    options.placement = rotation({1, 2, 3}, 0.7, {0.1, 0, 0}) * scaling(Vec3::Constant(100.0), {});
    grower.grow(scene.field, options, placed);
    REQUIRE(placed.point_count() == plain.point_count());
    for (Index i = 0; i < plain.point_count(); i += 17) {
        const auto at = [&](const Strands& strands) -> Vec3 {
            return Eigen::Map<const Eigen::Vector3f>(strands.points().data() + 3 * i)
                .cast<double>();
        };
        CHECK((at(placed) - options.placement(at(plain))).norm() < 1e-4);
    }
    // Another seed and another map, and back.
    options = {};
    options.seed = 2;
    options.length_map.assign(static_cast<std::size_t>(scene.head.vertex_count()), 0.5);
    grower.grow(scene.field, options, placed);
    CHECK(points_of(placed) == points_of(scene.grown(options)));
    CHECK(points_of(placed) != points_of(plain));
    grower.grow(scene.field, {}, placed);
    CHECK(points_of(placed) == points_of(plain));
    CHECK(placed.roots().barycentrics == plain.roots().barycentrics);
}
