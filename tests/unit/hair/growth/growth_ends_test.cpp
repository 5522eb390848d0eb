// Ties, cuts and the loops of growth.
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/strands/strand_measures.h"
#include "tests/unit/hair/strands/groomed.h"

using namespace lissom;
using doctest::Approx;

namespace {

// Roots on a small square and a field that is `up` everywhere, without a head nearby.
struct Meadow {
    Mesh head = test::groomed().head;
    HairField field{DistanceGrid(head, test::groomed().field.layout())};
    std::vector<Root> roots;

    explicit Meadow(const Vec3& up = Vec3::UnitY()) {
        field.set_constraints(1, {{0, up}});
        field.solve();
        for (int i = 0; i < 100; ++i) {
            Root root = test::groomed().roots.front();
            const Index row = i / 10, column = i % 10;
            root.position = Vec3(0.001 * column - 0.0045, 0.0, 0.001 * row - 0.0045) +
                            field.layout().box().center();
            root.normal = up;
            roots.push_back(root);
        }
    }

    Vec3 above(double height) const { return field.layout().box().center() + Vec3(0, height, 0); }

    GrowthOptions options() const {
        GrowthOptions options;
        options.avoid = false;
        options.variation = 0.0;
        options.length = 0.08;
        return options;
    }
};

double tip_height(const Meadow& meadow, const Strands& strands, Index s) {
    return strands.strand(s).col(strands.point_count(s) - 1).y() - meadow.above(0.0).y();
}

std::vector<float> points_of(const StrandBatch& batch, std::size_t i) {
    const StrandBatch::Strand& strand = batch.strands[i];
    const float* first = batch.lists[strand.list].data() + strand.first;
    return {first, first + std::ptrdiff_t{3} * strand.count};
}

void check_same(const StrandBatch& a, const StrandBatch& b) {
    REQUIRE(a.strands.size() == b.strands.size());
    for (std::size_t i = 0; i < a.strands.size(); ++i) {
        CHECK(points_of(a, i) == points_of(b, i));
        CHECK(a.strands[i].end == b.strands[i].end);
    }
}

}  // namespace

TEST_CASE("growth: a tie catches what passes it in its direction, and nothing else") {
    const Meadow meadow;
    GrowthOptions options = meadow.options();
    // Half the meadow passes through the first; the second comes after it; the third faces down.
    options.ties = {{meadow.above(0.03) + Vec3(0.05, 0, 0), {0, 2, 0}, 0.05, 0.02, 0.5},
                    {meadow.above(0.035), {0, 1, 0}, 0.02, 0.06, 0.0},
                    {meadow.above(0.01), {0, -1, 0}, 0.02, 0.01, 0.0}};
    Strands strands;
    const GrowthReport report = grow(meadow.head, meadow.field, meadow.roots, options, strands);
    REQUIRE(report.ties.size() == meadow.roots.size());
    double shortest = 1.0, longest = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        const auto i = static_cast<std::size_t>(s);
        const bool in_first =
            (meadow.roots[i].position - options.ties[0].center).cwiseProduct(Vec3(1, 0, 1)).norm() <
            0.05;
        CHECK(report.ties[i] == (in_first ? 0 : 1));
        const double tail = tip_height(meadow, strands, s) - (in_first ? 0.03 : 0.035);
        if (!in_first) CHECK(tail == Approx(0.06).epsilon(2e-3));
        if (!in_first) continue;
        shortest = std::min(shortest, tail);
        longest = std::max(longest, tail);
    }
    CHECK(shortest > 0.0099);
    CHECK(shortest < 0.015);
    CHECK(longest < 0.0201);
    CHECK(longest > 0.018);
}

TEST_CASE("growth: the length of a tail is measured along its spine, so that it has one end") {
    const Meadow meadow;
    GrowthOptions options = meadow.options();
    HairTie tie{meadow.above(0.02), {0, 1, 0}, 0.02, 0.05, 0.0};
    // It leans while hair goes straight up: hair that it leans towards is farther along it.
    const Vec3 along(0.6, 0.8, 0.0);
    for (int k = 0; k <= 25; ++k) tie.spine.push_back(tie.center + 0.002 * k * along);
    options.ties = {tie};
    Strands strands;
    const GrowthReport report = grow(meadow.head, meadow.field, meadow.roots, options, strands);
    Index tied = 0;
    for (Index s = 0; s < strands.size(); ++s) {
        const auto i = static_cast<std::size_t>(s);
        if (report.ties[i] != 0) continue;
        ++tied;
        const double lean = meadow.roots[i].position.x() - tie.center.x();
        CHECK(tip_height(meadow, strands, s) - 0.02 ==
              Approx((0.05 - 0.6 * lean) / 0.8).epsilon(0.015));
    }
    CHECK(tied > 10);
    options.ties[0].spine.front().x() = test::kNaN;
    CHECK(test::error_of([&] {
              grow(meadow.head, meadow.field, meadow.roots, options, strands);
          }).code() == ErrorCode::invalid_argument);
}

