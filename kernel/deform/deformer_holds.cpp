// What a user asks a Deformer to hold: handles and constraints.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/deform/deformer.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/holds/mirror.h"

namespace lissom {
namespace {

// Throws `code` about those of `vertices` for which `bad` holds, if there are any.
template <typename Bad>
void refuse_vertices(const std::vector<Index>& vertices, ErrorCode code, const std::string& message,
                     const Bad& bad) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : vertices) {
        if (bad(v)) elements.add(v);
    }
    if (elements.count == 0) return;
    const std::string names = describe(elements);
    throw Error(code, message + names, std::move(elements));
}

void require_topology(const Region& region, const Region& vertices) {
    if (vertices.topology() == region.topology()) return;
    throw Error(ErrorCode::topology_mismatch,
                "the region given belongs to another mesh or to an older version of this one");
}

void require_weight(const std::optional<double>& weight) {
    if (!weight || (*weight > 0.0 && std::isfinite(*weight))) return;
    throw Error(ErrorCode::invalid_argument,
                "a weight must be above 0; leave it out where the constraint is to hold exactly");
}

void require_handle_options(const HandleOptions& options) {
    if (!options.position && !options.gradient) {
        throw Error(ErrorCode::invalid_argument,
                    "a handle must prescribe positions, gradients or both");
    }
    require_weight(options.weight);
    if (!(options.falloff >= 0.0 && std::isfinite(options.falloff))) {
        throw Error(ErrorCode::invalid_argument, "a falloff must be a distance of 0 or more");
    }
}

void require_finite(const PointConstraint& constraint) {
    if ((!constraint.position || constraint.position->allFinite()) &&
        (!constraint.gradient || constraint.gradient->allFinite())) {
        return;
    }
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index v : constraint.point.vertices) vertices.add(v);
    const std::string names = describe(vertices);
    throw Error(ErrorCode::not_finite, names + " cannot be constrained to NaN or infinity",
                std::move(vertices));
}

}  // namespace

SparseRow Deformer::State::local_row(const MeshPoint& point) const {
    SparseRow row;
    for (std::size_t i = 0; i < point.vertices.size(); ++i) {
        row.emplace_back(local_vertex(point.vertices[i]), point.weights[i]);
    }
    return row;
}

Vec3 Deformer::State::rest_position(const SparseRow& row) const {
    Vec3 at = Vec3::Zero();
    for (const auto& [v, c] : row) at += c * rest_patch->patch.rest[v];
    return at;
}

// Errors: handle_outside_region where no vertex of the point may move.
void Deformer::State::require_inside(const MeshPoint& point) const {
    const bool inside = std::any_of(point.vertices.begin(), point.vertices.end(),
                                    [&](Index v) { return region.contains(v); });
    if (inside) return;
    refuse_vertices(point.vertices, ErrorCode::handle_outside_region,
                    "a point lies outside the region, between ", [](Index) { return true; });
}

// Errors: handle_overlap where handles but `except`, or constraints, hold some of `vertices`.
void Deformer::State::require_unheld(const std::vector<Index>& vertices,
                                     std::span<const Index> except) const {
    std::vector<char> held(static_cast<std::size_t>(rest_patch->patch.vertex_count), 0);
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (std::find(except.begin(), except.end(), static_cast<Index>(h)) != except.end())
            continue;
        for (const Index v : handles[h].local) held[v] = 1;
    }
    for (const auto& entry : constraints) held[entry.first] = 1;
    for (const PointState& point : points) {
        if (point.row.size() == 1) held[point.row.front().first] = 1;
    }
    refuse_vertices(vertices, ErrorCode::handle_overlap,
                    "another handle or constraint already holds ",
                    [&](Index v) { return held[local_vertex(v)] != 0; });
}

Vec3 Deformer::State::center_of(const HandleState& handle) const {
    const auto count = static_cast<double>(handle.points.size() + handle.local.size());
    Vec3 center = Vec3::Zero();
    for (const Index v : handle.local) center += rest_patch->patch.rest[v] / count;
    for (const SparseRow& row : handle.points) center += rest_position(row) / count;
    return center + rest_patch->patch.origin;
}

HandleId Deformer::State::add(HandleState handle) {
    handle.center = center_of(handle);
    drop_prepared();
    handles.push_back(std::move(handle));
    ++stats.handles;
    return {static_cast<Index>(handles.size()) - 1};
}

// Errors: as add_handle, beside the handles with numbers in `except`.
void Deformer::State::require_handle_region(const Region& vertices,
                                            std::span<const Index> except) const {
    require_topology(region, vertices);
    if (vertices.empty()) throw Error(ErrorCode::region_empty, "the handle has no vertices");
    refuse_vertices(vertices.vertices(), ErrorCode::handle_outside_region,
                    "the handle reaches outside the region at ",
                    [&](Index v) { return !region.contains(v); });
    require_unheld(vertices.vertices(), except);
}

