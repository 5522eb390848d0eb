#include "kernel/deform/deformer_state.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "kernel/deform/holds/boundary_refinement.h"
#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

using Vec3L = Eigen::Matrix<long double, 3, 1>;
using Mat3L = Eigen::Matrix<long double, 3, 3>;

// A mesh is far away where its coordinates spend three digits on its place.
constexpr double kFarAway = 1e3;

// Vertices around the region that have moved by less than this fraction of its size are where they
// were: no tear would be seen.
constexpr double kMoved = 1e-6;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Deformer::State::State(const Mesh& mesh, const Region& given, const DeformOptions& chosen,
                       const Context& given_context)
    : region(given),
      options(chosen),
      own_context(given_context),
      rest_patch(std::make_shared<WorkingPatch>(
          build_patch(given, mesh.positions(), kPatchRings, near_order(given, kPatchRings)),
          chosen)),
      directions(mesh, given) {
    for (const Index v : region.vertices()) rest.push_back(mesh.position(v));
    const Patch& patch = rest_patch->patch;
    for (Index i = 0; i < patch.mesh_count(); ++i) {
        const Index v = patch.mesh_vertex[i];
        if (!patch.in_region[i]) surroundings.emplace_back(v, mesh.position(v));
    }
    number_rows();
    to_rest();
}

// What follows from the rest patch.
void Deformer::State::number_rows() {
    const Patch& patch = rest_patch->patch;
    region_row.assign(static_cast<std::size_t>(patch.vertex_count), kNoIndex);
    size = 0.0;
    for (Index row = 0; row < region.size(); ++row) {
        region_row[patch.of_region[row]] = row;
        size = std::max(size, patch.rest[patch.of_region[row]].norm());
    }
    far_away = patch.origin.norm() > kFarAway * size;
    stats.region_vertices = region.size();
    stats.zero_area_faces = patch.zero_area_faces;
    stats.inserted_vertices = patch.vertex_count - patch.real_count;
}

HandleState& Deformer::State::handle(HandleId id) {
    if (id.value < 0 || id.value >= static_cast<Index>(handles.size()) ||
        handles[id.value].removed) {
        throw Error(ErrorCode::handle_removed, "the handle was removed; add a new one");
    }
    return handles[id.value];
}

// Of a vertex of the region.
Index Deformer::State::local_vertex(Index mesh_vertex) const {
    const std::vector<Index>& ids = region.vertices();
    const auto row = std::lower_bound(ids.begin(), ids.end(), mesh_vertex) - ids.begin();
    return rest_patch->patch.of_region[static_cast<std::size_t>(row)];
}

// Errors: topology_mismatch, naming vertices around the region that are not where they were.
void Deformer::State::require_surroundings(const Mesh& mesh) const {
    Elements moved{ElementKind::vertex, 0, {}};
    for (const auto& [v, at] : surroundings) {
        if (!((mesh.position(v) - at).norm() <= kMoved * size)) moved.add(v);
    }
    if (moved.count == 0) return;
    const std::string names = describe(moved);
    throw Error(ErrorCode::topology_mismatch,
                "the mesh has changed around the region since the deformation was made, at " +
                    names +
                    "; the result would tear there. Make a new deformation, or undo the change",
                std::move(moved));
}

// How the vertices that RestDirections::without_faces names have turned: with their handle.
std::vector<Mat3> Deformer::State::turns_without_faces() const {
    std::vector<Mat3> result;
    for (const Index row : directions.without_faces()) {
        const Index v = rest_patch->patch.of_region[row];
        result.push_back(Mat3::Identity());
        for (std::size_t h = 0; h < shown.size(); ++h) {
            const std::vector<Index>& held = handles[h].local;
            const bool holds = handles[h].options.gradient && !shown[h].is_identity() &&
                               std::find(held.begin(), held.end(), v) != held.end();
            if (holds) result.back() = nearest_rotation(shown[h].linear);
        }
    }
    return result;
}

bool Deformer::State::at_rest() const {
    const auto asks_nothing = [](const auto& constraint, const Vec3& at) {
        return (!constraint.position || *constraint.position == at) &&
               (!constraint.gradient || *constraint.gradient == Mat3::Identity());
    };
    return std::all_of(handles.begin(), handles.end(),
                       [](const auto& h) { return h.removed || h.at_rest(); }) &&
           std::all_of(constraints.begin(), constraints.end(),
                       [&](const auto& entry) {
                           return asks_nothing(entry.second, rest[region_row[entry.first]]);
                       }) &&
           std::all_of(points.begin(), points.end(), [&](const PointState& point) {
               return asks_nothing(point.asked,
                                   rest_position(point.row) + rest_patch->patch.origin);
           });
}

