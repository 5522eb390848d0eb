#include "kernel/deform/deformer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/description.h"
#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/frame/tears.h"

namespace lissom {
namespace {

// Normals of the vertices of the region.
std::unique_ptr<RegionNormals> make_region_normals(const RestShape& rest, const Context& context) {
    const std::map<Index, Vec3> around(rest.surroundings.begin(), rest.surroundings.end());
    return std::make_unique<RegionNormals>(
        rest.region(), [&](Index v) { return around.at(v); }, context);
}

void require_options(const DeformOptions& o) {
    const auto require = [](bool condition, const char* message) {
        if (!condition) throw Error(ErrorCode::invalid_argument, message);
    };
    require(o.coherence == 1 || o.coherence == 2, "coherence must be 1 or 2 rings");
    require(o.refine >= 0 && o.refine <= 2, "refine must be 0, 1 or 2");
    require(o.free_rings >= 0 && o.free_rings <= 10, "free_rings must be from 0 to 10");
    require(o.coherence_weight > 0.0 && std::isfinite(o.coherence_weight),
            "coherence_weight must be above 0");
    require(o.degenerate_threshold > 1.0, "degenerate_threshold must be above 1");
    require(o.transition >= 0.0 && std::isfinite(o.transition),
            "transition must be a distance of 0 or more");
    require(o.volume >= 0.0 && o.volume <= 1.0, "volume must be from 0 to 1");
    require(o.level_vertices == 0 || o.level_vertices >= 100,
            "level_vertices must be 0 or at least 100");
    require(o.displacement > 0.0 && std::isfinite(o.displacement), "displacement must be above 0");
}

// Options without a use in a comparison method keep their defaults.
void require_applicable(const DeformOptions& o) {
    if (o.method == DeformMethod::implicit) return;
    require_comparison(o);
    const DeformOptions defaults;
    const bool laplacian = o.method == DeformMethod::naive ||
                           o.method == DeformMethod::rotation_estimate ||
                           o.method == DeformMethod::similarity;
    const auto refuse = [&](bool differs, const char* option) {
        if (!differs) return;
        throw Error(ErrorCode::invalid_argument,
                    "option '" + std::string(option) + "' does not apply to method '" +
                        std::string(method_name(o.method)) + "'; leave one of them out");
    };
    refuse(o.second != defaults.second, "second");
    refuse(o.local_size != defaults.local_size, "local_size");
    refuse(o.coherence != defaults.coherence, "coherence");
    refuse(o.coherence_weight != defaults.coherence_weight, "coherence_weight");
    refuse(o.degenerate_threshold != defaults.degenerate_threshold, "degenerate_threshold");
    refuse(o.displacement != defaults.displacement, "displacement");
    refuse(o.refine != defaults.refine, "refine");
    refuse(o.subdivide_borders != defaults.subdivide_borders, "subdivide_borders");
    refuse(o.flat != defaults.flat, "flat");
    refuse(o.volume != defaults.volume, "volume");
    refuse(o.free_rings != defaults.free_rings, "free_rings");
    refuse(o.level_vertices != defaults.level_vertices, "levels");
    refuse(o.loose == UnheldParts::follow, "loose = follow");
    refuse(!laplacian && !o.scale_free, "scale_free");
    refuse(o.method == DeformMethod::geodesic && o.weights != defaults.weights, "weights");
}

}  // namespace

std::string_view method_name(DeformMethod method) {
    constexpr std::string_view kNames[] = {
        "implicit", "naive", "rotation_estimate", "similarity", "geodesic", "harmonic", "frames"};
    return kNames[static_cast<int>(method)];
}

const Context& own_context() {
    static const Context context;
    return context;
}

Deformer::Deformer(const Mesh& mesh, const DeformOptions& options, const Context& context)
    : Deformer(mesh, Region::all(mesh.shared_topology()), options, context) {}

Deformer::Deformer(const Mesh& mesh, const Region& region, const DeformOptions& options,
                   const Context& context) {
    require_same_topology(mesh, region.topology(), "the region");
    require_options(options);
    require_applicable(options);
    if (region.empty()) {
        throw Error(ErrorCode::region_empty, "the region to deform has no vertices; enlarge it");
    }
    context.checkpoint();
    with_memory_errors([&] { state_ = std::make_unique<State>(mesh, region, options, context); });
}

Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

const Region& Deformer::region() const {
    return state_->rest->region();
}
const DeformOptions& options_of(const Deformer& deformer) {
    return DeformerAccess::state(deformer).options();
}
const Context& context_of(const Deformer& deformer) {
    return DeformerAccess::state(deformer).context;
}

// One factor at a time is kept: the shown frame is completed before its own factor is released.
const std::shared_ptr<const Preparation>& Deformer::State::prepare(const Context& given) {
    if (!preparation || preparation->rest != rest || preparation->constraints != constraints) {
        complete();
        auto next = prepare_next(preparation, rest, constraints, given);
        const Index count = costs.factorizations;
        costs = next->costs;
        costs.factorizations += count;
        preparation = std::move(next);
    }
    return preparation;
}

void Deformer::State::show(DeformFrame frame) {
    if (own) {
        std::swap(*own, frame);
        scratch.recycle(std::move(frame));
        return;
    }
    auto next = std::make_shared<DeformFrame>(std::move(frame));
    own = next.get();
    shown = std::move(next);
}

// Frames shared with others are complete.
const std::shared_ptr<const DeformFrame>& Deformer::State::complete() {
    if (own) {
        if (!own->gradients) own->gradients = frame_gradients(*own, scratch);
        own->preparation.reset();
    }
    return shown;
}

std::shared_ptr<const Preparation> Deformer::prepare(const Context& context) {
    return with_memory_errors([&] {
        const Context& chosen = state_->chosen(context);
        Progress progress(chosen, "deform: prepare");
        progress.step(0.85);
        const auto& prepared = state_->prepare(chosen);
        progress.step(0.15);
        const ImplicitMethod* method = prepared->implicit();
        if (method && method->solution) method->solution->find_all_weights(chosen);
        (void)target_rhs(prepared, state_->poses.targets, state_->scratch.state().asked);
        return prepared;
    });
}

const std::vector<Vec3>& Deformer::solve(FrameQuality quality, const Context& given) {
    State& s = *state_;
    const Context& context = s.chosen(given);
    with_memory_errors([&] {
        s.show(solve_frame(s.prepare(context), s.poses, s.scratch, quality, context));
        if (quality != FrameQuality::full) return;
        const std::vector<Tear> tears = tears_of(*s.preparation, s.poses);
        if (!tears.empty())
            context.log(LogLevel::warning, tear_warning(*s.preparation, tears).message);
    });
    return positions();
}

const std::vector<Vec3>& Deformer::positions() const {
    return state_->shown->positions;
}
const std::vector<Vec3>& normals_of(Deformer& deformer, const Context& context) {
    auto& s = DeformerAccess::state(deformer);
    return with_memory_errors([&]() -> const std::vector<Vec3>& {
        if (!s.normals) s.normals = make_region_normals(*s.rest, s.context);
        return s.normals->evaluate(s.shown->positions, s.chosen(context));
    });
}
const std::vector<Vec3>& rest_positions_of(const Deformer& deformer) {
    return DeformerAccess::state(deformer).rest->positions;
}

void Deformer::apply_to(Mesh& mesh) const {
    with_memory_errors([&] { write_frame(*state_->rest, *state_->shown, mesh); });
}

void require_surroundings(const Deformer& deformer, const Mesh& mesh) {
    require_same_topology(mesh, deformer.region().topology(), "the deformer");
    require_surroundings(*DeformerAccess::state(deformer).rest, mesh);
}

void apply_rest(const Deformer& deformer, Mesh& mesh) {
    with_memory_errors([&] { write_rest(*DeformerAccess::state(deformer).rest, mesh); });
}

const std::vector<Mat3>& gradients_of(Deformer& deformer) {
    return with_memory_errors([&]() -> const std::vector<Mat3>& {
        return *DeformerAccess::state(deformer).complete()->gradients;
    });
}

std::size_t constraint_bytes(const Deformer& deformer) {
    return memory_bytes(*DeformerAccess::state(deformer).constraints);
}

DeformStats stats_of(const Deformer& deformer) {
    const auto& s = DeformerAccess::state(deformer);
    const RestShape& rest = *s.rest;
    const auto& handles = s.constraints->handles;
    DeformStats stats = s.costs;
    const ImplicitMethod* method = s.preparation ? s.preparation->implicit() : nullptr;
    if (method && method->solution) stats.basis_seconds = method->solution->seconds();
    stats.region_vertices = rest.region().size();
    stats.zero_area_faces = rest.patch().zero_area_faces;
    stats.inserted_vertices = rest.patch().first_normal_point() - rest.patch().real_count;
    stats.handles = index_of(
        std::count_if(handles.begin(), handles.end(), [](const auto& h) { return h != nullptr; }));
    return stats;
}

void Deformer::reset() {
    State& s = *state_;
    with_memory_errors([&] {
        DeformFrame frame = rest_frame(*s.rest);
        Poses poses{std::vector<HandlePose>(s.constraints->handles.size()), {}, s.poses.volume};
        auto constraints = s.constraints;
        if (!constraints->targets.empty()) {
            ConstraintSet next = *constraints;
            next.targets.clear();
            constraints = std::make_shared<const ConstraintSet>(std::move(next));
        }
        s.show(std::move(frame));
        s.constraints = std::move(constraints);
        s.poses = std::move(poses);
    });
}

// Targets hold their present places.
void Deformer::rebase() {
    State& s = *state_;
    with_memory_errors([&] {
        const auto rest = rebased(*s.rest, *s.shown);
        auto constraints =
            std::make_shared<const ConstraintSet>(moved_to(*rest, *s.constraints, s.poses));
        Poses poses = resting_poses(*rest, *constraints);
        poses.volume = s.poses.volume;
        DeformFrame frame = rest_frame(*rest);
        s.show(std::move(frame));
        s.rest = rest;
        s.constraints = std::move(constraints);
        s.poses = std::move(poses);
    });
}

void deform(Mesh& mesh, const Region& region, std::span<const HandleMove> handles,
            const DeformOptions& options, const Context& context) {
    Deformer deformer(mesh, region, options, context);
    for (const HandleMove& move : handles) {
        deformer.set_transform(deformer.add_handle(move.region, move.options), move.transform);
    }
    deformer.solve();
    deformer.apply_to(mesh);
}

}  // namespace lissom
