#include "kernel/deform/deformer.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/deform/constraints.h"
#include "kernel/deform/gradient_system.h"
#include "kernel/deform/gradients.h"
#include "kernel/deform/linear_solution.h"
#include "kernel/deform/operators.h"
#include "kernel/deform/patch.h"
#include "kernel/deform/polar.h"
#include "kernel/deform/rest_normals.h"
#include "kernel/deform/rotation_system.h"

namespace lissom {
namespace {

constexpr Index kFrameGrain = 4096;

// A transform that moves no point of the region by more than this fraction of its size is the
// identity, so that a drag there and back returns to rest to the bit.
constexpr double kIdentityTolerance = 1e-12;

constexpr double kSingularRatio = 1e-12;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void require_options(const DeformOptions& o) {
    const auto require = [](bool condition, const char* message) {
        if (!condition) throw Error(ErrorCode::invalid_argument, message);
    };
    require(o.coherence == 1 || o.coherence == 2, "coherence must be 1 or 2 rings");
    require(o.coherence_weight > 0.0 && std::isfinite(o.coherence_weight),
            "coherence_weight must be above 0");
    require(o.degenerate_threshold > 1.0, "degenerate_threshold must be above 1");
    require(o.displacement > 0.0 && std::isfinite(o.displacement), "displacement must be above 0");
}

void require_regular(const Affine& transform) {
    const double scale = transform.linear.norm();
    if (transform.is_finite() &&
        std::abs(transform.linear.determinant()) > kSingularRatio * scale * scale * scale) {
        return;
    }
    throw Error(ErrorCode::singular_transform,
                "the transform flattens space or is not finite; scale by factors other than zero");
}

// Throws `code` about the vertices of `handle` for which `bad` holds, if there are any.
template <typename Bad>
void refuse_vertices(const Region& handle, ErrorCode code, const std::string& message,
                     const Bad& bad) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : handle.vertices()) {
        if (bad(v)) elements.add(v);
    }
    if (elements.count == 0) return;
    const std::string names = describe(elements);
    throw Error(code, message + names, std::move(elements));
}

// Everything that depends on which vertices are held, but not on where they go.
struct Prepared {
    std::vector<Index> owner;
    Knowledge known;
    GradientStencils gradients;
    std::unique_ptr<GradientSystem> first;
    std::unique_ptr<RotationSystem> second;
    std::unique_ptr<LinearSolution> solution;
    /// Row in the region of each row of the solution, or kNoIndex for virtual vertices.
    std::vector<Index> region_row;
};

}  // namespace

DeformOptions DeformOptions::thesis() {
    DeformOptions options;
    options.second = SecondSystem::laplacian;
    options.coherence = 2;
    options.degenerate_threshold = 2e5;
    options.scale_free = false;
    return options;
}

struct Deformer::State {
    State(const Mesh& mesh, const Region& given, const DeformOptions& chosen);

    HandleState& handle(HandleId id);
    Index local_vertex(Index mesh_vertex) const;
    bool at_rest() const;

    // Transforms and positions below are relative to the patch's origin.
    Affine local(const Affine& transform) const;
    Mat4 base_transform() const;
    std::vector<Mat4> differences() const;
    Vec3 known_position(Index v) const;
    Vec3 known_deviation(Index v) const;
    Mat3 known_gradient(Index v) const;

    LinearProblem problem() const;
    void prepare(const Context& context);
    std::unique_ptr<Prepared> factored(const Context& context);
    void require_area() const;
    Vec3 start_of_sequence() const;
    [[noreturn]] void refuse_singular(const Error& error, const std::vector<Index>& free) const;

    void evaluate_deviation(const Context& context);
    Mat3 gradient_of(Index v) const;
    void find_gradients(const Context& context);
    Mat3 rotation_of(const Mat3& gradient) const;
    void solve_second(const Context& context);
    std::vector<Vec3> pulled_back(const std::vector<Vec3>& from) const;
    void write_positions(const std::vector<Vec3>& at);
    void write_held();
    void to_rest();

    Region region;
    DeformOptions options;
    Patch patch;
    Rings rings;
    RingGeometry geometry;
    Laplacian laplacian;
    /// Row in the region of each local vertex, or kNoIndex.
    std::vector<Index> region_row;
    std::vector<Vec3> rest;
    /// Greatest distance of a vertex of the region from the origin of the patch.
    double size = 0.0;
    RestNormals normals;

