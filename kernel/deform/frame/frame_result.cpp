// Results of a frame: positions, exact to the bit at constraints, and gradients.
#include <algorithm>
#include <utility>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

// Positions of the vertices of a handle: transform(p), to the bit, unless the patch has a more
// exact one. Calls put(row, position) for each of `vertices`.
template <typename Put>
void for_each_held(const RestShape& rest, const HandlePose& pose, std::span<const Index> vertices,
                   const Put& put) {
    const Affine& transform = pose.transform;
    const auto place = [&](const auto& where) {
        for (const Index v : vertices) put(v, where(v));
    };
    const auto before = [&](Index v) -> const Vec3& { return rest.positions[rest.region_row[v]]; };
    if (transform.is_identity()) {
        place(before);
    } else if (!rest.far_away || transform.linear == Mat3::Identity()) {
        place([&](Index v) -> Vec3 { return transform(before(v)); });
    } else {
        place([&](Index v) -> Vec3 {
            return rest.origin() + pose.local_transform(rest.patch().rest[v]);
        });
    }
}

// Held vertices lie at their prescribed positions, to the bit; unconstrained vertices without faces
// are at rest.
void place_held(const Preparation& prepared, const Poses& poses, std::vector<Vec3>& positions) {
    const RestShape& rest = *prepared.rest;
    const ConstraintSet& constraints = *prepared.constraints;
    for (const Index row : prepared.resting_rows) positions[row] = rest.positions[row];
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        if (!constraints.handles[h]) continue;
        for_each_held(rest, poses.handles[h], constraints.handles[h]->local,
                      [&](Index v, const Vec3& at) {
                          if (prepared.known.position[v]) positions[rest.region_row[v]] = at;
                      });
    }
    for (std::size_t t = 0; t < constraints.targets.size(); ++t) {
        const Target& target = *constraints.targets[t];
        if (!target.is_hard_vertex()) continue;
        const Index v = target.row.front().first, row = rest.region_row[v];
        if (target.position) {
            positions[row] = poses.targets[t].position;
        } else if (prepared.known.position[v]) {
            positions[row] = rest.positions[row];
        }
    }
}

// How the vertices that RestDirections::without_faces names have turned: with their handle.
std::vector<Mat3> turns_without_faces(const Preparation& prepared, const Poses& poses) {
    const RestShape& rest = *prepared.rest;
    std::vector<Mat3> result;
    for (const Index row : rest.directions.without_faces()) {
        const Index v = rest.patch().of_region[row];
        result.push_back(Mat3::Identity());
        for (std::size_t h = 0; h < prepared.constraints->handles.size(); ++h) {
            const Handle* handle = prepared.constraints->handles[h].get();
            const Affine& moved = poses.handles[h].local_transform;
            if (!handle || !handle->options.gradient || moved.is_identity()) continue;
            const std::vector<Index>& held = handle->local;
            if (std::find(held.begin(), held.end(), v) == held.end()) continue;
            result.back() = nearest_rotation(moved.linear);
        }
    }
    return result;
}

}  // namespace

DeformFrame framed(const std::shared_ptr<const Preparation>& preparation, const FrameInput& motion,
                   FrameScratch::State& scratch, std::vector<Vec3> positions) {
    const Preparation& prepared = *preparation;
    Poses poses = std::exchange(scratch.poses, {});
    poses = motion.poses();
    const Patch& patch = prepared.patch();
    place_held(prepared, poses, positions);
    const auto own = std::ssize(prepared.rest->positions);
    for (Index v = patch.mesh_count(); v < patch.real_count; ++v) {
        if (!prepared.known.position[v]) continue;
        positions[at(prepared.rest->frame_row(patch, v))] = motion.known_position(v) + patch.origin;
    }
    place_followers(prepared, poses, positions);
    DeformFrame frame{preparation, std::move(poses), {}, {}, prepared.work, {}, {}};
    frame.inserted.assign(positions.begin() + own, positions.end());
    positions.resize(own);
    frame.positions = std::move(positions);
    frame.turns_without_faces = turns_without_faces(prepared, frame.poses);
    return frame;
}

const TargetRhs& target_rhs(const std::shared_ptr<const Preparation>& preparation,
                            const std::vector<TargetPose>& targets, TargetMemo& memo) {
    if (memo.preparation.lock() != preparation || memo.targets != targets) {
        TargetMemo next{preparation, targets, target_rhs(*preparation, targets)};
        memo = std::move(next);
    }
    return memo.part;
}

std::vector<Mat3> frame_gradients(const DeformFrame& frame, FrameScratch& given) {
    if (frame.gradients) return *frame.gradients;
    require(frame.preparation != nullptr, "the frame has neither gradients nor a preparation");
    require_poses(*frame.preparation->constraints, frame.poses);
    const Preparation& prepared = *frame.preparation;
    FrameScratch::State& scratch = given.state();
    if (prepared.levels()) return level_gradients(prepared, frame.poses, scratch);
    const FrameInput motion(prepared, frame.poses,
                            target_rhs(frame.preparation, frame.poses.targets, scratch.asked));
    scratch.draft.is_there = false;
    solve_first(motion, {}, scratch.deviation);
    std::vector<Mat3> gradients;
    for (const Index v : prepared.patch().of_region) {
        gradients.push_back(gradient_of(motion, scratch.deviation, v));
    }
    std::vector<Vec3> positions = frame.positions;
    positions.insert(positions.end(), frame.inserted.begin(), frame.inserted.end());
    turn_followers(prepared, frame.poses, positions, gradients);
    return gradients;
}

}  // namespace lissom