HandleId Deformer::add_handle(const Region& vertices, const HandleOptions& options) {
    State& s = *state_;
    require_handle_options(options);
    s.require_handle_region(vertices);
    HandleState handle{vertices, options};
    for (const Index v : vertices.vertices()) handle.local.push_back(s.local_vertex(v));
    return s.add(std::move(handle));
}

void Deformer::set_handle_region(HandleId id, const Region& vertices) {
    State& s = *state_;
    HandleState& handle = s.handle(id);
    HandleState changed = handle;
    changed.region = vertices;
    changed.points.clear();
    changed.local.clear();
    s.require_handle_region(vertices, std::array{id.value, handle.partner});
    for (const Index v : vertices.vertices()) changed.local.push_back(s.local_vertex(v));
    changed.center = s.center_of(changed);
    if (handle.partner != kNoIndex) {
        HandleState image = s.mirrored(id.value, changed, changed.mirror);
        s.drop_prepared();
        s.handles[handle.partner] = std::move(image);
    }
    s.drop_prepared();
    handle = std::move(changed);
}

// Errors: invalid_argument where some of the local vertices have no counterpart in the region.
std::vector<Index> Deformer::State::counterparts_of(const std::vector<Index>& local,
                                                    const MirrorPlane& plane) const {
    const Patch& patch = rest_patch->patch;
    const Affine mirror = reflection({plane.point - patch.origin, plane.normal, 0.0});
    const double tolerance = plane.tolerance > 0.0 ? plane.tolerance : 1e-3 * rest_patch->radius;
    std::vector<Index> found = counterparts(patch.rest, local, patch.of_region, mirror, tolerance);
    std::vector<Index> alone;
    for (std::size_t i = 0; i < local.size(); ++i) {
        if (found[i] == kNoIndex) alone.push_back(patch.mesh_vertex[local[i]]);
    }
    refuse_vertices(alone, ErrorCode::invalid_argument,
                    "the mirror plane or its tolerance leave no counterpart to ",
                    [](Index) { return true; });
    return found;
}

// Moves the mirror image of a handle along.
void Deformer::State::reflect(const HandleState& handle, const MirrorPlane& plane,
                              HandleState& image) const {
    const Affine whole = reflection(plane);
    image.set_at_rest();
    image.turn = -(whole.linear * handle.turn);
    if (handle.transform.is_identity()) return;
    const Affine local = reflection({plane.point - rest_patch->patch.origin, plane.normal, 0.0});
    image.transform = whole * handle.transform * whole;
    image.in_patch = local * handle.in_patch * local;
}

// The mirror image of a handle, which keeps clear of that handle and of all others but its present
// image.
HandleState Deformer::State::mirrored(Index number, const HandleState& handle,
                                      const MirrorPlane& plane) const {
    const Patch& patch = rest_patch->patch;
    HandleState image = handle;
    image.mirror = plane;
    image.local = counterparts_of(handle.local, plane);
    std::sort(image.local.begin(), image.local.end());
    for (SparseRow& row : image.points) {
        std::vector<Index> around;
        for (const auto& [v, c] : row) around.push_back(v);
        const std::vector<Index> across = counterparts_of(around, plane);
        for (std::size_t i = 0; i < row.size(); ++i) row[i].first = across[i];
        std::sort(row.begin(), row.end());
    }
    std::vector<Index> vertices, held;
    for (const Index v : image.local) held.push_back(patch.mesh_vertex[v]);
    vertices = held;
    for (const SparseRow& row : image.points) {
        for (const auto& [v, c] : row) vertices.push_back(patch.mesh_vertex[v]);
    }
    refuse_vertices(vertices, ErrorCode::handle_overlap,
                    "the handle meets its mirror image; leave out what is near the plane, as ",
                    [&](Index v) { return handle.region.contains(v); });
    require_unheld(held, std::array{number, handle.partner});
    image.partner = number;
    image.region = Region(region.topology(), vertices);
    image.center = center_of(image);
    reflect(handle, plane, image);
    return image;
}

HandleId Deformer::mirror_handle(HandleId id, const MirrorPlane& plane) {
    State& s = *state_;
    if (s.handle(id).partner != kNoIndex) {
        throw Error(ErrorCode::invalid_argument, "the handle has a mirror image already");
    }
    const HandleId added = s.add(s.mirrored(id.value, s.handle(id), plane));
    s.handles[id.value].partner = added.value;
    s.handles[id.value].mirror = plane;
    return added;
}

std::optional<HandleId> Deformer::mirrored_handle(HandleId id) const {
    const Index partner = state_->handle(id).partner;
    return partner == kNoIndex ? std::nullopt : std::optional<HandleId>(HandleId{partner});
}

