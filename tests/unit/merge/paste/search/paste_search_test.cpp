// The search for a boundary: around the feature, simple, and never dearer than before.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>

#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/paste/search/paste_energy.h"
#include "kernel/merge/paste/search/winding_graph.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/merge/paste/search/loop_force.h"
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
    const PasteRegions regions = paste_regions(mesh, {around_horn(mesh), std::nullopt, 0.6}, {});
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

namespace {

// Rows of a random annulus around the origin, from the inside out, and a fan in its middle.
struct Annulus {
    Mesh mesh;
    PasteRegions regions;
};

Annulus random_annulus(std::mt19937& random) {
    const auto draw = [&](Index least, Index most) {
        return std::uniform_int_distribution<Index>(least, most)(random);
    };
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Index around = draw(4, 9), rows = draw(2, 6);
    std::vector<Vec3> positions{Vec3::Zero()};
    for (Index r = 0; r < rows; ++r) {
        for (Index k = 0; k < around; ++k) {
            const double angle = 2.0 * kPi * (k + 0.6 * unit(random)) / around;
            const double radius = 1.0 + r + 0.6 * unit(random);
            positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        }
    }
    const auto vertex = [&](Index r, Index k) { return 1 + r * around + k % around; };
    FaceList faces;
    Annulus result;
    for (Index k = 0; k < around; ++k) {
        result.regions.feature.push_back(k);
        result.regions.inner.push_back(vertex(0, k));
        result.regions.outer.push_back(vertex(rows - 1, k));
        faces.add({0, vertex(0, k), vertex(0, k + 1)});
    }
    for (Index r = 0; r + 1 < rows; ++r) {
        for (Index k = 0; k < around; ++k) {
            const Index a = vertex(r, k), b = vertex(r, k + 1), c = vertex(r + 1, k + 1),
                        d = vertex(r + 1, k);
            if (unit(random) < 0.2) {
                faces.add({a, d, c, b});
            } else if (unit(random) < 0.5) {
                faces.add({a, d, c});
                faces.add({a, c, b});
            } else {
                faces.add({a, d, b});
                faces.add({d, c, b});
            }
        }
    }
    result.mesh = Mesh(std::move(positions), std::move(faces));
    for (Index f = 0; f < result.mesh.face_count(); ++f) {
        result.regions.region.push_back(f);
        if (f >= around) result.regions.ring.push_back(f);
    }
    return result;
}

}  // namespace

TEST_CASE("loop search: two vertices are joined where a face of the ring has them side by side") {
    std::mt19937 random(11);
    for (int round = 0; round < 20; ++round) {
        const Annulus annulus = random_annulus(random);
        const LoopSearch search(annulus.mesh, annulus.regions, {});
        std::set<std::pair<Index, Index>> sides;
        for (const Index f : annulus.regions.ring) {
            const std::span<const Index> face = annulus.mesh.topology().face(f);
            for (std::size_t k = 0; k < face.size(); ++k) {
                sides.insert(std::minmax(face[k], face[(k + 1) % face.size()]));
            }
        }
        REQUIRE(search.edges().size() == sides.size());
        for (Index a = 0; a < annulus.mesh.vertex_count(); ++a) {
            for (Index b = 0; b < annulus.mesh.vertex_count(); ++b) {
                const Index e = search.edge_between(a, b);
                const std::pair<Index, Index> pair = std::minmax(a, b);
                CHECK((e != kNoIndex) == sides.contains(pair));
                if (e != kNoIndex) CHECK(search.edges()[at(e)] == pair);
            }
        }
    }
}

namespace {

Mat3 random_rotation(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Vec3 axis(normal(random), normal(random), normal(random));
    return Eigen::AngleAxisd(1.1, axis.normalized()).toRotationMatrix();
}

// Edges that a similarity maps, but for every fourth, whose image is any other.
std::vector<RingEdge> mapped_edges(const PasteSimilarity& similarity, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const auto draw = [&] { return Vec3(normal(random), normal(random), normal(random)); };
    std::vector<RingEdge> edges(40);
    for (std::size_t k = 0; k < edges.size(); ++k) {
        edges[k].inside = true;
        edges[k].edge = draw();
        edges[k].image = similarity.scale * similarity.rotation * edges[k].edge;
        edges[k].source_normal = draw().normalized();
        edges[k].target_normal = similarity.rotation * edges[k].source_normal;
        if (k % 4 != 0) continue;
        edges[k].image += 0.7 * similarity.scale * draw();
        edges[k].target_normal = (edges[k].target_normal + 0.4 * draw()).normalized();
    }
    return edges;
}

double error_of(const PasteSimilarity& found, const PasteSimilarity& wanted) {
    return (found.rotation - wanted.rotation).norm() + std::abs(found.scale / wanted.scale - 1.0);
}

}  // namespace

