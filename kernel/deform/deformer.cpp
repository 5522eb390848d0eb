#include "kernel/deform/deformer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/holds/mirror.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// A transform that moves no point of the region by more than this fraction of its size is the
// identity, so that a drag there and back returns to rest to the bit.
constexpr double kIdentityTolerance = 1e-12;

constexpr double kSingularRatio = 1e-12;

void require_options(const DeformOptions& o) {
    const auto require = [](bool condition, const char* message) {
        if (!condition) throw Error(ErrorCode::invalid_argument, message);
    };
    require(o.coherence == 1 || o.coherence == 2, "coherence must be 1 or 2 rings");
    require(o.refine >= 0 && o.refine <= 2, "refine must be 0, 1 or 2");
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
    refuse(!laplacian && !o.scale_free, "scale_free");
    refuse(o.method == DeformMethod::geodesic && o.weights != defaults.weights, "weights");
}

// For what only the first system of the implicit method has.
void require_implicit(const DeformOptions& options, const std::string& what) {
    if (options.method == DeformMethod::implicit) return;
    throw Error(ErrorCode::unsupported, what + " exists for method implicit only, not for method " +
                                            std::string(method_name(options.method)));
}

void require_regular(const Affine& transform, const Vec3& about) {
    const double scale = transform.linear.norm();
    if (transform.is_finite() && about.allFinite() &&
        std::abs(transform.linear.determinant()) > kSingularRatio * scale * scale * scale) {
        return;
    }
    throw Error(ErrorCode::singular_transform,
                "the transform flattens space or is not finite; scale by factors other than zero");
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
    return state_->region;
}
const DeformOptions& Deformer::options() const {
    return state_->options;
}
const Context& Deformer::context() const {
    return state_->own_context;
}

std::vector<HandleId> Deformer::handles() const {
    std::vector<HandleId> ids;
    for (std::size_t h = 0; h < state_->handles.size(); ++h) {
        if (!state_->handles[h].removed) ids.push_back({static_cast<Index>(h)});
    }
    return ids;
}

const Region& Deformer::handle_region(HandleId id) const {
    return state_->handle(id).region;
}
const HandleOptions& Deformer::handle_options(HandleId id) const {
    return state_->handle(id).options;
}
Vec3 Deformer::handle_center(HandleId id) const {
    return state_->handle(id).center;
}
const Affine& Deformer::transform(HandleId id) const {
    return state_->handle(id).transform;
}

std::shared_ptr<const HandlePoses> Deformer::poses() const {
    return std::make_shared<HandlePoses>(
        HandlePoses{state_->handles, state_->rest_patch->patch.origin});
}

void Deformer::restore(const HandlePoses& poses) {
    std::vector<HandleState>& handles = state_->handles;
    const bool same_origin = poses.origin == state_->rest_patch->patch.origin;
    for (std::size_t h = 0; h < poses.handles.size() && h < handles.size(); ++h) {
        if (handles[h].removed) continue;
        handles[h].transform = poses.handles[h].transform;
        handles[h].in_patch = poses.handles[h].in_patch;
        handles[h].turn = poses.handles[h].turn;
        if (!same_origin) state_->place(handles[h], handles[h].transform, Vec3::Zero());
    }
}

void Deformer::set_transform(HandleId id, const Affine& transform) {
    set_transform(id, transform, Vec3::Zero());
}

void Deformer::set_transform(HandleId id, const Affine& transform, const Vec3& about) {
    set_transform(id, transform, about, turn(id));
}

