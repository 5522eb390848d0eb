// Roots in the order in which strands are grown.
#include "kernel/hair/growth/growth_roots.h"

#include <algorithm>

#include "kernel/mesh/shapes/head.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;

namespace {

constexpr Index kRoots = 2 * kGrowthWave + 1000;

struct ManyRoots {
    Mesh head = make_head({.vertices = 3000});
    Scalp scalp{head};
    std::vector<Root> roots = make_roots(head, scalp, {.count = kRoots});
};

const ManyRoots& many_roots() {
    static const ManyRoots scene;
    return scene;
}

}  // namespace

TEST_CASE("growth roots: each comes once, within its wave, and neighbours follow each other") {
    const std::vector<Root>& roots = many_roots().roots;
    const GrowthRoots ordered(many_roots().head, roots, {});
    REQUIRE(ordered.size() == kRoots);
    std::vector<int> seen(roots.size(), 0);
    double as_given = 0.0, in_order = 0.0;
    for (Index i = 0; i < kRoots; ++i) {
        const Index number = ordered.number(i);
        ++seen[number];
        CHECK(number / kGrowthWave == i / kGrowthWave);
        CHECK(ordered.position(i) == roots[number].position);
        CHECK((ordered.normal(i).cast<double>() - roots[number].normal).norm() < 1e-6);
        if (i % kGrowthWave == 0) continue;
        in_order += (ordered.position(i) - ordered.position(i - 1)).norm();
        as_given += (roots[i].position - roots[i - 1].position).norm();
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    CHECK(in_order < 0.1 * as_given);
}

TEST_CASE("growth roots: what chance a strand has belongs to its root and the seed") {
    const std::vector<Root>& roots = many_roots().roots;
    GrowthRoots all(many_roots().head, roots, {});
    GrowthRoots some(many_roots().head, std::span(roots).first(3000), {});
    all.set_seed(7, {});
    some.set_seed(8, {});
    some.set_seed(7, {});
    std::vector<StrandChance> of_root(roots.size());
    Vec3 sum = Vec3::Zero();
    for (Index i = 0; i < kRoots; ++i) {
        const StrandChance& c = of_root[all.number(i)] = all.chance(i);
        CHECK(std::max({std::abs(c.length), std::abs(c.layer), std::abs(c.cut)}) <= 1.0f);
        CHECK(c.tail >= 0.0f);
        CHECK(c.tail < 1.0f);
        sum += Vec3(c.length, c.layer, c.tail - 0.5) / kRoots;
    }
    CHECK(sum.norm() < 0.03);
    for (Index i = 0; i < some.size(); ++i) {
        CHECK(some.chance(i).length == of_root[some.number(i)].length);
        CHECK(some.chance(i).tail == of_root[some.number(i)].tail);
    }
}

TEST_CASE("growth roots: a map of lengths is interpolated, and forgotten where none is given") {
    GrowthRoots roots(many_roots().head, many_roots().roots, {});
    std::vector<double> map;
    for (const Vec3& p : many_roots().head.positions()) map.push_back(1.0 + 2.0 * p.x() - p.z());
    roots.set_factors({map, {}}, {});
    for (Index i = 0; i < kRoots; ++i) {
        const Vec3& p = roots.position(i);
        CHECK(std::abs(roots.factor(i) - (1.0 + 2.0 * p.x() - p.z())) < 1e-5);
    }
    roots.set_factors({}, {});
    for (Index i = 0; i < kRoots; i += 100) CHECK(roots.factor(i) == 1.0f);
}