// Takes p to about + transform(p - about). Both forms of the transform come from differences in
// extended precision, so that a rotation about a point far from the origin keeps its digits.
void Deformer::State::place(HandleState& handle, const Affine& transform, const Vec3& about) const {
    const auto moved_to = [&](const Vec3& point) -> Affine {
        const Mat3L turn = transform.linear.cast<long double>() - Mat3L::Identity();
        const Vec3L arm = point.cast<long double>() - about.cast<long double>();
        return {transform.linear,
                (transform.translation.cast<long double>() + turn * arm).cast<double>()};
    };
    handle.transform = about.isZero(0.0) ? transform : moved_to(Vec3::Zero());
    handle.in_patch = moved_to(rest_patch->patch.origin);
}

// Where a vertex goes that the handle holds: transform(p), to the bit, unless the patch knows
// better.
Vec3 Deformer::State::held_position(const HandleState& handle, Index v) const {
    const Affine& transform = handle.transform;
    const Vec3& at_rest = rest[region_row[v]];
    if (transform.is_identity()) return at_rest;
    if (!far_away || transform.linear == Mat3::Identity()) return transform(at_rest);
    return rest_patch->patch.origin + handle.in_patch(rest_patch->patch.rest[v]);
}

Mat4 Deformer::State::base_transform() const {
    const Index base = prepared->solution ? prepared->solution->base() : kNoIndex;
    return matrix_of(base == kNoIndex ? Affine{} : handles[base].in_patch);
}

std::vector<Mat4> Deformer::State::differences() const {
    const Mat4 base = base_transform();
    std::vector<Mat4> differences;
    for (const Index h : prepared->solution->handles()) {
        differences.push_back(matrix_of(handles[h].in_patch) - base);
    }
    return differences;
}

Vec3 Deformer::State::known_position(Index v) const {
    const Patch& patch = prepared->work->patch;
    const Index o = prepared->owner[v];
    if (o >= 0) return handles[o].in_patch(patch.rest[v]);
    if (o == kConstrained && asked.at(v).position) {
        return *asked.at(v).position - patch.origin;
    }
    return patch.rest[v];
}

// Exactly zero for a handle that moves as the base does.
Vec3 Deformer::State::known_deviation(Index v) const {
    const Index o = prepared->owner[v];
    const Mat4 base = base_transform();
    const Vec4 rest_point = homogeneous(prepared->work->patch.rest[v]);
    if (o < 0) return known_position(v) - (base * rest_point).head<3>();
    return ((matrix_of(handles[o].in_patch) - base) * rest_point).head<3>();
}

Mat3 Deformer::State::known_gradient(Index v) const {
    const Index o = prepared->owner[v];
    if (o >= 0) return handles[o].in_patch.linear;
    if (o != kConstrained) return Mat3::Identity();
    return asked.at(v).gradient.value_or(Mat3(Mat3::Identity()));
}

LinearProblem Deformer::State::problem() const {
    return {prepared->work->patch, prepared->work->rings, prepared->gradients,
            *prepared->first,      prepared->owner,       handles};
}

void Deformer::State::collect_asked() {
    asked = constraints;
    for (const auto& [v, number] : prepared->asked) {
        const PointConstraint& point = points[number].asked;
        const bool anchor = v >= prepared->work->patch.surface_count;
        asked[v] = {v, anchor ? point.position : std::nullopt, point.gradient, {}};
    }
}

void Deformer::State::prepare(const Context& context) {
    if (!prepared) {
        prepared = factored(context);
        turns.clear();
        fixed_current = false;
    }
    if (fixed_current) return;
    collect_asked();
    if (prepared->solution) prepared->solution->solve_fixed(problem(), asked);
    fixed_current = true;
}

// The centre of the first handle, or between it and its mirror image: rarely a centre of the
// surface itself, at which vertices that differ would lie equally far.
Vec3 Deformer::State::start_of_sequence() const {
    for (const HandleState& h : handles) {
        if (h.removed) continue;
        const Vec3 center =
            h.partner == kNoIndex ? h.center : Vec3(0.5 * (h.center + handles[h.partner].center));
        return center - rest_patch->patch.origin;
    }
    return Vec3::Zero();
}

void Deformer::State::require_area() const {
    const Elements& vertices = rest_patch->patch.zero_area_vertices;
    if (vertices.count == 0) return;
    throw Error(ErrorCode::zero_area,
                "all faces around " + describe(vertices) +
                    " have no area; collapse those faces or leave them out of the region",
                vertices);
}

// Says in terms of vertices what the solver said in terms of rows.
void Deformer::State::refuse_singular(const Error& error, const std::vector<Index>& free) const {
    const Patch& patch = rest_patch->patch;
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

// Factors `system`, where it has unknowns.
template <typename System>
void Deformer::State::factor(System& system, const Context& context) const {
    if (system.free_vertices().empty()) return;
    try {
        system.factor(context);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::not_positive_definite) throw;
        refuse_singular(error, system.free_vertices());
    }
}