void Deformer::set_transform(HandleId id, const Affine& transform, const Vec3& about,
                             const Vec3& turn) {
    HandleState& handle = state_->handle(id);
    require_regular(transform, about);
    if (!turn.allFinite()) {
        throw Error(ErrorCode::not_finite, "the turn of a handle must be finite");
    }
    handle.turn = turn_near(nearest_rotation(transform.linear), turn);
    state_->place(handle, transform, about);
    const Affine& moved = handle.in_patch;
    const double change = (moved.linear - Mat3::Identity()).cwiseAbs().maxCoeff();
    const double shift = moved.translation.cwiseAbs().maxCoeff();
    const bool still = change < kIdentityTolerance && shift <= kIdentityTolerance * state_->size;
    if (still) {
        handle.transform = handle.in_patch = {};
        handle.turn = turn_near(Mat3::Identity(), handle.turn);
    }
    if (handle.partner != kNoIndex) {
        state_->reflect(handle, handle.mirror, state_->handles[handle.partner]);
    }
}

Vec3 Deformer::turn(HandleId id) const {
    return state_->handle(id).turn;
}

Affine Deformer::transform_about(HandleId id, const Vec3& about) const {
    const Affine& map = state_->handle(id).in_patch;
    const Vec3 arm = about - state_->rest_patch->patch.origin;
    return {map.linear, map.translation + (map.linear - Mat3::Identity()) * arm};
}

void Deformer::prepare(const Context& context) {
    with_memory_errors([&] { state_->prepare(context); });
}

const std::vector<Vec3>& Deformer::preview(const Context& context) {
    with_memory_errors([&] { state_->preview(context); });
    return state_->positions;
}

const std::vector<Vec3>& Deformer::solve(const Context& context) {
    with_memory_errors([&] { state_->solve(false, context); });
    return state_->positions;
}

const std::vector<Vec3>& Deformer::solve_draft(const Context& context) {
    with_memory_errors([&] { state_->solve(true, context); });
    return state_->positions;
}

// Solves for the deviation from the base transform of the rest shape, which the system maps to
// itself: the rounding of its entries then acts on the deviation only.
std::vector<Vec3> Deformer::solve_first_directly(const Context& context) {
    State& s = *state_;
    require_implicit(s.options, "the first system");
    s.prepare(context);
    const Mat4 base = s.base_transform();
    const Mat3 base_gradient = base.topLeftCorner<3, 3>();
    std::vector<Vec3> x(static_cast<std::size_t>(s.prepared->work->patch.vertex_count),
                        Vec3::Zero());
    for (Index v = 0; v < s.prepared->work->patch.vertex_count; ++v) {
        if (s.prepared->known.position[v]) x[v] = s.known_deviation(v);
    }
    const std::vector<Index>& free = s.prepared->first->free_vertices();
    const std::size_t rows = free.size();
    std::vector<long double> b(3 * rows);
    for (int d = 0; d < 3; ++d) {
        s.prepared->first->right_hand_side(
            [&](Index k) { return x[k][d]; },
            [&](Index k) -> Vec3 {
                return (s.known_gradient(k) - base_gradient).row(d).transpose();
            },
            b.data() + static_cast<std::size_t>(d) * rows);
    }
    if (rows > 0) {
        std::vector<double> y = s.prepared->first->solve(b, 3);
        for (int d = 0; d < 3; ++d) {
            s.prepared->first->enforce_ties([&](Index k) { return x[k][d]; },
                                            std::span(y).subspan(d * rows, rows));
        }
        for (std::size_t r = 0; r < rows; ++r) x[free[r]] = {y[r], y[rows + r], y[2 * rows + r]};
    }
    return s.pulled_back(x);
}

const std::vector<Vec3>& Deformer::positions() const {
    return state_->positions;
}
const std::vector<Vec3>& Deformer::rest_positions() const {
    return state_->rest;
}

void Deformer::apply_to(Mesh& mesh) const {
    const State& s = *state_;
    require_surroundings(mesh);
    const std::vector<Mat3> alone = s.turns_without_faces();
    const std::span<Vec3> out = mesh.edit_positions();
    for (Index row = 0; row < s.region.size(); ++row)
        out[s.region.vertices()[row]] = s.positions[row];
    s.directions.apply_to(mesh, alone);
}

