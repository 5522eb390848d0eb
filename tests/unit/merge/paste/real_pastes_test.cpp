// Pastes of real features: the boundary is the cheapest, and the surface near it little distorted.
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "kernel/io/mesh_file.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/free_loop.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/paste/search/paste_energy.h"
#include "tests/unit/merge/paste/real_pastes.h"
#include "tests/unit/merge/paste/search/loop_force.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

struct RealModels {
    Mesh source, target;
};

// Loaded once: several pastes share a model.
std::optional<Mesh> real_model(const std::string& file) {
    static std::map<std::string, Mesh> loaded;
    const auto path = data_file(file);
    if (!path) return std::nullopt;
    const auto known = loaded.find(file);
    return known != loaded.end() ? known->second : loaded[file] = load_mesh(*path);
}

std::optional<RealModels> models_of(const RealPaste& paste) {
    std::optional<Mesh> source = real_model(paste.source), target = real_model(paste.target);
    if (!source || !target) return std::nullopt;
    return RealModels{std::move(*source), std::move(*target)};
}

Paste placed(const RealPaste& paste, const RealModels& models, const PasteOptions& options = {}) {
    return Paste(models.source, models.target, paste.region(models.source),
                 paste.feature(models.source), std::nullopt, paste.placement, options);
}

void check_sound(const PasteResult& result, const RealModels& models) {
    CHECK(result.report.euler_characteristic == result.report.expected_characteristic);
    CHECK(result.merged.mesh.topology().is_closed() == models.target.topology().is_closed());
    CHECK(result.merged.mesh.topology().component_count() ==
          models.target.topology().component_count());
}

}  // namespace

TEST_CASE("real pastes: near the boundary no more distortion than the bounds") {
    for (const RealPaste& real : real_pastes()) {
        CAPTURE(real.name);
        const auto models = models_of(real);
        if (!models) continue;
        Paste paste = placed(real, *models);
        PasteMergeOptions as_marked, whole;
        as_marked.compare = whole.find_intersections = false;
        as_marked.draft = true;
        const PasteResult marked = paste.merge(as_marked);
        paste.optimize();
        const PasteResult result = paste.merge(whole);
        check_sound(result, *models);
        CHECK(result.report.near.energy <= real.energy);
        REQUIRE(result.report.outline_near);
        CHECK(result.report.outline_near->energy ==
              doctest::Approx(marked.report.near.energy).epsilon(1e-6));
        CHECK(result.report.near.energy <= result.report.outline_near->energy);
        // What is not better than the outline as it was marked is the outline.
        if (result.report.near.energy == result.report.outline_near->energy) {
            CHECK(result.report.kept_outline);
        }
    }
}

TEST_CASE("real pastes: the energy never increases, at twelve angles") {
    int first = 0;
    for (const RealPaste& real : real_pastes()) {
        CAPTURE(real.name);
        const auto models = models_of(real);
        if (!models) continue;
        Paste paste = placed(real, *models);
        // Three of the angles for each paste; four pastes have all of them.
        for (int k = first++ % 4; k < 12; k += 4) {
            PastePlacement turned = real.placement;
            turned.angle = k * kPi / 6.0;
            paste.move(turned);
            paste.optimize();
            const std::vector<double>& energy = paste.search().energy;
            for (std::size_t i = 1; i < energy.size(); ++i) {
                CHECK(energy[i] <= energy[i - 1] * (1.0 + 1e-12));
            }
        }
    }
}

TEST_CASE("real pastes: the loop is the cheapest, by brute force") {
    for (const RealPaste& real : real_pastes()) {
        CAPTURE(real.name);
        const auto models = models_of(real);
        if (!models) continue;
        const Mesh &source = models->source, &target = models->target;
        const PasteRegions regions =
            paste_regions(source, {real.region(source), real.feature(source)}, {});
        const PasteSurfaces surfaces(source, target);
        const PasteChart chart = source_chart(source, regions, ParameterizeMethod::arap, {});
        const SurfacePoint point = surfaces.target_tree.nearest(real.placement.at);
        const double radius = 2.0 * real.placement.scale * chart.length_ratio * chart.reach;
        const PasteMap map(surfaces, chart,
                           target_chart(target, disk_around(target, point, radius, {}),
                                        ParameterizeMethod::arap, {}),
                           false);
        const LoopSearch ring(source, regions, {});
        std::vector<Vec2> plane(source.positions().size(), Vec2::Zero());
        for (std::size_t k = 0; k < chart.map.vertex.size(); ++k) {
            plane[static_cast<std::size_t>(chart.map.vertex[k])] = chart.map.uv[k];
        }
        const RingTriangles triangles(chart, regions);
        for (int k = 0; k < 12; ++k) {
            const std::vector<ImagePoint> images =
                map.images(map.planar(real.placement, k * kPi / 6.0));
            PasteEnergy energy(ring_edges(map, ring, images), {});
            const std::vector<Index> inner = energy.edges_of(ring, regions.inner);
            if (inner.empty()) continue;
            const std::vector<double> cost = energy.costs(energy.start(inner));
            const double least = cheapest_by_force(ring.edges(), plane, triangles.middle, cost);
            const std::vector<Index> loop = ring.cheapest(cost, {});
            REQUIRE(!loop.empty());
            CHECK(std::set<Index>(loop.begin(), loop.end()).size() == loop.size());
            CHECK(winding_of(plane, triangles.middle, loop) == 1);
            CHECK(energy.energy(energy.edges_of(ring, loop), energy.start(inner)) ==
                  doctest::Approx(least).epsilon(1e-9));
        }
    }
}