std::shared_ptr<const WorkingPatch> Deformer::State::working_patch() const {
    std::shared_ptr<const WorkingPatch> work = rest_patch;
    if (options.refine_borders && options.method == DeformMethod::implicit) {
        std::optional<Patch> refined =
            refined_at_borders(work->patch, find_holding(*work, holds()));
        if (refined) work = std::make_shared<WorkingPatch>(std::move(*refined), options);
    }
    return holds().change_patch() ? anchored(*work, holds()) : work;
}

void Deformer::State::collect_held(Prepared& next) const {
    const Patch& patch = next.work->patch;
    for (const HandleState& handle : handles) next.held.push_back(handle.local);
    for (Index v = patch.mesh_count(); v < patch.real_count; ++v) {
        if (next.owner[v] >= 0) next.held[next.owner[v]].push_back(v);
    }
}

// Where a frame keeps the position of local vertex v.
Index Deformer::State::frame_row(const Patch& patch, Index v) const {
    if (v < patch.mesh_count()) return region_row[v];
    return v < patch.real_count ? region.size() + v - patch.mesh_count() : kNoIndex;
}

std::unique_ptr<Prepared> Deformer::State::factored(const Context& context) {
    Progress progress(context, "deform: prepare");
    require_area();
    auto next = std::make_unique<Prepared>();
    if (options.method != DeformMethod::implicit) require_plain_holds();
    next->work = working_patch();
    const Patch& patch = next->work->patch;
    const Rings& rings = next->work->rings;
    Holding holding = find_holding(*next->work, holds());
    require_constraints(*next->work, holding.known);
    next->owner = std::move(holding.owner);
    next->known = std::move(holding.known);
    next->asked = std::move(holding.asked);
    collect_held(*next);
    for (const Index v : patch.of_region) {
        if (next->owner[v] == kPinned) next->resting_rows.push_back(region_row[v]);
    }
    if (options.method != DeformMethod::implicit) {
        prepare_comparison(*next, context);
        return next;
    }

    progress.step(0.2);
    const auto start = std::chrono::steady_clock::now();
    next->gradients = make_gradients(patch, rings, next->work->geometry, next->known,
                                     start_of_sequence(), options);
    next->first = std::make_unique<GradientSystem>(*next->work, next->gradients, next->known,
                                                   options, context);
    next->second =
        std::make_unique<RotationSystem>(*next->work, next->known.position, options, context);
    const double assemble_seconds = seconds_since(start);

    progress.step(0.6);
    // The two do not depend on each other.
    context.parallel_for(0, 2, 1, [&](Index begin, Index end) {
        for (Index system = begin; system < end; ++system) {
            system == 0 ? factor(*next->first, context) : factor(*next->second, context);
        }
    });
    progress.step(0.05);
    if (!next->second->free_vertices().empty()) next->second->finish(context);

    progress.step(0.15);
    const auto basis_start = std::chrono::steady_clock::now();
    for (const Index v : next->first->free_vertices()) {
        next->frame_row.push_back(frame_row(patch, v));
    }
    std::vector<Index> surface = patch.of_region;
    for (Index v = patch.mesh_count(); v < patch.real_count; ++v) surface.push_back(v);
    for (const Index v : surface) {
        if (next->known.gradient[v]) continue;
        (next->gradients.defined[v] ? next->gathered : next->averaged).push_back(v);
    }
    if (!next->frame_row.empty()) {
        next->solution = std::make_unique<LinearSolution>(
            LinearProblem{patch, rings, next->gradients, *next->first, next->owner, handles},
            context);
    }
    count_costs(*next);
    stats.assemble_seconds = assemble_seconds;
    stats.basis_seconds = seconds_since(basis_start);
    return next;
}

void Deformer::State::count_costs(const Prepared& next) {
    const FactorStats &first = next.first->stats(), &second = next.second->stats();
    stats.free_vertices = static_cast<Index>(next.second->free_vertices().size());
    stats.constrained_vertices = 0;
    for (const Index v : next.work->patch.of_region) {
        stats.constrained_vertices += next.known.position[v];
    }
    stats.displaced_vertices = static_cast<Index>(next.gradients.displaced.size());
    stats.refined_vertices = static_cast<Index>(next.work->patch.inserted.size());
    stats.first_nonzeros = first.factor_nonzeros;
    stats.second_nonzeros = second.factor_nonzeros;
    stats.factor_bytes = first.factor_bytes + second.factor_bytes;
    stats.first_factor_seconds = first.analyze_seconds + first.factor_seconds;
    stats.second_factor_seconds = second.analyze_seconds + second.factor_seconds;
    stats.factorizations += stats.free_vertices > 0 ? 1 : 0;
}

// Positions of the region's vertices for deviations `from` the base transform: displaced vertices
// come back by v = M (v - v') + v' (section 2.4.3).
std::vector<Vec3> Deformer::State::pulled_back(const std::vector<Vec3>& from) const {
    const Patch& patch = prepared->work->patch;
    const Rings& rings = prepared->work->rings;
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

}  // namespace lissom
