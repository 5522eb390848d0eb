#include "kernel/hair/growth.h"

#include "kernel/hair/curve.h"
#include "kernel/hair/strand_edit.h"
#include "kernel/hair/strand_measures.h"
#include "kernel/hair/stream_curve.h"
#include "kernel/mesh/head.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// The generated head with hair that is swept over its top by three streams.
struct Groomed {
    Mesh head = make_head({.vertices = 4000});
    Scalp scalp{head};
    HairField field{DistanceGrid(head, fit_grid(scalp.default_box(), 12000))};
    std::vector<Root> roots = make_roots(head, scalp, {.count = 3000});

    Groomed() {
        for (const double side : {-0.6, 0.0, 0.6}) {
            std::vector<Vec3> points;
            for (const double back : {0.3, 1.2, 2.2, 2.8}) {
                const double elevation = 1.2 - 0.35 * back;
                const double azimuth = side * (1.0 - back / 3.5) + (side < 0.0 ? -back : back);
                points.push_back(scalp.at({azimuth, elevation}, 0.01).position);
            }
            std::vector<Vec3> curve = smooth_curve(points, 0.2 * field.layout().step);
            push_out(curve, field.distances(), 0.004);
            curve = resampled_curve(curve, field.layout().step);
            field.set_constraints(++curves, stream_constraints(field.layout(), curve, {0.04}));
        }
        field.solve();
    }

    Strands grown(const GrowthOptions& options = {}, const Context& context = {}) const {
        Strands strands;
        grow(head, field, roots, options, strands, context);
        return strands;
    }

    int curves = 0;
};

const Groomed& groomed() {
    static const Groomed scene;
    return scene;
}

std::vector<float> points_of(const Strands& strands) {
    return {strands.points().begin(), strands.points().end()};
}

}  // namespace

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
    CHECK(code([](auto& o) { o.most_segments = 0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.length_map = {1.0}; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.placement.linear.setZero(); }) == ErrorCode::invalid_argument);
}