    std::vector<HandleState> handles;
    VertexConstraints constraints;

    /// Null where the set of held vertices has changed; `fixed_current` is false where the value of
    /// a vertex constraint has.
    std::unique_ptr<Prepared> prepared;
    bool fixed_current = false;

    /// Where local vertices lie after the first system, degenerate ones displaced, relative to
    /// where the base transform takes their rest position.
    std::vector<Vec3> deviation;
    Mat4 frame_base = Mat4::Zero();
    /// S_i less that of the base, for the second system, and its local positions. Outside the
    /// region the former stay zero only where the base is the identity; otherwise there is no
    /// outside.
    std::vector<Mat3> turns;
    std::vector<Vec3> second_positions;
    std::vector<Vec3> positions;
    std::vector<Mat3> gradients;
    bool deformed = false, gradients_current = true;
    DeformStats stats;
};

Deformer::State::State(const Mesh& mesh, const Region& given, const DeformOptions& chosen)
    : region(given), options(chosen), patch(build_patch(mesh, given, 1)), normals(mesh, given) {
    rings = build_rings(patch.vertex_count, patch.split_triangles);
    geometry = ring_geometry(rings, patch.split_triangles, patch.rest);
    laplacian = make_laplacian(rings, geometry, options.weights, options.scale_free);
    region_row.assign(static_cast<std::size_t>(patch.vertex_count), kNoIndex);
    for (Index row = 0; row < region.size(); ++row) {
        region_row[patch.of_region[row]] = row;
        rest.push_back(mesh.position(region.vertices()[row]));
        size = std::max(size, patch.rest[patch.of_region[row]].norm());
    }
    stats.region_vertices = region.size();
    stats.zero_area_faces = patch.zero_area_faces;
    stats.inserted_vertices = patch.vertex_count - patch.real_count;
    to_rest();
}

HandleState& Deformer::State::handle(HandleId id) {
    if (id.value < 0 || id.value >= static_cast<Index>(handles.size()) ||
        handles[id.value].removed) {
        throw Error(ErrorCode::handle_removed, "the handle was removed; add a new one");
    }
    return handles[id.value];
}

Index Deformer::State::local_vertex(Index mesh_vertex) const {
    const auto& ids = patch.mesh_vertex;
    return static_cast<Index>(std::lower_bound(ids.begin(), ids.end(), mesh_vertex) - ids.begin());
}

bool Deformer::State::at_rest() const {
    return constraints.empty() && std::all_of(handles.begin(), handles.end(), [](const auto& h) {
               return h.removed || h.transform.is_identity();
           });
}

Affine Deformer::State::local(const Affine& transform) const {
    return {transform.linear,
            transform.linear * patch.origin + transform.translation - patch.origin};
}

Mat4 Deformer::State::base_transform() const {
    const Index base = prepared->solution ? prepared->solution->base() : kNoIndex;
    return matrix_of(base == kNoIndex ? Affine{} : local(handles[base].transform));
}

std::vector<Mat4> Deformer::State::differences() const {
    const Mat4 base = base_transform();
    std::vector<Mat4> differences;
    for (const Index h : prepared->solution->handles()) {
        differences.push_back(matrix_of(local(handles[h].transform)) - base);
    }
    return differences;
}

Vec3 Deformer::State::known_position(Index v) const {
    const Index o = prepared->owner[v];
    if (o >= 0) return local(handles[o].transform)(patch.rest[v]);
    if (o == kConstrained && constraints.at(v).position) {
        return *constraints.at(v).position - patch.origin;
    }
    return patch.rest[v];
}

// Exactly zero for a handle that moves as the base does.
Vec3 Deformer::State::known_deviation(Index v) const {
    const Index o = prepared->owner[v];
    const Mat4 base = base_transform();
    const Vec4 rest_point = homogeneous(patch.rest[v]);
    if (o < 0) return known_position(v) - (base * rest_point).head<3>();
    return ((matrix_of(local(handles[o].transform)) - base) * rest_point).head<3>();
}

Mat3 Deformer::State::known_gradient(Index v) const {
    const Index o = prepared->owner[v];
    if (o >= 0) return handles[o].transform.linear;
    return o == kConstrained ? *constraints.at(v).gradient : Mat3(Mat3::Identity());
}

