// What a user asks a Deformer to hold, and where it is to go.
#include <algorithm>
#include <string>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/mirror_residual.h"

namespace lissom {

std::vector<HandleId> Deformer::handles() const {
    std::vector<HandleId> ids;
    for (std::size_t h = 0; h < state_->holds->handles.size(); ++h) {
        if (state_->holds->handles[h]) ids.push_back({index_of(h)});
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
std::optional<HandleId> Deformer::mirrored_handle(HandleId id) const {
    const Index partner = state_->handle(id).partner;
    return partner == kNoIndex ? std::nullopt : std::optional<HandleId>(HandleId{partner});
}

MirrorResidual Deformer::mirror_residual(HandleId id) const {
    const Handle& handle = state_->handle(id);
    require(handle.partner != kNoIndex, "the handle has no mirror image");
    return with_memory_errors([&] { return residual_of(*state_->rest, handle); });
}

// ---- Who is held

HandleId Deformer::add_handle(const Region& vertices, const HandleOptions& options) {
    return with_memory_errors([&] {
        return state_->edit([&](HoldEdit& edit) { return edit.add_handle(vertices, options); });
    });
}

HandleId Deformer::add_handle(std::span<const MeshPoint> points, const HandleOptions& options) {
    return with_memory_errors([&] {
        return state_->edit([&](HoldEdit& edit) { return edit.add_handle(points, options); });
    });
}

void Deformer::remove_handle(HandleId id) {
    with_memory_errors([&] { state_->edit([&](HoldEdit& edit) { edit.remove_handle(id); }); });
}

HandleId Deformer::mirror_handle(HandleId id, const MirrorPlane& plane) {
    return with_memory_errors([&] {
        return state_->edit([&](HoldEdit& edit) { return edit.mirror_handle(id, plane); });
    });
}

void Deformer::set_handle_region(HandleId id, const Region& vertices) {
    with_memory_errors(
        [&] { state_->edit([&](HoldEdit& edit) { edit.set_handle_region(id, vertices); }); });
}

void Deformer::set_stiffness(const Region& vertices, double factor) {
    with_memory_errors(
        [&] { state_->edit([&](HoldEdit& edit) { edit.set_stiffness(vertices, factor); }); });
}

void Deformer::constrain(const VertexConstraint& constraint) {
    const Index v = constraint.vertex;
    if (v < 0 || v >= region().topology()->vertex_count()) {
        throw Error(ErrorCode::out_of_range, "vertex " + std::to_string(v) + " does not exist",
                    Elements{ElementKind::vertex, 1, {v}});
    }
    with_memory_errors([&] {
        constrain(PointConstraint{vertex_point(v), constraint.position, constraint.gradient,
                                  constraint.weight});
    });
}

// Where only the asked values change, so do the poses alone, and the preparation serves on.
void Deformer::constrain(const PointConstraint& given) {
    State& s = *state_;
    with_memory_errors([&] {
        Target target = checked_target(*s.rest, *s.holds, given);
        const TargetPose pose{given.position.value_or(Vec3(Vec3::Zero())),
                              given.gradient.value_or(Mat3(Mat3::Identity()))};
        const TargetPlace place = find_target(*s.holds, target);
        if (!place.found && !target.position && !target.gradient) return;
        if (place.found) {
            const Target& old = *s.holds->targets[place.at];
            if (old.position == target.position && old.gradient == target.gradient &&
                old.weight == target.weight) {
                s.poses.targets[place.at] = pose;
                return;
            }
        }
        s.edit([&](HoldEdit& edit) { edit.set_target(std::move(target), pose); });
    });
}

// ---- Where it goes

const Affine& Deformer::transform(HandleId id) const {
    return state_->pose(id).transform;
}
Vec3 Deformer::turn(HandleId id) const {
    return state_->pose(id).turn;
}

void Deformer::set_transform(HandleId id, const Affine& transform) {
    set_transform(id, transform, Vec3::Zero());
}

void Deformer::set_transform(HandleId id, const Affine& transform, const Vec3& about) {
    set_transform(id, transform, about, turn(id));
}

void Deformer::set_transform(HandleId id, const Affine& transform, const Vec3& about,
                             const Vec3& turn) {
    State& s = *state_;
    pose_handle(*s.rest, *s.holds, s.poses, id, transform, about, turn);
}

Affine Deformer::transform_about(HandleId id, const Vec3& about) const {
    const Affine& map = state_->pose(id).local_transform;
    const Vec3 arm = about - state_->rest->origin();
    return {map.linear, map.translation + (map.linear - Mat3::Identity()) * arm};
}

std::shared_ptr<const HandlePoses> Deformer::poses() const {
    return with_memory_errors([&] {
        return std::make_shared<const HandlePoses>(
            HandlePoses{state_->poses.handles, state_->rest->origin()});
    });
}

void Deformer::restore(const HandlePoses& poses) {
    State& s = *state_;
    const bool same_origin = poses.origin == s.rest->origin();
    const std::size_t count = std::min(poses.handles.size(), s.poses.handles.size());
    for (std::size_t h = 0; h < count; ++h) {
        if (!s.holds->handles[h]) continue;
        const HandlePose& old = poses.handles[h];
        s.poses.handles[h] = old;
        if (same_origin) continue;
        s.poses.handles[h] = placed(*s.rest, old.transform, Vec3::Zero());
        s.poses.handles[h].turn = old.turn;
    }
}

DeformSetup Deformer::setup() const {
    return with_memory_errors([&] {
        return DeformSetup{state_->rest, state_->holds, state_->poses};
    });
}

void Deformer::restore(const DeformSetup& setup) {
    State& s = *state_;
    if (!setup.rest || setup.rest->scope != s.rest->scope) {
        throw Error(ErrorCode::invalid_argument, "the setup belongs to another deformation");
    }
    with_memory_errors([&] {
        Poses poses = setup.poses;
        s.rest = setup.rest;
        s.holds = setup.holds;
        s.poses = std::move(poses);
    });
}

}  // namespace lissom