namespace {

// Strands of a meadow whose roots are on one side of a tie, with a tail that goes straight up from
// it.
struct OneSided {
    Meadow meadow;
    Strands strands;
    std::vector<Vec3> tips;       // from the tail's spine, in its radius
    std::vector<double> missing;  // of the tail's length at each tip, as a share

    OneSided(double radius, double beside, double ragged = 0.0) {
        GrowthOptions options = meadow.options();
        options.length = 0.01 + 4.0 * meadow.field.layout().step;
        HairTie tie{meadow.above(0.01) + Vec3(beside, 0, 0), {0, 1, 0}, 0.008, 0.3, 0.0};
        for (int k = 0; k <= 30; ++k) {
            tie.spine.push_back(tie.center + Vec3(0, meadow.field.layout().step * k, 0));
        }
        if (radius > 0.0) tie.radii.assign(tie.spine.size(), radius);
        tie.tail_length = 13 * meadow.field.layout().step;
        tie.ragged = ragged;
        options.ties = {tie};
        grow(meadow.head, meadow.field, meadow.roots, options, strands);
        for (Index s = 0; s < strands.size(); ++s) {
            const Vec3 tip = strands.strand(s).col(strands.point_count(s) - 1).cast<double>();
            tips.push_back((tip - tie.center).cwiseProduct(Vec3(1, 0, 1)) / std::max(radius, 1e-3));
            missing.push_back(1.0 - (tip - tie.center).y() / *tie.tail_length);
        }
    }
};

}  // namespace

TEST_CASE("growth: hair fills a tail all round, also where it came in from one side") {
    const double step = Meadow().field.layout().step;
    for (const double beside : {0.003, 0.003 + 1.2 * step}) {
        CAPTURE(beside);
        const OneSided filled(2.0 * step, beside);
        Vec3 mean = Vec3::Zero();
        double square = 0.0, farthest = 0.0;
        for (const Vec3& tip : filled.tips) {
            mean += tip / static_cast<double>(filled.tips.size());
            square += tip.squaredNorm() / static_cast<double>(filled.tips.size());
            farthest = std::max(farthest, tip.norm());
        }
        CHECK(mean.norm() < 0.15);
        CHECK(std::sqrt(square) > 0.5);
        CHECK(farthest < 1.05);
    }
    for (const Vec3& tip : OneSided(0.0, 0.003).tips) CHECK(std::abs(tip.z()) < 4.6);
}

TEST_CASE("growth: a ragged tail ends like a brush: round, neither as a cone nor flat") {
    const double step = Meadow().field.layout().step, ragged = 0.4;
    const OneSided tail(2.0 * step, 0.003, ragged);
    double widest_of_long = 0.0, inner = 0.0, outer = 0.0;
    Index inner_count = 0, outer_count = 0;
    for (std::size_t i = 0; i < tail.tips.size(); ++i) {
        const double far = tail.tips[i].norm(), share = tail.missing[i] / ragged;
        CHECK(share > -0.03);
        CHECK(share < 1.03);
        if (share < 0.5) widest_of_long = std::max(widest_of_long, far);
        (far < 0.6 ? inner : outer) += share;
        ++(far < 0.6 ? inner_count : outer_count);
    }
    REQUIRE(inner_count > 10);
    REQUIRE(outer_count > 10);
    // A cone is half as wide halfway along its end.
    CHECK(widest_of_long > 0.65);
    CHECK(outer / outer_count > inner / inner_count + 0.1);
}

