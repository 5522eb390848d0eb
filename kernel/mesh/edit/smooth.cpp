#include "kernel/mesh/edit/smooth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/mesh/measure/directions.h"
#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

constexpr double kPassBand = 0.1;
constexpr Index kGrain = 4096;

// For each vertex the neighbours whose weighted mean it moves to; none for one that stays.
struct Stencils {
    struct Entry {
        Index vertex;
        double weight;
    };
    std::vector<std::vector<Entry>> of_vertex;

    void add(Index v, Index neighbor, double weight) {
        std::vector<Entry>& list = of_vertex[v];
        const auto same = std::find_if(list.begin(), list.end(),
                                       [&](const Entry& e) { return e.vertex == neighbor; });
        if (same == list.end()) {
            list.push_back({neighbor, weight});
        } else {
            same->weight += weight;
        }
    }
    void normalize() {
        for (std::vector<Entry>& list : of_vertex) {
            double sum = 0.0;
            for (Entry& e : list) sum += e.weight = std::max(0.0, e.weight);
            if (!(sum > 0.0)) list.clear();
            for (Entry& e : list) e.weight /= sum;
        }
    }
};

double cotangent(const Vec3& a, const Vec3& b) {
    const double area = a.cross(b).norm();
    return area > 0.0 ? a.dot(b) / area : 0.0;
}

void add_cotangents(const Mesh& mesh, Stencils& stencils) {
    for (const Triangle& t : triangulate_faces(mesh.topology(), mesh.positions()).triangles) {
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const double weight =
                cotangent(mesh.position(a) - mesh.position(c), mesh.position(b) - mesh.position(c));
            stencils.add(a, b, weight);
            stencils.add(b, a, weight);
        }
    }
}

void add_uniform(const Topology& topology, Stencils& stencils) {
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        for (const Index n : topology.neighbors(v)) stencils.of_vertex[v].push_back({n, 1.0});
    }
}

void set_boundary(const Topology& topology, SmoothBoundary rule, Stencils& stencils) {
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        if (!topology.is_boundary(v)) continue;
        // The neighbours along the boundary are the first and the last of the ring.
        const std::span<const Index> ring = topology.neighbors(v);
        stencils.of_vertex[v].clear();
        if (rule == SmoothBoundary::fixed) continue;
        stencils.of_vertex[v] = {{ring.front(), 1.0}, {ring.back(), 1.0}};
    }
}

Stencils stencils_for(const Mesh& mesh, const SmoothOptions& options) {
    Stencils stencils;
    stencils.of_vertex.resize(mesh.vertex_count());
    if (options.weights == SmoothWeights::cotangent) {
        add_cotangents(mesh, stencils);
    } else {
        add_uniform(mesh.topology(), stencils);
    }
    set_boundary(mesh.topology(), options.boundary, stencils);
    if (options.region) {
        const std::vector<char> in = options.region->mask();
        for (std::size_t v = 0; v < in.size(); ++v) {
            if (!in[v]) stencils.of_vertex[v].clear();
        }
    }
    stencils.normalize();
    return stencils;
}

void step(const Stencils& stencils, double strength, std::vector<Vec3>& positions,
          std::vector<Vec3>& next, const Context& context) {
    context.parallel_for(0, count_of(positions), kGrain, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            const auto& stencil = stencils.of_vertex[v];
            next[v] = positions[v];
            if (stencil.empty()) continue;
            Vec3 mean = Vec3::Zero();
            for (const auto& [n, weight] : stencil) mean += weight * positions[n];
            next[v] += strength * (mean - positions[v]);
        }
    });
    positions.swap(next);
}

void check(const Mesh& mesh, const SmoothOptions& options) {
    if (options.iterations < 0 || !(options.strength > 0.0 && options.strength <= 1.0)) {
        throw Error(ErrorCode::invalid_argument,
                    "smoothing needs iterations of 0 or more and a strength above 0, at most 1");
    }
    if (options.region) require_same_topology(mesh, options.region->topology(), "the region");
}

}  // namespace

void smooth(Mesh& mesh, const SmoothOptions& options, const Context& context) {
    check(mesh, options);
    Progress progress(context, "smooth");
    // A list of neighbours and their weights for each vertex, and positions three times.
    constexpr std::size_t kBytesPerVertex = 300;
    const MemoryCharge working =
        context.charge(kBytesPerVertex * at(mesh.vertex_count()), "smoothing a mesh");
    const DirectionCarrier directions(mesh);
    const Stencils stencils = stencils_for(mesh, options);
    // Taubin's second factor: 1 / strength + 1 / outward = pass band.
    const double outward = 1.0 / (kPassBand - 1.0 / options.strength);
    const std::int64_t steps = std::int64_t{options.iterations} * (1 + morph_count(mesh));
    std::int64_t done = 0;
    const auto smoothed = [&](std::vector<Vec3> x) {
        std::vector<Vec3> next = x;
        for (Index i = 0; i < options.iterations; ++i) {
            progress.update(done++, steps);
            step(stencils, options.strength, x, next, context);
            if (options.keep_volume) step(stencils, outward, x, next, context);
        }
        return x;
    };
    const MorphColumns morphs = mapped_morphs(mesh, smoothed);
    mesh.set_positions(smoothed({mesh.positions().begin(), mesh.positions().end()}));
    set_morphs(mesh, morphs);
    directions.follow(mesh);
}

}  // namespace lissom