void Deformer::require_surroundings(const Mesh& mesh) const {
    require_same_topology(mesh, state_->region.topology(), "the deformer");
    state_->require_surroundings(mesh);
}

void Deformer::apply_rest_to(Mesh& mesh) const {
    const State& s = *state_;
    require_surroundings(mesh);
    const std::span<Vec3> out = mesh.edit_positions();
    for (Index row = 0; row < s.region.size(); ++row) out[s.region.vertices()[row]] = s.rest[row];
    s.directions.apply_to(mesh,
                          std::vector<Mat3>(s.directions.without_faces().size(), Mat3::Identity()));
}

std::shared_ptr<const ShownResult> Deformer::result() {
    State& s = *state_;
    s.find_gradients();
    return std::make_shared<ShownResult>(
        ShownResult{s.positions, s.inserted, s.shown_patch, s.shown, s.gradients});
}

void Deformer::show(const ShownResult& result) {
    State& s = *state_;
    s.positions = result.positions;
    s.inserted = result.inserted;
    s.shown_patch = result.patch;
    s.shown = result.transforms;
    s.gradients = result.gradients;
    s.gradients_current = true;
}

void Deformer::reset() {
    State& s = *state_;
    for (HandleState& handle : s.handles) handle.set_at_rest();
    if (!s.constraints.empty() || !s.points.empty()) s.prepared.reset();
    s.constraints.clear();
    s.points.clear();
    s.to_rest();
}

const std::vector<Mat3>& Deformer::gradients() {
    state_->find_gradients();
    return state_->gradients;
}

// Weights and fixed part leave the coordinates of the patch: for a transform [L t] of the mesh's
// space the patch sees [L, L o + t - o].
HandleBasis Deformer::basis(const Context& context) {
    State& s = *state_;
    require_implicit(s.options, "the handle basis");
    s.prepare(context);
    HandleBasis basis;
    basis.vertices = s.region.vertices();
    basis.handles = handles();
    const std::size_t rows = basis.vertices.size();
    const Vec3& o = s.rest_patch->patch.origin;
    basis.fixed.assign(rows, Vec3::Zero());
    basis.weights.assign(basis.handles.size(), std::vector<Vec4>(rows, Vec4::Zero()));
    const auto weights_of = [&](Index handle) -> std::vector<Vec4>& {
        const auto at = std::find(basis.handles.begin(), basis.handles.end(), HandleId{handle});
        return basis.weights[static_cast<std::size_t>(at - basis.handles.begin())];
    };
    for (Index row = 0; row < s.region.size(); ++row) {
        const Index v = s.rest_patch->patch.of_region[row], owner = s.prepared->owner[v];
        if (!s.prepared->known.position[v]) continue;
        if (owner >= 0) {
            weights_of(owner)[row] = homogeneous(s.rest[row]);
        } else {
            basis.fixed[row] = s.known_position(v) + o;
        }
    }
    if (!s.prepared->solution) return basis;
    const LinearSolution& solution = *s.prepared->solution;
    const std::vector<Index>& free = s.prepared->first->free_vertices();
    for (std::size_t f = 0; f < free.size(); ++f) {
        const Index row = s.prepared->frame_row[f];
        if (row == kNoIndex || row >= s.region.size()) continue;
        Vec4 rest_part = homogeneous(s.prepared->work->patch.rest[free[f]] + o);
        for (std::size_t h = 0; h < solution.handles().size(); ++h) {
            Vec4 w = solution.weight(h, static_cast<Index>(f));
            w.head<3>() += w[3] * o;
            weights_of(solution.handles()[h])[row] = w;
            rest_part -= w;
        }
        basis.fixed[row] = solution.fixed(static_cast<Index>(f));
        if (solution.base() == kNoIndex) {
            basis.fixed[row] += rest_part.head<3>();
        } else {
            weights_of(solution.base())[row] = rest_part;
        }
    }
    return basis;
}

const DeformStats& Deformer::stats() const {
    return state_->stats;
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
