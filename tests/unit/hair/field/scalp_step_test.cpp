#include "kernel/hair/field/scalp_step.h"

#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/strands/groomed.h"

using namespace lissom;
using test::Groomed;

namespace {

constexpr ConstraintOwner kStep = 1000;

// How far the vector at a grid point points inward, of unit length.
double inwardness(const HairField& field, Index point) {
    const GridPoint at = field.grid().size().point(point);
    const GridLayout& layout = field.layout();
    const auto distance = [&](const Vec3& p) { return field.distances().value(p); };
    const Vec3 p = layout.point(at.x, at.y, at.z);
    Vec3 normal;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 by = layout.step * Vec3::Unit(axis);
        normal[axis] = distance(p + by) - distance(p - by);
    }
    const float* v = field.values().data() + 4 * static_cast<std::size_t>(point);
    return -Vec3(v[0], v[1], v[2]).dot(normal.normalized());
}

Index penetrating(const Groomed& scene) {
    GrowthOptions options;
    options.avoid = false;
    StrandStatisticsOptions measure;
    measure.distance = [&](const Vec3& p) { return scene.field.distances().value(p); };
    measure.depth = 0.5 * scene.field.layout().step;
    return strand_statistics(scene.grown(options), measure).penetrating;
}

}  // namespace

TEST_CASE("scalp step: afterwards nothing near the scalp points inward, and fewer strands enter") {
    Groomed scene;
    const Index before = penetrating(scene);
    REQUIRE(before > 0);
    const std::vector<GridConstraint> step = scalp_step(scene.field);
    REQUIRE(step.size() > 100);
    Index inward = 0;
    for (const GridConstraint& c : step) inward += inwardness(scene.field, c.point) > 0.02;
    CHECK(inward > 0);
    scene.field.set_constraints(kStep, step);
    scene.field.solve();
    for (const GridConstraint& c : step) {
        CHECK(inwardness(scene.field, c.point) < 0.01);
        const float* v = scene.field.values().data() + 4 * static_cast<std::size_t>(c.point);
        CHECK((Vec3(v[0], v[1], v[2]) - c.value).norm() < 0.02);
    }
    CHECK(penetrating(scene) < 0.7 * before);
}

TEST_CASE("scalp step: it keeps directions, its magnitude, and points that curves constrain") {
    const Groomed& scene = test::groomed();
    ScalpStepOptions options;
    options.magnitude = 0.2;
    options.band = 0.5 * scene.field.layout().step;
    const std::vector<GridConstraint> narrow = scalp_step(scene.field, options);
    options.band = 1.5 * scene.field.layout().step;
    const std::vector<GridConstraint> wide = scalp_step(scene.field, options);
    CHECK(narrow.size() < wide.size());
    for (const GridConstraint& c : wide) {
        CHECK(c.value.norm() == doctest::Approx(0.2));
        CHECK(c.weight == 100.0);
        const float* v = scene.field.values().data() + 4 * static_cast<std::size_t>(c.point);
        const Vec3 field(v[0], v[1], v[2]);
        CHECK(std::abs(v[3]) < *options.band);
        if (inwardness(scene.field, c.point) < -1e-3 * field.norm()) {
            CHECK((c.value.normalized() - field.normalized()).norm() < 1e-4);
        }
        for (int curve = 1; curve <= scene.curves; ++curve) {
            for (const GridConstraint& other : scene.field.grid().constraints().of(curve)) {
                CHECK(other.point != c.point);
            }
        }
    }
    const double middle = scene.scalp.frame().center.x();
    options.where = [&](const Vec3& p) { return p.x() > middle; };
    for (const GridConstraint& c : scalp_step(scene.field, options)) {
        const GridPoint at = scene.field.grid().size().point(c.point);
        CHECK(scene.field.layout().point(at.x, at.y, at.z).x() > middle);
    }
}

TEST_CASE("scalp step: off the scalp only points whose direction points inward") {
    const Groomed& scene = test::groomed();
    const double middle = scene.scalp.frame().center.x();
    ScalpStepOptions options;
    const std::size_t all = scalp_step(scene.field, options).size();
    options.scalp = [&](const Vec3& p) { return p.x() > middle; };
    const std::vector<GridConstraint> step = scalp_step(scene.field, options);
    Index off = 0;
    for (const GridConstraint& c : step) {
        const GridPoint at = scene.field.grid().size().point(c.point);
        if (scene.field.layout().point(at.x, at.y, at.z).x() > middle) continue;
        ++off;
        CHECK(inwardness(scene.field, c.point) > 0.0);
    }
    CHECK(off > 20);
    CHECK(step.size() + 20 < all);
}

TEST_CASE("scalp step: nothing without a field, and bad options") {
    const Groomed& scene = test::groomed();
    HairField empty(DistanceGrid(scene.head, scene.field.layout()));
    empty.solve();
    CHECK(scalp_step(empty).empty());
    const auto code = [&](const auto& change) {
        ScalpStepOptions bad;
        change(bad);
        return test::error_of([&] { scalp_step(scene.field, bad); }).code();
    };
    CHECK(code([](auto& o) { o.band = 0.0; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.magnitude = -0.3; }) == ErrorCode::invalid_argument);
    CHECK(code([](auto& o) { o.weight = test::kNaN; }) == ErrorCode::invalid_argument);
}
