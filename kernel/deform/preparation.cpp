#include "kernel/deform/preparation.h"

#include <algorithm>
#include <string>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/deform/holds/boundary_refinement.h"
#include "kernel/deform/patch/hubs.h"

namespace lissom {
namespace {

void require_area(const Patch& patch) {
    const Elements& vertices = patch.zero_area_vertices;
    if (vertices.count == 0) return;
    throw Error(ErrorCode::zero_area,
                "all faces around " + describe(vertices) +
                    " have no area; collapse those faces or leave them out of the region",
                vertices);
}

std::shared_ptr<const WorkingPatch> working_patch(const RestShape& rest,
                                                  const ConstraintSet& constraints) {
    std::shared_ptr<const WorkingPatch> work = rest.work;
    const DeformOptions& options = rest.options();
    if (options.subdivide_borders && options.method == DeformMethod::implicit) {
        std::optional<Patch> refined =
            refined_at_borders(work->patch, find_holding(*work, constraints));
        if (refined) work = std::make_shared<WorkingPatch>(std::move(*refined), options);
    }
    return changes_patch(constraints, options.transition)
               ? anchored(*work, constraints, options.transition)
               : work;
}

// Effective constraints: handles that nearly touch release rings of their vertices if asked to.
ConstraintSet holding_in_fact(const RestShape& rest, const ConstraintSet& constraints) {
    ConstraintSet result = constraints;
    const int rings = rest.options().free_rings;
    if (rings == 0) return result;
    HolderMap holding = find_holding(*rest.work, constraints);
    free_gap_rings(*rest.work, rings, holding);
    for (std::size_t h = 0; h < result.handles.size(); ++h) {
        if (!constraints.handles[h] || constraints.handles[h]->soft()) continue;
        Handle handle = *constraints.handles[h];
        std::erase_if(handle.local, [&](Index v) { return holding.owner[at(v)] != index_of(h); });
        result.handles[h] = std::make_shared<const Handle>(std::move(handle));
    }
    return result;
}

void collect_held(Preparation& next, const ConstraintSet& constraints) {
    const Patch& patch = next.patch();
    for (const auto& handle : constraints.handles) {
        next.held.push_back(handle ? handle->local : std::vector<Index>());
    }
    for (Index v = patch.mesh_count(); v < patch.real_count; ++v) {
        if (next.owner[v] >= 0) next.held[next.owner[v]].push_back(v);
    }
}

void find_who_holds(Preparation& next, const ConstraintSet& constraints, const Context& context) {
    HolderMap holding = find_holding(*next.work, constraints);
    next.gaps = handle_gaps(*next.rest->work, find_holding(*next.rest->work, constraints));
    next.following = hold_loose_parts(*next.work, next.rest->options().loose, holding, context);
    require_constraints(*next.work, holding.known);
    next.owner = std::move(holding.owner);
    next.known = std::move(holding.known);
    next.asked = std::move(holding.asked);
    collect_held(next, constraints);
    for (const Index v : next.patch().of_region) {
        const Index owner = next.owner[v];
        if (owner == kPinned || owner == kLoose)
            next.resting_rows.push_back(next.rest->region_row[v]);
    }
}

// The centre of the first handle, or between it and its mirror image: rarely a centre of the
// surface itself, at which vertices that differ would lie equally far.
Vec3 start_of_sequence(const RestShape& rest, const ConstraintSet& constraints) {
    for (const auto& h : constraints.handles) {
        if (!h) continue;
        const Vec3 center = h->partner == kNoIndex
                                ? h->center
                                : Vec3(0.5 * (h->center + constraints.handles[h->partner]->center));
        return center - rest.origin();
    }
    return Vec3::Zero();
}

// Systems of a preparation that ends, for the next one.
class FormerSystems {
  public:
    explicit FormerSystems(std::shared_ptr<const Preparation> former) {
        if (!former || former.use_count() > 1 || !former->implicit()) return;
        first = former->implicit()->first->release();
        second = former->implicit()->second->release();
        ended_ = std::move(former);
    }

    // For a preparation of the same patch and options.
    FormerAssembly assembly(const Preparation& next) const {
        if (!ended_ || ended_->work != next.work || ended_->rest->scope != next.rest->scope)
            return {};
        const ImplicitMethod& method = *ended_->implicit();
        return {method.first.get(), &method.gradients, &ended_->known};
    }
    void release_assembly() { ended_.reset(); }

    OrderedSystem first, second;