TEST_CASE("paste energy: a few edges that do not fit do not turn the similarity of all others") {
    std::mt19937 random(13);
    for (const double scale : {0.01, 1.0, 30.0}) {
        for (const double normals : {0.0, 0.3}) {
            CAPTURE(scale);
            CAPTURE(normals);
            const PasteSimilarity wanted{random_rotation(random), scale};
            EnergyOptions options;
            options.normals = normals;
            PasteEnergy energy(mapped_edges(wanted, random), options);
            std::vector<Index> edges(40);
            std::iota(edges.begin(), edges.end(), 0);
            const PasteSimilarity first = energy.start(edges);
            PasteSimilarity found = first;
            for (int round = 0; round < 20; ++round) {
                const PasteSimilarity next = energy.improved(edges, found);
                CHECK(energy.energy(edges, next) <= energy.energy(edges, found));
                found = next;
            }
            CHECK(error_of(first, wanted) > 0.02);
            CHECK(error_of(found, wanted) < 0.02 * error_of(first, wanted));
        }
    }
}

TEST_CASE("loop search: equal to brute force on 4000 random annuli") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Index found = 0, without = 0;
    for (int round = 0; round < 4000; ++round) {
        const Annulus annulus = random_annulus(random);
        const LoopSearch search(annulus.mesh, annulus.regions, {});
        // Even costs, costs over four decades, and edges that must not be used.
        const double power = 6.0 * unit(random), absent = round % 2 ? 0.3 * unit(random) : 0.0;
        std::vector<double> cost;
        for (std::size_t e = 0; e < search.edges().size(); ++e) {
            cost.push_back(unit(random) < absent ? std::numeric_limits<double>::infinity()
                                                 : std::pow(0.2 + 0.8 * unit(random), power));
        }
        std::vector<Vec2> plane;
        for (const Vec3& p : annulus.mesh.positions()) plane.emplace_back(p.x(), p.y());
        const double least = cheapest_by_force(search.edges(), plane, Vec2::Zero(), cost);
        const std::vector<Index> loop = search.cheapest(cost, {});
        CAPTURE(round);
        if (!std::isfinite(least)) {
            CHECK(loop.empty());
            ++without;
            continue;
        }
        ++found;
        REQUIRE(loop.size() >= 3);
        CHECK(std::set<Index>(loop.begin(), loop.end()).size() == loop.size());
        CHECK(winding_of(plane, Vec2::Zero(), loop) == 1);
        CHECK(cost_of(search, cost, loop) == doctest::Approx(least).epsilon(1e-12));
        // Loops that are known shorten the search, and change nothing.
        for (const std::vector<Index>& known : {annulus.regions.outer, loop}) {
            if (!std::isfinite(cost_of(search, cost, known))) continue;
            const double again = cost_of(search, cost, search.cheapest(cost, known, {}));
            CHECK(again == doctest::Approx(least).epsilon(1e-12));
        }
    }
    CHECK(found > 3000);
    CHECK(without > 0);
}