TEST_CASE("growth: a cut ends strands on its plane, each where chance moves it") {
    const Meadow meadow;
    GrowthOptions options = meadow.options();
    options.cuts = {{meadow.above(0.04), {0, 3, 0}, 0.0}};
    Strands strands;
    GrowthReport report = grow(meadow.head, meadow.field, meadow.roots, options, strands);
    CHECK(report.ended_by(StrandEnd::cut) == strands.size());
    CHECK(report.ties.empty());
    for (Index s = 0; s < strands.size(); ++s) {
        CHECK(tip_height(meadow, strands, s) == Approx(0.04).epsilon(1e-4));
    }
    options.cuts[0].ragged = 0.01;
    report = grow(meadow.head, meadow.field, meadow.roots, options, strands);
    double low = 1.0, high = 0.0;
    for (Index s = 0; s < strands.size(); ++s) {
        low = std::min(low, tip_height(meadow, strands, s));
        high = std::max(high, tip_height(meadow, strands, s));
    }
    CHECK(low > 0.0299);
    CHECK(low < 0.032);
    CHECK(high > 0.048);
    CHECK(high < 0.0501);
    // Of two cuts the first counts, and from behind a cut does nothing.
    options.cuts = {{meadow.above(0.05), {0, 1, 0}, 0.0},
                    {meadow.above(0.02), {0, 1, 0}, 0.0},
                    {meadow.above(0.01), {0, -1, 0}, 0.0}};
    grow(meadow.head, meadow.field, meadow.roots, options, strands);
    CHECK(tip_height(meadow, strands, 7) == Approx(0.02).epsilon(1e-4));
}

TEST_CASE("growth: a cut spares what a tie has caught, if asked") {
    const Meadow meadow;
    GrowthOptions options = meadow.options();
    options.ties = {{meadow.above(0.02), {0, 1, 0}, 0.02, 0.05, 0.0}};
    options.cuts = {{meadow.above(0.04), {0, 1, 0}, 0.0}};
    Strands strands;
    GrowthReport report = grow(meadow.head, meadow.field, meadow.roots, options, strands);
    CHECK(report.ended_by(StrandEnd::length) == strands.size());
    CHECK(tip_height(meadow, strands, 0) == Approx(0.07).epsilon(2e-3));
    options.spare_tied = false;
    report = grow(meadow.head, meadow.field, meadow.roots, options, strands);
    CHECK(report.ended_by(StrandEnd::cut) == strands.size());
}

TEST_CASE("growth: the same to the bit with and without vector instructions") {
    const test::Groomed& scene = test::groomed();
    const GridLayout& layout = scene.field.layout();
    QuadGrid grid{scene.field.values().data(),
                  scene.field.gradients().data(),
                  layout.counts[0],
                  layout.counts[0] * layout.counts[1],
                  {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        grid.last[axis] = static_cast<float>(layout.counts[axis] - 1);
    }
    GrowthRules rules{};
    rules.segment = 0.5f;
    rules.min_speed = 0.05f;
    rules.min_move = 5e-4f;
    rules.lift = 0.15f;
    rules.inverse_ramp = 0.5f;
    rules.inverse_step = static_cast<float>(1.0 / layout.step);
    rules.avoid = true;
    rules.max_segments = 150;
    const Eigen::Vector3f middle = Eigen::Vector3f(grid.last.data()) / 2.0f;
    rules.cuts = {{{0.0f, -1.0f, 0.0f}, -middle.y() - 1.0f, 1.0f}};
    rules.ties = {{{middle, {0.0f, 0.0f, -1.0f}, 50.0f}, 5.0f, 0.45f}};
    for (int k = 1; k < 5; ++k) {
        const auto along = static_cast<float>(k);
        rules.ties[0].planes.push_back(
            {middle - Eigen::Vector3f(0, along, along), {0.0f, -0.6f, -0.8f}, 1.4f * along});
    }
    rules.linear = Eigen::Matrix3f::Identity();
    rules.translation = {0.1f, 0.2f, 0.3f};
    std::vector<StrandSeed> seeds;
    test::RandomPoints random(3);
    for (const Root& root : scene.roots) {
        const auto number = [&] { return static_cast<float>(random.uniform(0.0, 1.0)); };
        seeds.push_back({((root.position - layout.origin) / layout.step).cast<float>(),
                         root.normal.cast<float>(), 30.0f * number(), number(), number(),
                         number()});
    }
    StrandBatch plain;
    grow_batch(grid, rules, seeds, GrowthLoop::anywhere, plain);
    for (const GrowthLoop loop : {GrowthLoop::avx2, GrowthLoop::avx512}) {
        if (loop > best_growth_loop()) continue;
        StrandBatch other;
        grow_batch(grid, rules, seeds, loop, other);
        check_same(plain, other);
    }
    int cut = 0, tied = 0;
    for (const StrandBatch::Strand& strand : plain.strands) {
        cut += strand.end == StrandEnd::cut;
        tied += strand.tie == 0;
    }
    CHECK(cut > 0);
    CHECK(tied > 0);
    // Neighbours in other lanes change nothing.
    StrandBatch alone;
    for (std::size_t i = 0; i < seeds.size(); i += 131) {
        grow_batch(grid, rules, std::span(seeds).subspan(i, 1), best_growth_loop(), alone);
        CHECK(points_of(alone, 0) == points_of(plain, i));
    }
}
