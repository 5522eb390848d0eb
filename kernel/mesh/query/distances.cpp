#include "kernel/mesh/query/distances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/intrinsic_delaunay.h"
#include "kernel/mesh/query/shortest_path.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Heat falls by e with every sqrt(t) of distance and must not fall below the range of a double.
constexpr double kMaximumDecay = 600.0;

// Memory of the surface, and the entries of two matrices while they are gathered.
constexpr std::size_t kSurfaceBytesPerCorner = 64, kTripletBytesPerTriangle = 700;

// An upper bound of the distance between any two vertices of a component.
double diameter_bound(const Mesh& mesh, const Context& context) {
    const std::vector<Index>& components = mesh.topology().components();
    std::vector<Index> first;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (components[v] == count_of(first)) first.push_back(v);
    }
    double farthest = 0.0;
    for (const double d : edge_distances(mesh, first, kInfinity, context)) {
        farthest = std::max(farthest, d);
    }
    return 2.0 * farthest;
}

// The pinned unknowns are replaced by identity rows: their values become those of the right side.
SymmetricMatrix assemble(Index size, std::vector<Triplet> entries,
                         const std::vector<char>& pinned) {
    std::erase_if(entries, [&](const Triplet& e) { return pinned[e.row] || pinned[e.column]; });
    for (Index v = 0; v < size; ++v) {
        if (pinned[v]) entries.push_back({v, v, 1.0});
    }
    return symmetric_from_triplets(size, entries);
}

void prepare(SparseSystem& system, const SymmetricMatrix& matrix, const Context& context) {
    system.analyze(matrix, context);
    system.factor(matrix, context);
}

Vec2 turned(const Vec2& v) {
    return {-v.y(), v.x()};
}

struct HeatEntries {
    std::vector<Triplet> laplacian, heat;
};

// The cotangent Laplacian, and the heat operator: lumped areas plus the time times the Laplacian.
HeatEntries heat_entries(const IntrinsicDelaunay& surface, double time) {
    HeatEntries entries;
    for (std::size_t i = 0; i < surface.triangles().size(); ++i) {
        const Triangle& t = surface.triangles()[i];
        const std::array<double, 3> cotangent = surface.cotangents(i);
        const double third = surface.area(i) / 3.0;
        for (int s = 0; s < 3; ++s) {
            entries.heat.push_back({t[s], t[s], third});
            const Index a = t[s], b = t[(s + 1) % 3];
            if (a == b) continue;
            const double weight = 0.5 * cotangent[(s + 2) % 3];
            for (const Triplet& e : {Triplet{a, a, weight}, Triplet{b, b, weight},
                                     Triplet{std::max(a, b), std::min(a, b), -weight}}) {
                entries.laplacian.push_back(e);
                entries.heat.push_back({e.row, e.column, time * e.value});
            }
        }
    }
    return entries;
}

std::vector<char> isolated_vertices(const Topology& topology) {
    std::vector<char> isolated(topology.vertex_count(), 0);
    for (Index v = 0; v < topology.vertex_count(); ++v) isolated[v] = topology.is_isolated(v);
    return isolated;
}

void require_edge_limit(double limit) {
    if (limit >= 0.0) return;
    throw Error(ErrorCode::invalid_argument, "the limit of a distance must be 0 or more");
}

}  // namespace

std::vector<double> edge_distances(const Mesh& mesh, std::span<const Index> sources, double limit,
                                   const Context& context) {
    require_vertices(mesh.topology(), sources);
    require_edge_limit(limit);
    return ShortestPaths(mesh).from(sources, limit, context);
}

std::vector<double> edge_distances(const Mesh& mesh, const SurfacePoint& point, double limit,
                                   const Context& context) {
    require_vertices(mesh.topology(), point.triangle);
    require_edge_limit(limit);
    std::vector<double> shortest(mesh.vertex_count(), kInfinity);
    ShortestPaths paths(mesh);
    for (const Index corner : point.triangle) {
        const double first = (mesh.position(corner) - point.position).norm();
        if (first > limit) continue;
        const std::vector<double>& further = paths.from(std::array{corner}, limit, context);
        for (std::size_t v = 0; v < shortest.size(); ++v) {
            const double way = first + further[v];
            if (way <= limit) shortest[v] = std::min(shortest[v], way);
        }
    }
    return shortest;
}

struct HeatDistances::State {
    State(const Mesh& given, const Context& context);