TEST_CASE("winding search: bounds leave nothing out, whether edges cross one another or not") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 1000; ++round) {
        const Annulus annulus = random_annulus(random);
        const std::span<const Vec3> positions = annulus.mesh.positions();
        std::vector<WindingEdge> edges;
        std::vector<double> cost;
        std::vector<Index> starts;
        const auto add = [&](Index a, Index b) {
            const int turns =
                crossing(positions[at(a)].head<2>(), positions[at(b)].head<2>(), Vec2::Zero());
            edges.push_back({a, b, turns});
            cost.push_back(0.05 + unit(random));
            if (turns != 0) starts.push_back(turns > 0 ? a : b);
        };
        for (const Index f : annulus.regions.ring) {
            const std::span<const Index> face = annulus.mesh.topology().face(f);
            for (std::size_t i = 0; i < face.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) add(face[j], face[i]);
            }
        }
        const WindingGraph graph(annulus.mesh.vertex_count(), edges);
        WindingSearch plain(graph, cost), bounded(graph, cost);
        double least = std::numeric_limits<double>::infinity();
        for (const Index start : starts) least = std::min(least, plain.through(start).cost);
        bounded.bound(starts, least * 1.0001);
        double found = std::numeric_limits<double>::infinity();
        for (const Index start : starts) {
            const double cheapest = plain.through(start).cost;
            const double bound = bounded.min_through(start);
            CHECK((bound <= cheapest * (1.0 + 1e-12) || cheapest > least));
            found = std::min(found, bounded.through(start, {}, least * 1.0001).cost);
        }
        CHECK(found == doctest::Approx(least).epsilon(1e-12));
    }
}

TEST_CASE("paste search: what normals weigh more, the best loop has less of") {
    const Mesh horn = horned_ball(), target = egg();
    const PasteRegions regions = paste_regions(horn, {around_horn(horn)}, {});
    const PasteSurfaces surfaces(horn, target);
    const Vec3 at(1, 1.2, 0.8);
    const PasteMap map(
        surfaces, source_chart(horn, regions, ParameterizeMethod::arap, {}),
        target_chart(target, select_sphere(target, at, 1.2).faces(), ParameterizeMethod::arap, {}),
        false);
    const std::vector<ImagePoint> images = map.images(map.planar({.at = at, .scale = 0.8}, 0.3));
    const LoopSearch ring(horn, regions, {});
    PasteSimilarity similarity;
    double last = std::numeric_limits<double>::infinity(), first = 0.0;
    for (const double weight : {0.0, 0.1, 0.3, 3.0}) {
        EnergyOptions options;
        options.normals = weight;
        PasteEnergy energy(ring_edges(map, ring, images), options);
        const std::vector<Index> outline = energy.edges_of(ring, regions.inner);
        REQUIRE(!outline.empty());
        const PasteSimilarity start = energy.start(outline);
        if (weight == 0.0) similarity = start;
        // What both have in common is left when that of other weights is taken away.
        const std::vector<Index> loop = ring.cheapest(energy.costs(similarity), {});
        EnergyOptions alone, with;
        with.normals = 1.0;
        PasteEnergy plain(ring_edges(map, ring, images), alone);
        PasteEnergy both(ring_edges(map, ring, images), with);
        plain.fix_weights(similarity.scale);
        both.fix_weights(similarity.scale);
        const std::vector<Index> edges = both.edges_of(ring, loop);
        const double turned = both.energy(edges, similarity) - plain.energy(edges, similarity);
        CHECK(turned <= last * (1.0 + 1e-12));
        if (weight == 0.0) first = turned;
        last = turned;
    }
    CHECK(last < 0.95 * first);
}

TEST_CASE("paste search: one entry of the report for each iteration, as many as are wanted") {
    const Mesh horn = horned_ball(), target = egg();
    PasteOptions options;
    options.correspondence = PasteCorrespondence::map;
    Paste paste =
        horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .angle = 0.3, .scale = 0.8}, options);
    paste.optimize();
    const PasteSearch all = paste.search();
    REQUIRE(all.energy.size() > 2);
    CHECK(all.misfit.size() == all.energy.size());
    for (Index wanted = 1; wanted < count_of(all.energy); ++wanted) {
        paste.optimize(wanted);
        const PasteSearch& some = paste.search();
        REQUIRE(count_of(some.energy) == wanted + 1);
        CHECK(std::equal(some.energy.begin(), some.energy.end(), all.energy.begin()));
        CHECK(std::equal(some.misfit.begin(), some.misfit.end(), all.misfit.begin()));
        if (wanted + 1 < count_of(all.energy)) CHECK(some.stop == PasteStop::iterations);
    }
    CHECK(error_of([&] { paste.optimize(0); }).code() == ErrorCode::invalid_argument);
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
