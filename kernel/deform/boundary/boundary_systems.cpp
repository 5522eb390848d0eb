#include "kernel/deform/boundary/boundary_systems.h"

#include <algorithm>
#include <cmath>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/hubs.h"

namespace lissom {
namespace {

// Rings around the region that the stencils of its vertices reach.
constexpr Index kRings = 1;

DeformOptions deform_options(const BoundaryDeformOptions& options) {
    DeformOptions result;
    result.second = options.second;
    result.local_size = LocalSize::scale;
    result.weights = options.weights;
    result.coherence = options.coherence;
    result.coherence_weight = options.coherence_weight;
    result.degenerate_threshold = options.degenerate_threshold;
    result.displacement = options.displacement;
    result.scale_free = options.scale_free;
    result.subdivide_borders = false;
    result.flat = FlatVertices::displaced;
    return result;
}

BoundaryFrame frame_of(const Mesh& mesh, const Region& region, const Region& held) {
    BoundaryFrame frame;
    const Vec3 first = mesh.position(held.vertices().front());
    Vec3 sum = Vec3::Zero();
    for (const Index v : held.vertices()) sum += mesh.position(v) - first;
    frame.center = first + sum / held.size();
    double squares = 0.0;
    for (const Index v : region.vertices()) {
        squares += (mesh.position(v) - frame.center).squaredNorm();
    }
    if (squares > 0.0) frame.unit = std::sqrt(squares / region.size());
    return frame;
}

std::vector<Vec3> positions_in(const BoundaryFrame& frame, std::span<const Vec3> positions) {
    std::vector<Vec3> result;
    result.reserve(positions.size());
    for (const Vec3& p : positions) result.push_back((p - frame.center) / frame.unit);
    return result;
}

void require_area_of_faces(const Patch& patch) {
    const Elements& vertices = patch.zero_area_vertices;
    if (vertices.count == 0) return;
    throw Error(
        ErrorCode::zero_area,
        "all faces around " + describe(vertices) + " have no area; collapse those faces first",
        vertices);
}

// Local vertices of a part of the region.
std::vector<Index> local_vertices(const Patch& patch, const Region& region, const Region& part) {
    const std::vector<Index>& ids = region.vertices();
    std::vector<Index> result;
    for (const Index v : part.vertices()) {
        result.push_back(
            patch.of_region[std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()]);
    }
    return result;
}

std::vector<std::vector<Index>> local_features(const Patch& patch, const Region& region,
                                               const std::vector<Region>& features) {
    std::vector<std::vector<Index>> result;
    for (const Region& feature : features) {
        if (!feature.empty()) result.push_back(local_vertices(patch, region, feature));
    }
    return result;
}

// A vertex that stays: outside the region, or without faces.
bool stays(const WorkingPatch& work, Index v) {
    return !work.patch.in_region[v] || work.rings.count(v) == 0;
}

bool is_surrounded(const WorkingPatch& work) {
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        if (stays(work, v) && work.rings.count(v) > 0) return true;
    }
    return false;
}

// Held vertices take their values.
KnownMask known_without_features(const WorkingPatch& work, const std::vector<Index>& held) {
    const std::size_t n = work.patch.vertex_count;
    KnownMask known{std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 0)};
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        if (stays(work, v)) known.position[v] = known.gradient[v] = 1;
    }
    for (const Index v : held) known.position[v] = known.gradient[v] = 1;
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        known.gradient_wanted[v] = !known.gradient[v] && work.rings.count(v) > 0;
    }
    return known;
}

// Features are known to the systems; their values are found afterwards.
KnownMask with_features(KnownMask known, const std::vector<std::vector<Index>>& features) {
    for (const std::vector<Index>& feature : features) {
        for (const Index v : feature) {
            known.position[v] = known.gradient[v] = 1;
            known.gradient_wanted[v] = 0;
        }
    }
    return known;
}

template <typename System>
void factor_if_free(System& system, const Context& context) {
    if (!system.free_vertices().empty()) system.factor(context);
}

}  // namespace

BoundarySystems::BoundarySystems(const Mesh& mesh, const Region& given, const Region& fixed,
                                 const BoundaryDeformOptions& chosen, const Context& context)
    : region(given),
      held(fixed),
      size_field(chosen.size),
      options(deform_options(chosen)),
      frame(frame_of(mesh, given, fixed)),
      work(build_patch(given, positions_in(frame, mesh.positions()), kRings,
                       near_order(given, kRings)),
           options) {
    Progress progress(context, "deform: prepare");
    require_area_of_faces(work.patch);
    held_local = local_vertices(work.patch, region, held);
    feature_local = local_features(work.patch, region, chosen.features);
    surrounded = is_surrounded(work);
    known = known_without_features(work, held_local);
    require_constraints(work, known);
    known = with_features(std::move(known), feature_local);
    progress.step(0.3);
    assemble(context);
    progress.step(0.7);
    factor(context);
    common->prepare(context);
}

void BoundarySystems::assemble(const Context& context) {
    const auto start = Clock::now();
    const MemoryCharge charge = charge_hubs(work.patch, work.rings, context);
    stencils =
        make_gradients(work.patch, work.rings, work.geometry, known, -work.patch.origin, options);
    first = std::make_unique<GradientSystem>(work, stencils, known, options, context);
    second = std::make_unique<RotationSystem>(work, known.position, options, context);
    residual = std::make_unique<GradientResidual>(work, stencils, known, options);
    common = std::make_unique<CommonGradients>(work, feature_local, *first, *residual, *second);
    stats.assemble_seconds = seconds_since(start);
}

void BoundarySystems::factor(const Context& context) {
    // The two do not depend on each other.
    context.parallel_for(0, 2, 1, [&](Index begin, Index end) {
        for (Index system = begin; system < end; ++system) {
            system == 0 ? factor_if_free(*first, context) : factor_if_free(*second, context);
        }
    });
    if (has_free()) second->finish(context);
    const FactorStats &a = first->stats(), &b = second->stats();
    stats.region_vertices = region.size();
    stats.constrained_vertices = held.size();
    stats.free_vertices = count_of(second->free_vertices());
    stats.displaced_vertices = count_of(stencils.displaced);
    stats.zero_area_faces = work.patch.zero_area_faces;
    stats.first_nonzeros = a.factor_nonzeros;
    stats.second_nonzeros = b.factor_nonzeros;
    stats.factor_bytes = a.factor_bytes + b.factor_bytes;
    stats.first_factor_seconds = a.analyze_seconds + a.factor_seconds;
    stats.second_factor_seconds = b.analyze_seconds + b.factor_seconds;
    stats.factorizations = 1;
}

}  // namespace lissom