LinearProblem Deformer::State::problem() const {
    return {patch, rings, prepared->gradients, *prepared->first, prepared->owner, handles};
}

void Deformer::State::prepare(const Context& context) {
    if (!prepared) {
        prepared = factored(context);
        fixed_current = false;
    }
    if (fixed_current) return;
    if (prepared->solution) prepared->solution->solve_fixed(problem(), constraints);
    fixed_current = true;
}

// The centre of the first handle: rarely a centre of the surface itself, at which vertices that
// differ would lie equally far.
Vec3 Deformer::State::start_of_sequence() const {
    for (const HandleState& h : handles) {
        if (!h.removed) return h.center - patch.origin;
    }
    return Vec3::Zero();
}

void Deformer::State::require_area() const {
    if (patch.zero_area_vertices.count == 0) return;
    throw Error(ErrorCode::zero_area,
                "all faces around " + describe(patch.zero_area_vertices) +
                    " have no area; collapse those faces or leave them out of the region",
                patch.zero_area_vertices);
}

// Says in terms of vertices what the solver said in terms of rows.
void Deformer::State::refuse_singular(const Error& error, const std::vector<Index>& free) const {
    if (error.code() != ErrorCode::not_positive_definite) throw error;
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index row : error.elements().ids) {
        if (free[row] < patch.real_count) vertices.add(patch.mesh_vertex[free[row]]);
    }
    vertices.count = std::max(vertices.count, error.elements().count);
    const std::string names = describe(vertices);
    throw Error(ErrorCode::unconstrained,
                "the constraints do not determine the connected part of " + names +
                    "; add a handle with a gradient there",
                std::move(vertices));
}

std::unique_ptr<Prepared> Deformer::State::factored(const Context& context) {
    Progress progress(context, "deform: prepare");
    require_area();
    auto next = std::make_unique<Prepared>();
    next->owner = find_owners(patch, rings, handles, constraints);
    next->known = find_knowledge(patch, rings, next->owner, handles, constraints);
    require_constraints(patch, rings, next->known);

    progress.step(0.2);
    DeformStats cost = stats;
    auto start = std::chrono::steady_clock::now();
    next->gradients =
        make_gradients(patch, rings, geometry, next->known, start_of_sequence(), options);
    next->first = std::make_unique<GradientSystem>(patch, rings, geometry, laplacian,
                                                   next->gradients, next->known, options, context);
    next->second = std::make_unique<RotationSystem>(patch, next->known.position, options, context);
    cost.assemble_seconds = seconds_since(start);

    const auto free = static_cast<Index>(next->second->free_vertices().size());
    if (free > 0) {
        progress.step(0.45);
        try {
            next->first->factor(context);
        } catch (const Error& error) {
            refuse_singular(error, next->first->free_vertices());
        }
        progress.step(0.2);
        try {
            next->second->factor(context);
        } catch (const Error& error) {
            refuse_singular(error, next->second->free_vertices());
        }
        ++cost.factorizations;
    }
    for (const Index v : next->first->free_vertices()) next->region_row.push_back(region_row[v]);
    if (!next->region_row.empty()) {
        progress.step(0.15);
        start = std::chrono::steady_clock::now();
        next->solution = std::make_unique<LinearSolution>(
            LinearProblem{patch, rings, next->gradients, *next->first, next->owner, handles},
            context);
        cost.basis_seconds = seconds_since(start);
    }
    const FactorStats &first = next->first->stats(), &second = next->second->stats();
    cost.free_vertices = free;
    cost.constrained_vertices = region.size() - free;
    cost.displaced_vertices = static_cast<Index>(next->gradients.displaced.size());
    cost.first_nonzeros = first.factor_nonzeros;
    cost.second_nonzeros = second.factor_nonzeros;
    cost.factor_bytes = first.factor_bytes + second.factor_bytes;
    cost.first_factor_seconds = first.analyze_seconds + first.factor_seconds;
    cost.second_factor_seconds = second.analyze_seconds + second.factor_seconds;
    stats = cost;
    return next;
}