  private:
    std::shared_ptr<const Preparation> ended_;
};

// Factors `system` if it has unknowns.
template <typename System>
void factor(System& system, OrderedSystem former, const Patch& patch, const Context& context) {
    if (system.free_vertices().empty()) return;
    try {
        system.factor(context, std::move(former));
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
        refuse_singular(patch, error, system.free_vertices());
    }
}

void assemble(Preparation& next, ImplicitMethod& method, const FormerAssembly& former,
              const Context& context) {
    const DeformOptions& options = next.rest->options();
    const MemoryCharge charge = charge_hubs(next.patch(), next.rings(), context);
    method.gradients = make_gradients(next.patch(), next.rings(), next.work->geometry, next.known,
                                      start_of_sequence(*next.rest, *next.constraints), options);
    context.parallel_for(0, 2, 1, [&](Index begin, Index end) {
        for (Index system = begin; system < end; ++system) {
            if (system == 0) {
                method.first = std::make_unique<GradientSystem>(
                    *next.work, method.gradients, next.known, options, context, former);
            } else {
                method.second = std::make_unique<RotationSystem>(*next.work, next.known.position,
                                                                 options, context);
            }
        }
    });
}

void number_frame(const Preparation& next, ImplicitMethod& method) {
    const Patch& patch = next.patch();
    for (const Index v : method.first->free_vertices()) {
        method.frame_row.push_back(next.rest->frame_row(patch, v));
    }
    std::vector<Index> surface = patch.of_region;
    for (Index v = patch.mesh_count(); v < patch.real_count; ++v) surface.push_back(v);
    for (const Index v : surface) {
        if (next.known.gradient[v]) continue;
        (method.gradients.defined[v] ? method.gathered : method.averaged).push_back(v);
    }
}

void count_costs(Preparation& next, const ImplicitMethod& method) {
    const FactorStats first = method.first->stats(), &second = method.second->stats();
    DeformStats& stats = next.costs;
    stats.free_vertices = count_of(method.second->free_vertices());
    for (const Index v : next.patch().of_region) {
        stats.constrained_vertices += next.known.position[v];
    }
    stats.displaced_vertices = count_of(method.gradients.displaced);
    for (const Index v : next.patch().normal_points) {
        stats.extended_vertices += method.gradients.defined[at(v)];
    }
    stats.refined_vertices = count_of(next.patch().inserted);
    stats.first_nonzeros = first.factor_nonzeros;
    stats.second_nonzeros = second.factor_nonzeros;
    stats.factor_bytes = first.factor_bytes + second.factor_bytes;
    stats.first_factor_seconds = first.analyze_seconds + first.factor_seconds;
    stats.second_factor_seconds = second.analyze_seconds + second.factor_seconds;
    stats.factorizations = stats.free_vertices > 0 ? 1 : 0;
}

void prepare_implicit(Preparation& next, FormerSystems former, Progress& progress,
                      const Context& context) {
    ImplicitMethod& method = next.method.emplace<ImplicitMethod>();
    progress.step(0.25);
    const auto start = Clock::now();
    assemble(next, method, former.assembly(next), context);
    former.release_assembly();
    next.costs.assemble_seconds = seconds_since(start);

    progress.step(0.65);
    // The two do not depend on each other.
    context.parallel_for(0, 2, 1, [&](Index begin, Index end) {
        for (Index system = begin; system < end; ++system) {
            system == 0 ? factor(*method.first, std::move(former.first), next.patch(), context)
                        : factor(*method.second, std::move(former.second), next.patch(), context);
        }
    });
    progress.step(0.05);
    if (!method.second->free_vertices().empty()) method.second->finish(context);

    progress.step(0.05);
    number_frame(next, method);
    if (!method.frame_row.empty()) {
        method.solution = std::make_unique<LinearSolution>(next.problem(), context);
    }
    count_costs(next, method);
}

// Warns of constraints that need the whole surface though levels were asked for.
bool may_have_levels(const RestShape& rest, const ConstraintSet& constraints,
                     const Context& context) {
    if (!wants_levels(rest.options(), rest.region().size())) return false;
    const std::string reason = refused_levels(rest.options(), constraints);
    if (reason.empty()) return true;
    context.log(LogLevel::warning,
                "levels: " + reason + " need the whole surface, which is solved instead");
    return false;
}

// Returns false if the thinned surface cannot be prepared; `next` is of no use then.
bool prepare_on_levels(Preparation& next, const Context& context) {
    // Shares of the thinned surface, twice while they are made, and a frame.
    constexpr std::size_t kBytesPerVertex = 200;
    next.hold = MemoryHold(context.memory(), "preparing a deformation on levels");
    next.hold.resize(next.rest->positions.size() * kBytesPerVertex);
    const auto start = Clock::now();
    std::optional<LevelMethod> levels = prepare_levels(next, context);
    if (!levels) return false;
    DeformStats& costs = next.costs;
    costs = levels->coarse->costs;
    costs.level_vertices = levels->thinned.vertex_count();
    costs.assemble_seconds =
        seconds_since(start) - costs.first_factor_seconds - costs.second_factor_seconds;
    costs.constrained_vertices = 0;
    for (const Index v : next.patch().of_region) {
        costs.constrained_vertices += next.known.position[v];
    }
    costs.free_vertices = count_of(next.patch().of_region) - costs.constrained_vertices;
    next.method = *std::move(levels);
    return true;
}

// The holders of a patch, without a method.
std::shared_ptr<Preparation> held_patch(const std::shared_ptr<const RestShape>& rest,
                                        const std::shared_ptr<const ConstraintSet>& constraints,
                                        bool on_levels, const Context& context) {
    auto next = std::make_shared<Preparation>();
    next->rest = rest;
    next->constraints = constraints;
    const ConstraintSet holds_in_fact = holding_in_fact(*rest, *constraints);
    next->work = on_levels ? rest->work : working_patch(*rest, holds_in_fact);
    find_who_holds(*next, holds_in_fact, context);
    return next;
}

// Charges stencils, right-hand sides, matrices while they are assembled, a frame and its gradients.
void charge_preparation(Preparation& next, FormerSystems& systems, const Context& context) {
    constexpr std::size_t kBytesPerVertex = 1000;
    next.hold = MemoryHold(context.memory(), "preparing a deformation");
    const std::size_t bytes = next.rest->positions.size() * kBytesPerVertex;
    try {
        next.hold.resize(bytes);
    } catch (const Error&) {
        systems.release_assembly();
        next.hold.resize(bytes);
    }
}

}  // namespace

std::shared_ptr<const Preparation> prepare_deformation(
    const std::shared_ptr<const RestShape>& rest,
    const std::shared_ptr<const ConstraintSet>& constraints, const Context& context) {
    std::shared_ptr<const Preparation> none;
    return prepare_next(none, rest, constraints, context);
}

std::shared_ptr<const Preparation> prepare_next(
    std::shared_ptr<const Preparation>& former, const std::shared_ptr<const RestShape>& rest,
    const std::shared_ptr<const ConstraintSet>& constraints, const Context& context) {
    require(rest && constraints, "a preparation needs a rest shape and holds");
    Progress progress(context, "deform: prepare");
    require_area(rest->patch());
    require_plain_holds(*constraints, rest->options());
    const bool on_levels = may_have_levels(*rest, *constraints, context);
    std::shared_ptr<Preparation> next = held_patch(rest, constraints, on_levels, context);
    FormerSystems systems(std::exchange(former, nullptr));
    if (on_levels) {
        if (prepare_on_levels(*next, context)) return next;
        next = held_patch(rest, constraints, false, context);
    }
    charge_preparation(*next, systems, context);
    if (next->rest->options().method == DeformMethod::implicit) {
        prepare_implicit(*next, std::move(systems), progress, context);
    } else {
        prepare_comparison(*next, context);
    }
    return next;
}

const std::shared_ptr<const RestShape>& rest_of(const Preparation& preparation) {
    return preparation.rest;
}

const std::shared_ptr<const ConstraintSet>& constraints_of(const Preparation& preparation) {
    return preparation.constraints;
}

void pose_handle(const Preparation& preparation, Poses& poses, HandleId handle,
                 const Affine& transform, const Vec3& about, const std::optional<Vec3>& turn) {
    (void)handle_of(*preparation.constraints, handle);
    require_poses(*preparation.constraints, poses);
    pose_handle(*preparation.rest, *preparation.constraints, poses, handle, transform, about,
                turn.value_or(poses.handles[handle.value].turn));
}

LinearProblem Preparation::problem() const {
    const ImplicitMethod& m = *implicit();
    return {patch(), rings(), m.gradients, *m.first, owner, constraints->handles};
}

GradientLoop Preparation::gradient_loop() const {
    const GradientStencils& stencils = implicit()->gradients;
    return {rings().begin.data(), rings().neighbor.data(), stencils.self.data(),
            stencils.neighbor.data()};
}

void refuse_singular(const Patch& patch, const Error& error, const std::vector<Index>& free) {
    Elements vertices{ElementKind::vertex, 0, {}};
    std::vector<Index> ids;
    for (const Index row : error.elements().ids) {
        if (free[row] < patch.mesh_count()) ids.push_back(patch.mesh_vertex[free[row]]);
    }
    std::sort(ids.begin(), ids.end());
    for (const Index v : ids) vertices.add(v);
    vertices.count = std::max(vertices.count, error.elements().count);
    const std::string names = describe(vertices);
    throw Error(ErrorCode::unconstrained,
                "the constraints do not determine the connected part of " + names +
                    "; add a handle with a gradient there",
                std::move(vertices));
}

void require_whole_surface(const DeformOptions& options, const char* what) {
    require_implicit(options, what);
    if (options.level_vertices == 0) return;
    throw Error(ErrorCode::unsupported,
                std::string(what) + " needs the whole surface; make the deformer without levels");
}

void require_implicit(const DeformOptions& options, const char* what) {
    if (options.method == DeformMethod::implicit) return;
    throw Error(ErrorCode::unsupported, std::string(what) +
                                            " exists for method implicit only, not for method " +
                                            std::string(method_name(options.method)));
}

}  // namespace lissom