    void build_systems(const Context& context);
    void find_pins();
    std::vector<double> diffuse(std::span<const Index> sources,
                                std::span<const double> weights) const;
    std::vector<double> up_to_a_constant(std::span<const Index> sources,
                                         std::span<const double> weights,
                                         const Context& context) const;
    std::vector<double> divergence_of_directions(const std::vector<double>& heat,
                                                 const Context& context) const;
    void shift_to_sources(std::vector<double>& distance, std::span<const Index> sources) const;

    // Positions and topology alone.
    Mesh shape;
    const Topology* topology;
    // Memory of the surface. Its edges may be others than the mesh's.
    MemoryCharge charge;
    IntrinsicDelaunay surface;
    // Without a boundary, the second of these is not used.
    SparseSystem heat_free, heat_cold, poisson;
    std::vector<char> on_boundary, poisson_pinned;
};

HeatDistances::State::State(const Mesh& given, const Context& context)
    : shape({given.positions().begin(), given.positions().end()}, given.shared_topology()),
      topology(&shape.topology()),
      charge(context.charge(kSurfaceBytesPerCorner * at(topology->corner_count()),
                            "geodesic distances")),
      surface(triangulate_faces(*topology, shape.positions()).triangles, shape.positions(),
              context) {
    build_systems(context);
}

void HeatDistances::State::build_systems(const Context& context) {
    const Index n = topology->vertex_count();
    const MemoryCharge working =
        context.charge(kTripletBytesPerTriangle * surface.triangles().size(), "geodesic distances");
    const double decay =
        std::max(surface.mean_length(), diameter_bound(shape, context) / kMaximumDecay);
    const HeatEntries entries = heat_entries(surface, decay * decay);
    find_pins();

    Progress progress(context, "geodesic distances: prepare");
    progress.step(0.35);
    prepare(heat_free, assemble(n, entries.heat, isolated_vertices(*topology)), context);
    progress.step(0.35);
    if (!topology->is_closed()) {
        prepare(heat_cold, assemble(n, entries.heat, on_boundary), context);
    }
    progress.step(0.3);
    prepare(poisson, assemble(n, entries.laplacian, poisson_pinned), context);
}

// One vertex of each component is pinned in the Poisson equation.
void HeatDistances::State::find_pins() {
    const Index n = topology->vertex_count();
    on_boundary.assign(n, 0);
    poisson_pinned.assign(n, 0);
    std::vector<char> pinned_component(topology->component_count(), 0);
    for (Index v = 0; v < n; ++v) {
        on_boundary[v] = topology->is_isolated(v) || topology->is_boundary(v);
        poisson_pinned[v] = !std::exchange(pinned_component[topology->components()[v]], 1);
    }
}

std::vector<double> HeatDistances::State::diffuse(std::span<const Index> sources,
                                                  std::span<const double> weights) const {
    const std::size_t n = topology->vertex_count();
    std::vector<double> start(n, 0.0), heat(n, 0.0);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        start[sources[i]] = weights.empty() ? 1.0 : weights[i];
    }
    heat_free.solve(start, heat, 1);
    if (topology->is_closed()) return heat;
    // The mean of a boundary that keeps all heat in and one that is kept cold (section 3.3.1).
    std::vector<double> cold(n, 0.0);
    for (std::size_t v = 0; v < n; ++v) start[v] = on_boundary[v] ? 0.0 : start[v];
    heat_cold.solve(start, cold, 1);
    for (std::size_t v = 0; v < n; ++v) heat[v] = 0.5 * (heat[v] + cold[v]);
    return heat;
}

std::vector<double> HeatDistances::State::divergence_of_directions(const std::vector<double>& heat,
                                                                   const Context& context) const {
    std::vector<double> divergence(heat.size(), 0.0);
    for (std::size_t i = 0; i < surface.triangles().size(); ++i) {
        if (i % 65536 == 0) context.checkpoint();
        const Triangle& t = surface.triangles()[i];
        // Heat far from the sources is tiny; only its proportions within the triangle matter.
        const double largest = std::max({heat[t[0]], heat[t[1]], heat[t[2]]});
        if (!(largest > 0.0)) continue;
        const std::array<Vec2, 3> p = surface.layout(i);
        Vec2 gradient = Vec2::Zero();
        for (int s = 0; s < 3; ++s) {
            gradient += heat[t[s]] / largest * turned(p[(s + 2) % 3] - p[(s + 1) % 3]);
        }
        const double size = gradient.norm();
        if (!(size > 0.0)) continue;
        const Vec2 away = -gradient / size;
        const std::array<double, 3> cotangent = surface.cotangents(i);
        for (int s = 0; s < 3; ++s) {
            const int u = (s + 1) % 3, v = (s + 2) % 3;
            divergence[t[s]] += 0.5 * (cotangent[v] * (p[u] - p[s]).dot(away) +
                                       cotangent[u] * (p[v] - p[s]).dot(away));
        }
    }
    return divergence;
}