void Deformer::State::evaluate_deviation(const Context& context) {
    frame_base = base_transform();
    deviation.assign(static_cast<std::size_t>(patch.vertex_count), Vec3::Zero());
    if (!prepared->solution) return;
    for (const HandleState& h : handles) {
        const Mat4 difference = matrix_of(local(h.transform)) - frame_base;
        for (const Index v : h.local) {
            deviation[v] = (difference * homogeneous(patch.rest[v])).head<3>();
        }
    }
    for (const auto& entry : constraints) deviation[entry.first] = known_deviation(entry.first);
    const std::vector<Index>& free = prepared->first->free_vertices();
    const std::vector<Mat4> differences = this->differences();
    context.parallel_for(
        0, static_cast<Index>(free.size()), kFrameGrain, [&](Index begin, Index end) {
            for (Index row = begin; row < end; ++row) {
                deviation[free[row]] = prepared->solution->deviation(row, differences);
            }
        });
}

// M_i after the first system; where it does not exist, the mean of those around it.
Mat3 Deformer::State::gradient_of(Index v) const {
    if (prepared->known.gradient[v]) return known_gradient(v);
    const auto gathered = [&](Index u) -> Mat3 {
        if (prepared->known.gradient[u]) return known_gradient(u);
        return frame_base.topLeftCorner<3, 3>() + prepared->gradients.gather(rings, deviation, u);
    };
    if (prepared->gradients.defined[v]) return gathered(v);
    Mat3 sum = Mat3::Zero();
    int count = 0;
    for (const Index n : rings.ring(v)) {
        if (!prepared->known.gradient[n] && !prepared->gradients.defined[n]) continue;
        sum += gathered(n);
        ++count;
    }
    return count > 0 ? Mat3(sum / count) : Mat3(Mat3::Identity());
}

void Deformer::State::find_gradients(const Context& context) {
    if (gradients_current) return;
    evaluate_deviation(context);
    context.parallel_for(0, region.size(), kFrameGrain, [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row)
            gradients[row] = gradient_of(patch.of_region[row]);
    });
    gradients_current = true;
}

// S of the second system for a deformation gradient: R, or R s.
Mat3 Deformer::State::rotation_of(const Mat3& gradient) const {
    const Mat3 r = nearest_rotation(gradient);
    return options.local_size == LocalSize::scale ? Mat3(uniform_scale(gradient) * r) : r;
}

// Solves the second system for deviations from the similarity nearest to the base transform, so
// that similarities of the whole are exact. Returns local positions.
void Deformer::State::solve_second(const Context& context) {
    const Mat3 base_rotation = rotation_of(frame_base.topLeftCorner<3, 3>());
    const Mat3 remainder = frame_base.topLeftCorner<3, 3>() - base_rotation;
    turns.resize(static_cast<std::size_t>(patch.real_count), Mat3::Zero());
    context.parallel_for(0, region.size(), kFrameGrain, [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            turns[patch.of_region[row]] = rotation_of(gradients[row]) - base_rotation;
        }
    });
    std::vector<Vec3>& at = second_positions;
    at.resize(static_cast<std::size_t>(patch.real_count));
    for (Index v = 0; v < patch.real_count; ++v) at[v] = deviation[v] + remainder * patch.rest[v];
    prepared->second->solve(turns, at, context);
    for (const Index v : prepared->second->free_vertices()) {
        at[v] += base_rotation * patch.rest[v] + frame_base.topRightCorner<3, 1>();
    }
}

// Positions of the region's vertices for deviations `from` the base transform: displaced vertices
// come back by v = M (v - v') + v' (section 2.4.3).
std::vector<Vec3> Deformer::State::pulled_back(const std::vector<Vec3>& from) const {
    const Mat4 base = base_transform();
    const GradientStencils& g = prepared->gradients;
    std::vector<Vec3> at = from;
    for (const Index i : g.displaced) {
        if (g.defined[i]) at[i] += g.gather(rings, from, i) * (patch.rest[i] - g.displaced_rest[i]);
    }
    std::vector<Vec3> result;
    for (const Index v : patch.of_region) {
        result.push_back(at[v] + (base * homogeneous(patch.rest[v])).head<3>() + patch.origin);
    }
    return result;
}

// Writes the local positions of free vertices into those of the region. Vertices without faces that
// no handle holds never leave their rest position.
void Deformer::State::write_positions(const std::vector<Vec3>& at) {
    for (const Index v : prepared->second->free_vertices()) {
        positions[region_row[v]] = at[v] + patch.origin;
    }
    write_held();
}

