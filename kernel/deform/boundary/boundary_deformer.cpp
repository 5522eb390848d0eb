#include "kernel/deform/boundary/boundary_deformer.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/deform/boundary/boundary_sizes.h"
#include "kernel/deform/boundary/boundary_solution.h"
#include "kernel/deform/boundary/boundary_systems.h"

namespace lissom {
namespace {

void require_values(std::span<const BoundaryValue> values, Index count) {
    if (count_of(values) != count) {
        throw Error(ErrorCode::invalid_argument,
                    "give one value for each held vertex: " + std::to_string(count));
    }
    for (const BoundaryValue& value : values) {
        if (!value.position.allFinite() || !value.rotation.allFinite()) {
            throw Error(ErrorCode::not_finite, "values of held vertices must be finite");
        }
        if (!(value.slack >= 0.0) || !value.upright.allFinite()) {
            throw Error(ErrorCode::invalid_argument,
                        "the slack of a held vertex must be 0 or more");
        }
        if (!(value.scale > 0.0) || !std::isfinite(value.scale)) {
            throw Error(ErrorCode::invalid_argument, "scales of held vertices must be above 0");
        }
    }
}

void require_none(const Region& wrong, ErrorCode code, const char* why) {
    if (wrong.empty()) return;
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index v : wrong.vertices()) vertices.add(v);
    throw Error(code, describe(vertices) + why, vertices);
}

void require_inside(const Region& region, const Region& held) {
    if (held.empty()) throw Error(ErrorCode::region_empty, "hold at least one vertex");
    require_none(held.minus(region), ErrorCode::handle_outside_region,
                 " cannot be held: they lie outside the region");
}

void require_features(const Region& region, const Region& held,
                      const std::vector<Region>& features) {
    Region taken = held;
    for (const Region& feature : features) {
        require_none(feature.minus(region), ErrorCode::handle_outside_region,
                     " cannot be of a feature: they lie outside the region");
        require_none(feature.intersected(taken), ErrorCode::handle_overlap,
                     " cannot be of a feature: they are held, or of another");
        taken = taken.united(feature);
    }
}

}  // namespace

struct BoundaryDeformer::State {
    State(const Mesh& mesh, const Region& region, const Region& held,
          const BoundaryDeformOptions& options, const Context& context)
        : systems(mesh, region, held, options, context) {}

    BoundarySystems systems;
    BoundarySizes sizes;
    std::optional<BoundarySolution> solution;
};

BoundaryDeformer::BoundaryDeformer(const Mesh& mesh, const Region& region, const Region& held,
                                   const BoundaryDeformOptions& options, const Context& context) {
    require_same_topology(mesh, region.topology(), "the region");
    require_same_topology(mesh, held.topology(), "the held vertices");
    require_inside(region, held);
    for (const Region& feature : options.features) {
        require_same_topology(mesh, feature.topology(), "a feature");
    }
    require_features(region, held, options.features);
    state_ = std::make_unique<State>(mesh, region, held, options, context);
}

BoundaryDeformer::~BoundaryDeformer() = default;
BoundaryDeformer::BoundaryDeformer(BoundaryDeformer&&) noexcept = default;
BoundaryDeformer& BoundaryDeformer::operator=(BoundaryDeformer&&) noexcept = default;

const Region& BoundaryDeformer::region() const {
    return state_->systems.region;
}
const Region& BoundaryDeformer::held() const {
    return state_->systems.held;
}
const DeformStats& BoundaryDeformer::stats() const {
    return state_->systems.stats;
}

BoundaryDeformation BoundaryDeformer::solve(std::span<const BoundaryValue> values,
                                            const Context& context) {
    const BoundarySystems& systems = state_->systems;
    require_values(values, systems.held.size());
    BoundaryTimes seconds;
    auto start = Clock::now();
    BoundarySolution now = first_solved(systems, placed(systems, values));
    seconds.first = seconds_since(start);
    context.checkpoint();
    start = Clock::now();
    now = turned(systems, state_->sizes, std::move(now), context);
    seconds.polar = seconds_since(start);
    start = Clock::now();
    const bool moves = systems.has_free() || systems.common->size() > 0;
    if (moves) now = second_solved(systems, std::move(now), context);
    seconds.second = seconds_since(start);
    BoundaryDeformation deformed = deformation_of(systems, now);
    deformed.seconds = seconds;
    state_->solution = std::move(now);
    return deformed;
}

BoundaryDeformation BoundaryDeformer::refine(int steps, const Context& context) {
    require(steps > 0, "a refinement takes at least one step");
    require(state_->solution.has_value(), "solve must be called before refine");
    const auto start = Clock::now();
    RefinedSolution now = refined(state_->systems, *state_->solution, steps, context);
    BoundaryDeformation deformed = deformation_of(state_->systems, now.solution);
    deformed.energy = std::move(now.energy);
    deformed.seconds.second = seconds_since(start);
    state_->solution = std::move(now.solution);
    return deformed;
}

}  // namespace lissom
