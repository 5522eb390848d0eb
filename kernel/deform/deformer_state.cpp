#include "kernel/deform/deformer_state.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "kernel/deform/polar.h"

namespace lissom {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Deformer::State::State(const Mesh& mesh, const Region& given, const DeformOptions& chosen)
    : region(given),
      options(chosen),
      rest_patch(std::make_shared<WorkingPatch>(build_patch(given, mesh.positions(), 1), chosen)),
      directions(mesh, given) {
    for (const Index v : region.vertices()) rest.push_back(mesh.position(v));
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

Index Deformer::State::local_vertex(Index mesh_vertex) const {
    const auto& ids = rest_patch->patch.mesh_vertex;
    return static_cast<Index>(std::lower_bound(ids.begin(), ids.end(), mesh_vertex) - ids.begin());
}

bool Deformer::State::at_rest() const {
    const auto asks_nothing = [](const auto& constraint, const Vec3& at) {
        return (!constraint.position || *constraint.position == at) &&
               (!constraint.gradient || *constraint.gradient == Mat3::Identity());
    };
    return std::all_of(handles.begin(), handles.end(),
                       [](const auto& h) { return h.removed || h.transform.is_identity(); }) &&
           std::all_of(constraints.begin(), constraints.end(),
                       [&](const auto& entry) {
                           return asks_nothing(entry.second, rest[region_row[entry.first]]);
                       }) &&
           std::all_of(points.begin(), points.end(), [&](const PointState& point) {
               return asks_nothing(point.asked, rest_position(point.row));
           });
}

Affine Deformer::State::local(const Affine& transform) const {
    const Vec3& origin = rest_patch->patch.origin;
    return {transform.linear, transform.linear * origin + transform.translation - origin};
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
    const Patch& patch = prepared->work->patch;
    const Index o = prepared->owner[v];
    if (o >= 0) return local(handles[o].transform)(patch.rest[v]);
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
    return ((matrix_of(local(handles[o].transform)) - base) * rest_point).head<3>();
}

Mat3 Deformer::State::known_gradient(Index v) const {
    const Index o = prepared->owner[v];
    if (o >= 0) return handles[o].transform.linear;
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
        fixed_current = false;
    }
    if (fixed_current) return;
    collect_asked();
    if (prepared->solution) prepared->solution->solve_fixed(problem(), asked);
    fixed_current = true;
}

// The centre of the first handle: rarely a centre of the surface itself, at which vertices that
// differ would lie equally far.
Vec3 Deformer::State::start_of_sequence() const {
    for (const HandleState& h : handles) {
        if (!h.removed) return h.center - rest_patch->patch.origin;
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

std::unique_ptr<Prepared> Deformer::State::factored(const Context& context) {
    Progress progress(context, "deform: prepare");
    require_area();
    auto next = std::make_unique<Prepared>();
    next->work = holds().change_patch() ? anchored(*rest_patch, holds()) : rest_patch;
    const Patch& patch = next->work->patch;
    const Rings& rings = next->work->rings;
    Holding holding = find_holding(*next->work, holds());
    require_constraints(*next->work, holding.known);
    next->owner = std::move(holding.owner);
    next->known = std::move(holding.known);
    next->asked = std::move(holding.asked);

    progress.step(0.2);
    const auto start = std::chrono::steady_clock::now();
    next->gradients = make_gradients(patch, rings, next->work->geometry, next->known,
                                     start_of_sequence(), options);
    next->first = std::make_unique<GradientSystem>(*next->work, next->gradients, next->known,
                                                   options, context);
    next->second =
        std::make_unique<RotationSystem>(*next->work, next->known.position, options, context);
    const double assemble_seconds = seconds_since(start);

    progress.step(0.45);
    factor(*next->first, context);
    progress.step(0.2);
    factor(*next->second, context);

    progress.step(0.15);
    const auto basis_start = std::chrono::steady_clock::now();
    for (const Index v : next->first->free_vertices()) {
        next->region_row.push_back(v < patch.real_count ? region_row[v] : kNoIndex);
    }
    if (!next->region_row.empty()) {
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
    stats.constrained_vertices = region.size() - stats.free_vertices;
    stats.displaced_vertices = static_cast<Index>(next.gradients.displaced.size());
    stats.first_nonzeros = first.factor_nonzeros;
    stats.second_nonzeros = second.factor_nonzeros;
    stats.factor_bytes = first.factor_bytes + second.factor_bytes;
    stats.first_factor_seconds = first.analyze_seconds + first.factor_seconds;
    stats.second_factor_seconds = second.analyze_seconds + second.factor_seconds;
    stats.factorizations += stats.free_vertices > 0 ? 1 : 0;
}

void Deformer::State::evaluate_deviation(const Context& context) {
    const Patch& patch = prepared->work->patch;
    frame_base = base_transform();
    deviation.assign(static_cast<std::size_t>(patch.vertex_count), Vec3::Zero());
    for (const HandleState& h : handles) {
        const Mat4 difference = matrix_of(local(h.transform)) - frame_base;
        for (const Index v : h.local) {
            deviation[v] = (difference * homogeneous(patch.rest[v])).head<3>();
        }
    }
    for (const auto& entry : asked) deviation[entry.first] = known_deviation(entry.first);
    for (Index v = patch.surface_count; v < patch.vertex_count; ++v) {
        deviation[v] = known_deviation(v);
    }
    if (!prepared->solution) return;
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
    const Rings& rings = prepared->work->rings;
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
    const Patch& patch = prepared->work->patch;
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

// S_i less that of the base. Handles turn as a whole.
void Deformer::State::find_turns(const Mat3& base_rotation, const Context& context) {
    const Patch& patch = prepared->work->patch;
    turns.resize(static_cast<std::size_t>(patch.real_count), Mat3::Zero());
    context.parallel_for(0, region.size(), kFrameGrain, [&](Index begin, Index end) {
        const std::size_t count = static_cast<std::size_t>(end - begin);
        const std::span<const Mat3> m(gradients.data() + begin, count);
        std::vector<Mat3> rotations(count);
        nearest_rotations(m, rotations);
        for (std::size_t i = 0; i < count; ++i) {
            const Index v = patch.of_region[static_cast<std::size_t>(begin) + i];
            const double scale = options.local_size == LocalSize::scale ? uniform_scale(m[i]) : 1.0;
            turns[v] = scale * rotations[i] - base_rotation;
        }
    });
    for (const HandleState& h : handles) {
        if (h.removed || h.soft() || !h.options.gradient) continue;
        const Mat3 turn = rotation_of(h.transform.linear) - base_rotation;
        for (const Index v : h.local) turns[v] = turn;
    }
}

// Solves the second system for deviations from the similarity nearest to the base transform, so
// that similarities of the whole are exact. Leaves local positions.
void Deformer::State::solve_second(bool draft, const Context& context) {
    const Patch& patch = prepared->work->patch;
    const Mat3 base_rotation = rotation_of(frame_base.topLeftCorner<3, 3>());
    const Mat3 remainder = frame_base.topLeftCorner<3, 3>() - base_rotation;
    find_turns(base_rotation, context);
    std::vector<Vec3>& at = second_positions;
    at.resize(static_cast<std::size_t>(patch.vertex_count));
    context.parallel_for(0, patch.vertex_count, kFrameGrain, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) at[v] = deviation[v] + remainder * patch.rest[v];
    });
    prepared->second->set_transforms(turns, context);
    prepared->second->solve(at, draft, context);
    const Vec3 shift = frame_base.topRightCorner<3, 1>();
    for (const Index v : prepared->second->free_vertices()) {
        at[v] += base_rotation * patch.rest[v] + shift;
    }
}

void Deformer::State::solve(bool draft, const Context& context) {
    prepare(context);
    if (at_rest()) return to_rest();
    context.checkpoint();
    gradients_current = false;
    find_gradients(context);
    if (prepared->second->free_vertices().empty()) {
        write_held();
    } else {
        solve_second(draft, context);
        write_positions(second_positions);
    }
    deformed = true;
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

// Writes the local positions of free vertices into those of the region. Vertices without faces that
// no handle holds never leave their rest position.
void Deformer::State::write_positions(const std::vector<Vec3>& at) {
    for (const Index v : prepared->second->free_vertices()) {
        positions[region_row[v]] = at[v] + rest_patch->patch.origin;
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

}  // namespace lissom