void Deformer::remove_handle(HandleId id) {
    State& s = *state_;
    HandleState& handle = s.handle(id);
    s.drop_prepared();
    handle.removed = true;
    handle.local.clear();
    handle.points.clear();
    if (handle.partner != kNoIndex) s.handles[handle.partner].partner = kNoIndex;
    --s.stats.handles;
}

HandleId Deformer::add_handle(std::span<const MeshPoint> points, const HandleOptions& options) {
    State& s = *state_;
    if (points.empty()) throw Error(ErrorCode::region_empty, "the handle has no points");
    require_handle_options(options);
    std::vector<Index> held, around;
    std::vector<SparseRow> rows;
    for (const MeshPoint& given : points) {
        const MeshPoint point = checked_point(*s.region.topology(), given);
        s.require_inside(point);
        around.insert(around.end(), point.vertices.begin(), point.vertices.end());
        if (point.vertices.size() == 1) {
            held.push_back(point.vertices.front());
        } else {
            rows.push_back(s.local_row(point));
        }
    }
    s.require_unheld(held);
    HandleState handle{Region(s.region.topology(), around), options};
    const Region held_region(s.region.topology(), held);
    for (const Index v : held_region.vertices()) handle.local.push_back(s.local_vertex(v));
    handle.points = std::move(rows);
    return s.add(std::move(handle));
}

void Deformer::constrain(const VertexConstraint& constraint) {
    const Index v = constraint.vertex;
    const Elements named{ElementKind::vertex, 1, {v}};
    if (v < 0 || v >= state_->region.topology()->vertex_count()) {
        throw Error(ErrorCode::out_of_range, "vertex " + std::to_string(v) + " does not exist",
                    named);
    }
    constrain({vertex_point(v), constraint.position, constraint.gradient, constraint.weight});
}

void Deformer::constrain(const PointConstraint& given) {
    State& s = *state_;
    require_weight(given.weight);
    PointConstraint asked = given;
    asked.point = checked_point(*s.region.topology(), given.point);
    s.require_inside(asked.point);
    require_finite(asked);
    const SparseRow row = s.local_row(asked.point);
    if (row.size() == 1) {
        for (const HandleState& handle : s.handles) {
            const bool held = std::find(handle.local.begin(), handle.local.end(),
                                        row.front().first) != handle.local.end();
            if (held) s.require_unheld(asked.point.vertices);
        }
    }
    s.set_constraint(row, std::move(asked));
}

void Deformer::set_stiffness(const Region& vertices, double factor) {
    State& s = *state_;
    require_topology(s.region, vertices);
    if (!(factor > 0.0 && std::isfinite(factor))) {
        throw Error(ErrorCode::invalid_argument, "a stiffness must be above 0; 1 is as usual");
    }
    refuse_vertices(vertices.vertices(), ErrorCode::handle_outside_region,
                    "outside the region there is nothing to make stiff, at ",
                    [&](Index v) { return !s.region.contains(v); });
    if (s.vertex_stiffness.empty()) {
        s.vertex_stiffness.assign(static_cast<std::size_t>(s.rest_patch->patch.real_count), 1.0);
    }
    s.drop_prepared();
    for (const Index v : vertices.vertices()) s.vertex_stiffness[s.local_vertex(v)] = factor;
}

// Replaces what is asked of a point. Where only the asked values change the preparation stays.
void Deformer::State::set_constraint(const SparseRow& row, PointConstraint asked_now) {
    const bool wanted = asked_now.position || asked_now.gradient;
    find_gradients();
    const std::optional<PointConstraint> before = take_constraint(row);
    const bool same_kind =
        before ? before->position.has_value() == asked_now.position.has_value() &&
                     before->gradient.has_value() == asked_now.gradient.has_value() &&
                     before->weight == asked_now.weight
               : !wanted;
    if (!same_kind) drop_prepared();
    fixed_current = false;
    if (!wanted) return;
    if (row.size() == 1 && !asked_now.weight) {
        const Index v = row.front().first;
        constraints[v] = {
            asked_now.point.vertices.front(), asked_now.position, asked_now.gradient, {}};
    } else {
        const auto at = std::find_if(points.begin(), points.end(),
                                     [&](const PointState& p) { return !(p.row < row); });
        points.insert(at, {std::move(asked_now), row});
    }
}

// Removes and returns the constraint of a point, if there is one.
std::optional<PointConstraint> Deformer::State::take_constraint(const SparseRow& row) {
    const auto point = std::find_if(points.begin(), points.end(),
                                    [&](const PointState& p) { return p.row == row; });
    if (point != points.end()) {
        PointConstraint found = std::move(point->asked);
        points.erase(point);
        return found;
    }
    const auto vertex = row.size() == 1 ? constraints.find(row.front().first) : constraints.end();
    if (vertex == constraints.end()) return std::nullopt;
    const VertexConstraint& c = vertex->second;
    PointConstraint found{vertex_point(c.vertex), c.position, c.gradient, {}};
    constraints.erase(vertex);
    return found;
}

}  // namespace lissom
