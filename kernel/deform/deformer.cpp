#include "kernel/deform/deformer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/tears.h"

namespace lissom {
namespace {

// Of the vertices of the region.
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
    require(o.displacement > 0.0 && std::isfinite(o.displacement), "displacement must be above 0");
}

// Options that a comparison method has no use for must be left alone.
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
                    std::string(option) + " does not apply to method " +
                        std::string(method_name(o.method)) + "; leave one of them out");
    };
    refuse(o.second != defaults.second, "second");
    refuse(o.local_size != defaults.local_size, "local_size");
    refuse(o.coherence != defaults.coherence, "coherence");
    refuse(o.coherence_weight != defaults.coherence_weight, "coherence_weight");
    refuse(o.degenerate_threshold != defaults.degenerate_threshold, "degenerate_threshold");
    refuse(o.displacement != defaults.displacement, "displacement");
    refuse(o.refine != defaults.refine, "refine");
    refuse(o.refine_borders != defaults.refine_borders, "refine_borders");
    refuse(o.flat != defaults.flat, "flat");
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

DeformOptions DeformOptions::thesis() {
    DeformOptions options;
    options.second = SecondSystem::laplacian;
    options.coherence = 2;
    options.degenerate_threshold = 2e5;
    options.scale_free = false;
    options.flat = FlatVertices::displaced;
    return options;
}

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
const DeformOptions& Deformer::options() const {
    return state_->options();
}
const Context& Deformer::context() const {
    return state_->context;
}

// One factor at a time is kept: what is shown is completed before its own is let go.
const std::shared_ptr<const Preparation>& Deformer::State::prepare(const Context& given) {
    if (!preparation || preparation->rest != rest || preparation->holds != holds) {
        complete();
        preparation.reset();
        auto next = prepare_deformation(rest, holds, given);
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

// What others hold is complete.
const std::shared_ptr<const DeformFrame>& Deformer::State::complete() {
    if (own) {
        if (!own->gradients) own->gradients = frame_gradients(*own, scratch);
        own->preparation.reset();
    }
    return shown;
}

void Deformer::prepare(const Context& context) {
    (void)preparation(context);
}

std::shared_ptr<const Preparation> Deformer::preparation(const Context& context) {
    return with_memory_errors([&] {
        const auto& prepared = state_->prepare(context);
        (void)asked_part(prepared, state_->poses.targets, state_->scratch.state().asked);
        return prepared;
    });
}

const std::vector<Vec3>& Deformer::preview(const Context& context) {
    State& s = *state_;
    with_memory_errors(
        [&] { s.show(preview_frame(s.prepare(context), s.poses, s.scratch, context)); });
    return positions();
}

const std::vector<Vec3>& Deformer::solve(const Context& context) {
    State& s = *state_;
    with_memory_errors([&] {
        s.show(solve_frame(s.prepare(context), s.poses, s.scratch, FrameQuality::full, context));
        const std::vector<Tear> tears = tears_of(*s.preparation, s.poses);
        if (!tears.empty())
            context.log(LogLevel::warning, tear_warning(*s.preparation, tears).message);
    });
    return positions();
}

const std::vector<Vec3>& Deformer::solve_draft(const Context& context) {
    State& s = *state_;
    with_memory_errors([&] {
        s.show(solve_frame(s.prepare(context), s.poses, s.scratch, FrameQuality::draft, context));
    });
    return positions();
}

const std::vector<Vec3>& Deformer::positions() const {
    return state_->shown->positions;
}
const std::vector<Vec3>& Deformer::normals(const Context& context) {
    State& s = *state_;
    return with_memory_errors([&]() -> const std::vector<Vec3>& {
        if (!s.normals) s.normals = make_region_normals(*s.rest, s.context);
        return s.normals->evaluate(s.shown->positions, context);
    });
}
const std::vector<Vec3>& Deformer::rest_positions() const {
    return state_->rest->positions;
}

void Deformer::apply_to(Mesh& mesh) const {
    with_memory_errors([&] { write_frame(*state_->rest, *state_->shown, mesh); });
}

void Deformer::require_surroundings(const Mesh& mesh) const {
    require_same_topology(mesh, region().topology(), "the deformer");
    lissom::require_surroundings(*state_->rest, mesh);
}

void Deformer::apply_rest_to(Mesh& mesh) const {
    with_memory_errors([&] { write_rest(*state_->rest, mesh); });
}

std::shared_ptr<const ShownResult> Deformer::result() {
    return with_memory_errors([&] {
        const auto result = state_->complete();
        state_->own = nullptr;
        return result;
    });
}

void Deformer::show(const ShownResult& result) {
    require_frame(*state_->rest, result);
    with_memory_errors([&] { state_->show(result); });
}

void Deformer::show(std::shared_ptr<const ShownResult> result) {
    require(result != nullptr, "there is no result to show");
    if (!result->gradients) return show(*result);
    require_frame(*state_->rest, *result);
    state_->own = nullptr;
    state_->shown = std::move(result);
}

const std::vector<Mat3>& Deformer::gradients() {
    return with_memory_errors(
        [&]() -> const std::vector<Mat3>& { return *state_->complete()->gradients; });
}

DeformStats Deformer::stats() const {
    const RestShape& rest = *state_->rest;
    const auto& handles = state_->holds->handles;
    DeformStats stats = state_->costs;
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
        Poses poses{std::vector<HandlePose>(s.holds->handles.size()), {}};
        auto holds = s.holds;
        if (!holds->targets.empty()) {
            Holds next = *holds;
            next.targets.clear();
            holds = std::make_shared<const Holds>(std::move(next));
        }
        s.holds = std::move(holds);
        s.poses = std::move(poses);
        s.show(std::move(frame));
    });
}

// Whatever a target holds stays where it is now.
void Deformer::rebase() {
    State& s = *state_;
    with_memory_errors([&] {
        const auto rest = rebased(*s.rest, *s.shown);
        auto holds = std::make_shared<const Holds>(moved_to(*rest, *s.holds));
        Poses poses = resting_poses(*rest, *holds);
        DeformFrame frame = rest_frame(*rest);
        s.rest = rest;
        s.holds = std::move(holds);
        s.poses = std::move(poses);
        s.show(std::move(frame));
    });
}

void deform(Mesh& mesh, const Region& region, std::span<const HandleMove> handles,
            const DeformOptions& options, const Context& context) {
    Deformer deformer(mesh, region, options, context);
    for (const HandleMove& move : handles) {
        deformer.set_transform(deformer.add_handle(move.region, move.options), move.transform);
    }
    deformer.solve(context);
    deformer.apply_to(mesh);
}

}  // namespace lissom