// Held vertices lie where they were asked to, to the bit.
void Deformer::State::write_held() {
    for (const HandleState& h : handles) {
        if (h.removed) continue;
        const Affine transform = h.transform;
        const bool still = transform.is_identity();
        for (const Index v : h.local) {
            if (!prepared->known.position[v]) continue;
            const Index row = region_row[v];
            positions[row] = still ? rest[row] : transform(rest[row]);
        }
    }
    for (const auto& [v, constraint] : constraints) {
        if (constraint.position) positions[region_row[v]] = *constraint.position;
    }
}

void Deformer::State::to_rest() {
    positions = rest;
    gradients.assign(rest.size(), Mat3::Identity());
    gradients_current = true;
    deformed = false;
}

Deformer::Deformer(const Mesh& mesh, const Region& region, const DeformOptions& options,
                   const Context& context) {
    require_same_topology(mesh, region.topology(), "the region");
    require_options(options);
    if (region.empty()) {
        throw Error(ErrorCode::region_empty, "the region to deform has no vertices; enlarge it");
    }
    context.checkpoint();
    state_ = std::make_unique<State>(mesh, region, options);
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

HandleId Deformer::add_handle(const Region& vertices, const HandleOptions& options) {
    State& s = *state_;
    if (vertices.topology() != s.region.topology()) {
        throw Error(
            ErrorCode::topology_mismatch,
            "the handle's region belongs to another mesh or to an older version of this one");
    }
    if (vertices.empty()) throw Error(ErrorCode::region_empty, "the handle has no vertices");
    if (!options.position && !options.gradient) {
        throw Error(ErrorCode::invalid_argument,
                    "a handle must prescribe positions, gradients or both");
    }
    refuse_vertices(vertices, ErrorCode::handle_outside_region,
                    "the handle reaches outside the region at ",
                    [&](Index v) { return !s.region.contains(v); });
    const std::vector<Index> owner = find_owners(s.patch, s.rings, s.handles, s.constraints);
    refuse_vertices(vertices, ErrorCode::handle_overlap,
                    "another handle or constraint already holds ", [&](Index v) {
                        const Index o = owner[s.local_vertex(v)];
                        return o >= 0 || o == kConstrained;
                    });
    HandleState handle{vertices, options, {}, Vec3::Zero(), {}, false};
    for (const Index v : vertices.vertices()) {
        handle.local.push_back(s.local_vertex(v));
        handle.center += s.rest[s.region_row[handle.local.back()]] / vertices.size();
    }
    s.handles.push_back(std::move(handle));
    s.prepared.reset();
    ++s.stats.handles;
    return {static_cast<Index>(s.handles.size()) - 1};
}

void Deformer::remove_handle(HandleId id) {
    HandleState& handle = state_->handle(id);
    handle.removed = true;
    handle.local.clear();
    state_->prepared.reset();
    --state_->stats.handles;
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

void Deformer::set_transform(HandleId id, const Affine& transform) {
    HandleState& handle = state_->handle(id);
    require_regular(transform);
    const Affine local = state_->local(transform);
    const double turn = (local.linear - Mat3::Identity()).cwiseAbs().maxCoeff();
    const double shift = local.translation.cwiseAbs().maxCoeff();
    const bool still = turn < kIdentityTolerance && shift <= kIdentityTolerance * state_->size;
    handle.transform = still ? Affine{} : transform;
}

void Deformer::constrain(const VertexConstraint& constraint) {
    State& s = *state_;
    const Index v = constraint.vertex;
    const Elements named{ElementKind::vertex, 1, {v}};
    const auto refuse = [&](ErrorCode code, const std::string& what) {
        throw Error(code, "vertex " + std::to_string(v) + " " + what, named);
    };
    if (v < 0 || v >= s.region.topology()->vertex_count()) {
        refuse(ErrorCode::out_of_range, "does not exist");
    }
    if (!s.region.contains(v)) refuse(ErrorCode::handle_outside_region, "lies outside the region");
    if ((constraint.position && !constraint.position->allFinite()) ||
        (constraint.gradient && !constraint.gradient->allFinite())) {
        refuse(ErrorCode::not_finite, "cannot be constrained to NaN or infinity");
    }
    const Index local = s.local_vertex(v);
    for (const HandleState& handle : s.handles) {
        if (!handle.removed && handle.region.contains(v)) {
            refuse(ErrorCode::handle_overlap, "is held by a handle");
        }
    }
    const auto found = s.constraints.find(local);
    const bool same_kind = found != s.constraints.end() &&
                           found->second.position.has_value() == constraint.position.has_value() &&
                           found->second.gradient.has_value() == constraint.gradient.has_value();
    if (!constraint.position && !constraint.gradient) {
        if (found == s.constraints.end()) return;
        s.constraints.erase(found);
    } else {
        s.constraints.insert_or_assign(local, constraint);
    }
    if (!same_kind) s.prepared.reset();
    s.fixed_current = false;
}

void Deformer::prepare(const Context& context) {
    state_->prepare(context);
}

const std::vector<Vec3>& Deformer::preview(const Context& context) {
    State& s = *state_;
    s.prepare(context);
    if (s.at_rest()) {
        s.to_rest();
        return s.positions;
    }
    if (s.prepared->solution) {
        const LinearSolution& solution = *s.prepared->solution;
        const Mat4 base = s.base_transform();
        const std::vector<Mat4> differences = s.differences();
        context.parallel_for(0, solution.rows(), kFrameGrain, [&](Index begin, Index end) {
            for (Index row = begin; row < end; ++row) {
                const Index target = s.prepared->region_row[row];
                if (target == kNoIndex) continue;
                s.positions[target] = solution.position(row, base, differences) + s.patch.origin;
            }
        });
    }
    s.write_held();
    s.gradients_current = false;
    s.deformed = true;
    return s.positions;
}

const std::vector<Vec3>& Deformer::solve(const Context& context) {
    State& s = *state_;
    s.prepare(context);
    if (s.at_rest()) {
        s.to_rest();
        return s.positions;
    }
    context.checkpoint();
    s.gradients_current = false;
    s.find_gradients(context);
    if (s.prepared->second->free_vertices().empty()) {
        s.write_held();
    } else {
        s.solve_second(context);
        s.write_positions(s.second_positions);
    }
    s.deformed = true;
    return s.positions;
}

// Solves for the deviation from the base transform of the rest shape, which the system maps to
// itself: the rounding of its entries then acts on the deviation only.
std::vector<Vec3> Deformer::solve_first_directly(const Context& context) {
    State& s = *state_;
    s.prepare(context);
    const Mat4 base = s.base_transform();
    const Mat3 base_gradient = base.topLeftCorner<3, 3>();
    std::vector<Vec3> x(static_cast<std::size_t>(s.patch.vertex_count), Vec3::Zero());
    for (Index v = 0; v < s.patch.vertex_count; ++v) {
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
        const std::vector<double> y = s.prepared->first->solve(b, 3);
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
    State& s = *state_;
    require_same_topology(mesh, s.region.topology(), "the deformer");
    s.find_gradients({});
    const std::span<Vec3> out = mesh.edit_positions();
    for (Index row = 0; row < s.region.size(); ++row)
        out[s.region.vertices()[row]] = s.positions[row];
    s.normals.apply_to(mesh, s.gradients);
}

void Deformer::reset() {
    State& s = *state_;
    for (HandleState& handle : s.handles) handle.transform = {};
    if (!s.constraints.empty()) s.prepared.reset();
    s.constraints.clear();
    s.to_rest();
}

const std::vector<Mat3>& Deformer::gradients() {
    state_->find_gradients({});
    return state_->gradients;
}

// Weights and fixed part leave the coordinates of the patch: for a transform [L t] of the mesh's
// space the patch sees [L, L o + t - o].
HandleBasis Deformer::basis(const Context& context) {
    State& s = *state_;
    s.prepare(context);
    HandleBasis basis;
    basis.vertices = s.region.vertices();
    basis.handles = handles();
    const std::size_t rows = basis.vertices.size();
    const Vec3& o = s.patch.origin;
    basis.fixed.assign(rows, Vec3::Zero());
    basis.weights.assign(basis.handles.size(), std::vector<Vec4>(rows, Vec4::Zero()));
    const auto weights_of = [&](Index handle) -> std::vector<Vec4>& {
        const auto at = std::find(basis.handles.begin(), basis.handles.end(), HandleId{handle});
        return basis.weights[static_cast<std::size_t>(at - basis.handles.begin())];
    };
    for (Index row = 0; row < s.region.size(); ++row) {
        const Index v = s.patch.of_region[row], owner = s.prepared->owner[v];
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
        const Index row = s.region_row[free[f]];
        if (row == kNoIndex) continue;
        Vec4 rest_part = homogeneous(s.patch.rest[free[f]] + o);
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
