// Handles and constraints of a Deformer, their poses, and its snapshots.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/mirror_residual.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {

std::vector<HandleId> Deformer::handles() const {
    std::vector<HandleId> ids;
    for (std::size_t h = 0; h < state_->constraints->handles.size(); ++h) {
        if (state_->constraints->handles[h]) ids.push_back({index_of(h)});
    }
    return ids;
}

HandleInfo Deformer::handle(HandleId id) const {
    const Handle& handle = state_->handle(id);
    HandleInfo info{handle.region, handle.options, handle.center, std::nullopt};
    if (handle.partner != kNoIndex) info.image = HandleId{handle.partner};
    return info;
}

MirrorResidual mirror_residual_of(const Deformer& deformer, HandleId id) {
    const auto& s = DeformerAccess::state(deformer);
    const Handle& handle = s.handle(id);
    require(handle.partner != kNoIndex, "the handle has no mirror image");
    return with_memory_errors([&] { return residual_of(*s.rest, handle); });
}

// ---- Handles and constraints

HandleId Deformer::add_handle(const Region& vertices, const HandleOptions& options) {
    return with_memory_errors([&] {
        return state_->edit(
            [&](ConstraintEdit& edit) { return edit.add_handle(vertices, options); });
    });
}

HandleId Deformer::add_handle(std::span<const MeshPoint> points, const HandleOptions& options) {
    return with_memory_errors([&] {
        return state_->edit([&](ConstraintEdit& edit) { return edit.add_handle(points, options); });
    });
}

void Deformer::remove_handle(HandleId id) {
    with_memory_errors(
        [&] { state_->edit([&](ConstraintEdit& edit) { edit.remove_handle(id); }); });
}

HandleId mirror_handle(Deformer& deformer, HandleId id, const MirrorPlane& plane) {
    auto& s = DeformerAccess::state(deformer);
    return with_memory_errors([&] {
        return s.edit([&](ConstraintEdit& edit) { return edit.mirror_handle(id, plane); });
    });
}

void set_handle_region(Deformer& deformer, HandleId id, const Region& vertices) {
    auto& s = DeformerAccess::state(deformer);
    with_memory_errors(
        [&] { s.edit([&](ConstraintEdit& edit) { edit.set_handle_region(id, vertices); }); });
}

void set_stiffness(Deformer& deformer, const Region& vertices, double factor) {
    auto& s = DeformerAccess::state(deformer);
    with_memory_errors(
        [&] { s.edit([&](ConstraintEdit& edit) { edit.set_stiffness(vertices, factor); }); });
}

void keep_volume(Deformer& deformer, double share) {
    auto& s = DeformerAccess::state(deformer);
    if (!(share >= 0.0 && share <= 1.0)) {
        throw Error(ErrorCode::invalid_argument, "the share of the volume must be from 0 to 1");
    }
    if (share > 0.0) require_implicit(s.options(), "keeping the volume");
    s.poses.volume = share;
}

double kept_volume(const Deformer& deformer) {
    const auto& s = DeformerAccess::state(deformer);
    return s.poses.volume.value_or(s.options().volume);
}

// New values change the poses alone, and the preparation serves on.
void Deformer::constrain(const PointConstraint& given) {
    State& s = *state_;
    with_memory_errors([&] {
        Target target = checked_target(*s.rest, *s.constraints, given);
        const TargetPose pose{given.position.value_or(Vec3(Vec3::Zero())),
                              given.gradient.value_or(Mat3(Mat3::Identity()))};
        const TargetPlace place = find_target(*s.constraints, target);
        if (!place.found && !target.position && !target.gradient) return;
        if (place.found) {
            const Target& old = *s.constraints->targets[place.at];
            if (old.position == target.position && old.gradient == target.gradient &&
                old.weight == target.weight) {
                s.poses.targets[place.at] = pose;
                return;
            }
        }
        s.edit([&](ConstraintEdit& edit) { edit.set_target(std::move(target), pose); });
    });
}

VertexConstraint::operator PointConstraint() const {
    return with_memory_errors([&] {
        return PointConstraint{vertex_point(vertex), position, gradient, weight};
    });
}

// ---- Poses

const HandlePose& Deformer::pose(HandleId id) const {
    return state_->pose(id);
}

void Deformer::set_transform(HandleId id, const Affine& transform, const Vec3& about,
                             const std::optional<Vec3>& turn) {
    State& s = *state_;
    pose_handle(*s.rest, *s.constraints, s.poses, id, transform, about,
                turn.value_or(s.pose(id).turn));
}

void Deformer::rotate(HandleId id, const Vec3& axis, double angle) {
    const double length = axis.norm();
    if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(angle)) {
        throw Error(ErrorCode::invalid_argument,
                    "a handle turns about an axis with a length, by a finite angle");
    }
    const Vec3 center = handle(id).center, by = angle / length * axis;
    const Affine now = transform_about(*this, id, center);
    const Affine turned_on = rotation(axis / length, angle, now.translation) * now;
    set_transform(id, turned_on, center, turned(pose(id).turn, by));
}

void Deformer::translate(HandleId id, const Vec3& offset) {
    if (!offset.allFinite()) {
        throw Error(ErrorCode::not_finite, "the offset of a handle must be finite");
    }
    const Vec3 center = handle(id).center;
    set_transform(id, translation(offset) * transform_about(*this, id, center), center);
}

Affine transform_about(const Deformer& deformer, HandleId id, const Vec3& about) {
    const auto& s = DeformerAccess::state(deformer);
    const Affine& map = s.pose(id).local_transform;
    const Vec3 arm = about - s.rest->origin();
    return {map.linear, map.translation + (map.linear - Mat3::Identity()) * arm};
}

// ---- Snapshots

DeformSnapshot Deformer::snapshot() {
    State& s = *state_;
    return with_memory_errors([&] {
        DeformSnapshot snapshot{s.rest, s.constraints, s.poses, s.complete()};
        s.own = nullptr;
        return snapshot;
    });
}

void Deformer::restore(const DeformSnapshot& snapshot) {
    State& s = *state_;
    if (!snapshot.rest || snapshot.rest->scope != s.rest->scope) {
        throw Error(ErrorCode::invalid_argument, "the snapshot belongs to another deformation");
    }
    require(snapshot.constraints && snapshot.shown, "the snapshot is empty");
    require_frame(*snapshot.rest, *snapshot.shown);
    with_memory_errors([&] {
        Poses poses = snapshot.poses;
        // Others see no change of theirs: gradients are found later in a copy.
        if (!snapshot.shown->gradients) {
            s.show(*snapshot.shown);
        } else {
            s.own = nullptr;
            s.shown = snapshot.shown;
        }
        s.rest = snapshot.rest;
        s.constraints = snapshot.constraints;
        s.poses = std::move(poses);
    });
}

}  // namespace lissom