// Distances, but for a constant in each component. Sources weigh alike if no weights are given.
std::vector<double> HeatDistances::State::up_to_a_constant(std::span<const Index> sources,
                                                           std::span<const double> weights,
                                                           const Context& context) const {
    const std::vector<double> heat = diffuse(sources, weights);
    context.checkpoint();
    std::vector<double> distance = divergence_of_directions(heat, context);
    // The Laplacian here is positive, minus that of the paper.
    for (std::size_t v = 0; v < distance.size(); ++v) {
        distance[v] = poisson_pinned[v] ? 0.0 : -distance[v];
    }
    poisson.solve(distance, distance, 1);
    return distance;
}

// The Poisson system leaves a constant open in each component: there the sources' mean becomes 0.
void HeatDistances::State::shift_to_sources(std::vector<double>& distance,
                                            std::span<const Index> sources) const {
    const std::vector<Index>& components = topology->components();
    std::vector<double> sum(topology->component_count(), 0.0);
    std::vector<Index> count(sum.size(), 0);
    for (const Index v : sources) {
        sum[components[v]] += distance[v];
        ++count[components[v]];
    }
    for (std::size_t v = 0; v < distance.size(); ++v) {
        const Index c = components[v];
        distance[v] = count[c] == 0 ? kInfinity : std::max(0.0, distance[v] - sum[c] / count[c]);
    }
    for (const Index v : sources) distance[v] = 0.0;
}

HeatDistances::HeatDistances(const Mesh& mesh, const Context& context) {
    if (mesh.face_count() == 0) {
        throw Error(ErrorCode::mesh_empty, "distances over a surface need a mesh with faces");
    }
    state_ = std::make_unique<State>(mesh, context);
}

HeatDistances::~HeatDistances() = default;
HeatDistances::HeatDistances(HeatDistances&&) noexcept = default;
HeatDistances& HeatDistances::operator=(HeatDistances&&) noexcept = default;

std::vector<double> HeatDistances::from(std::span<const Index> sources,
                                        const Context& context) const {
    require_vertices(*state_->topology, sources);
    if (sources.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    "distances need at least one vertex to start from");
    }
    std::vector<double> distance = state_->up_to_a_constant(sources, {}, context);
    state_->shift_to_sources(distance, sources);
    // Heat overshoots behind narrow parts; no geodesic is longer than a way along edges.
    const std::vector<double> bound = edge_distances(state_->shape, sources, kInfinity, context);
    for (std::size_t v = 0; v < distance.size(); ++v) distance[v] = std::min(distance[v], bound[v]);
    return distance;
}

// The mean of the triangle's corners fixes the constant; within a step of the point heat says
// nothing, and distances are at least the straight ones.
std::vector<double> HeatDistances::from_point(const SurfacePoint& point,
                                              const Context& context) const {
    const Triangle& corners = point.triangle;
    require_vertices(*state_->topology, corners);
    const std::span<const double> weights(point.barycentric.data(), 3);
    std::vector<double> distance = state_->up_to_a_constant(corners, weights, context);
    const auto straight = [&](std::size_t v) {
        return (state_->shape.position(index_of(v)) - point.position).norm();
    };
    double constant = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = corners[k];
        constant += weights[k] * (distance[v] - straight(v));
    }
    const std::vector<double> bound = edge_distances(state_->shape, point, kInfinity, context);
    for (std::size_t v = 0; v < distance.size(); ++v) {
        const bool out_of_reach = std::isinf(bound[v]);
        distance[v] = out_of_reach
                          ? kInfinity
                          : std::min(std::max(distance[v] - constant, straight(v)), bound[v]);
    }
    return distance;
}

std::vector<double> heat_distances(const Mesh& mesh, std::span<const Index> sources,
                                   const Context& context) {
    require_vertices(mesh.topology(), sources);
    return HeatDistances(mesh, context).from(sources, context);
}

}  // namespace lissom
