// The search for a boundary: around the feature, simple, and never dearer than before.
#include <algorithm>
#include <limits>
#include <set>

#include "kernel/merge/paste/loop_search.h"
#include "kernel/merge/paste/paste_regions.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

double cost_of(const LoopSearch& search, std::span<const double> cost,
               std::span<const Index> loop) {
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Index e = search.edge_between(loop[k], loop[(k + 1) % loop.size()]);
        sum += e == kNoIndex ? std::numeric_limits<double>::infinity() : cost[at(e)];
    }
    return sum;
}

// How often a loop runs around the y axis.
double turns_of(const Mesh& mesh, std::span<const Index> loop) {
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 &a = mesh.position(loop[k]), &b = mesh.position(loop[(k + 1) % loop.size()]);
        sum += std::remainder(std::atan2(-b.z(), b.x()) - std::atan2(-a.z(), a.x()), 2.0 * kPi);
    }
    return sum / (2.0 * kPi);
}

}  // namespace

TEST_CASE("loop search: simple, once around, and no dearer than both boundaries, at random costs") {
    const Mesh mesh = horned_ball(16);
    const PasteRegions regions = paste_regions(mesh, around_horn(mesh), std::nullopt, 0.6, {});
    const LoopSearch search(mesh, regions, {});
    std::uint32_t state = 7;
    for (int round = 0; round < 200; ++round) {
        std::vector<double> cost;
        for (std::size_t e = 0; e < search.edges().size(); ++e) {
            state = state * 1664525u + 1013904223u;
            cost.push_back(0.05 + static_cast<double>(state >> 8) / (1u << 24));
        }
        const std::vector<Index> loop = search.cheapest(cost, {});
        REQUIRE(loop.size() >= 3);
        CHECK(std::set<Index>(loop.begin(), loop.end()).size() == loop.size());
        CHECK(turns_of(mesh, loop) == doctest::Approx(1.0));
        const double found = cost_of(search, cost, loop);
        CHECK(found <= cost_of(search, cost, regions.outer));
        CHECK(found <= cost_of(search, cost, regions.inner));
    }
}

TEST_CASE("paste search: the energy never increases, at twelve angles") {
    const Mesh horn = horned_ball(), target = egg();
    for (int k = 0; k < 12; ++k) {
        for (const double normals : {0.0, 0.2}) {
            PasteOptions options;
            options.normals = normals;
            PastePlacement placement{.at = {1, 1.2, 0.8}, .angle = k * kPi / 6.0, .scale = 0.8};
            Paste paste = horn_on_egg(horn, target, placement, options);
            paste.optimize();
            const std::vector<double>& energy = paste.search().energy;
            for (std::size_t i = 1; i < energy.size(); ++i) {
                CHECK(energy[i] <= energy[i - 1] * (1.0 + 1e-12));
            }
            REQUIRE(paste.search().outline_energy);
            CHECK(energy.back() <= *paste.search().outline_energy);
            CHECK(paste.search().stop == PasteStop::converged);
        }
    }
}
