// One frame: from a preparation and poses to positions.
#include <algorithm>
#include <array>
#include <utility>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// Solves the second system with the taken stretch added to rotations, which stay as they are.
void solve_stretched(const SecondInput& input, FrameScratch::State& scratch,
                     const Context& context) {
    const std::vector<TakenStretch>& taken = scratch.taken;
    Rotations& before = scratch.untaken;
    before.clear();
    for (const auto& [v, stretch] : taken) {
        PaddedMat3& s = scratch.rotations[at(v)];
        before.push_back(s);
        s = padded_columns((input.base_rotation + s.topRows<3>()) * stretch - input.base_rotation);
    }
    input.motion.method().second->solve(scratch.rotations, scratch.deviation, input.draft,
                                        scratch.second, context);
    keep_volume(input, scratch, context);
    // A vertex may have taken twice.
    for (std::size_t n = taken.size(); n-- > 0;) scratch.rotations[at(taken[n].vertex)] = before[n];
}

// Drafts are not limited: a search for crossings takes longer than a frame.
void refine_result(const SecondInput& input, FrameScratch::State& scratch, const Context& context) {
    if (!input.draft) scratch.refine.plain = scratch.deviation;
    const int steps = input.motion.options().refine;
    for (int step = 1; step <= steps; ++step) {
        const double further = over_relaxation(input.max_turn, step == steps);
        refine_rotations(input, scratch.deviation, further, scratch.refine, context,
                         scratch.rotations);
        solve_stretched(input, scratch, context);
    }
    if (!input.draft) limit_refinement(input, scratch, context);
}

// Solves for deviations from the similarity nearest to the base transform, so that similarities of
// the whole are exact. `deviation` is that of the first system, and then of the second.
void solve_second(const SecondInput& input, FrameScratch::State& scratch, const Context& context) {
    const FrameInput& motion = input.motion;
    const Patch& patch = motion.patch();
    Deviation& deviation = scratch.deviation;
    find_taken_stretches(motion, deviation, scratch.taken);
    const bool winds = share_of_turns(input.max_turn) > 0.0;
    if (!winds) find_rotations(input, deviation, scratch.part, context, scratch.rotations);
    const Mat3 remainder = motion.base_linear() - input.base_rotation;
    if (!remainder.isZero(0.0)) {
        for_each_block(context, patch.vertex_count, [&](Index begin, Index end) {
            for (Index v = begin; v < end; ++v) {
                deviation[v].head<3>() += remainder * patch.rest[v];
            }
        });
    }
    if (winds) wind_rotations(input, scratch, context);
    solve_stretched(input, scratch, context);
    if (motion.options().refine > 0) refine_result(input, scratch, context);
}

// Whether the full frame takes the same steps up to the last corrections. Refinements, ties and
// springs start from all of them.
bool may_be_finished(const FrameInput& motion) {
    return motion.options().refine == 0 && volume_share(motion) == 0.0 &&
           !motion.method().second->has_ties();
}

// Positions of the free vertices from the second system.
void place_free(const SecondInput& input, std::span<const Vec4> deviation, const Context& context,
                std::vector<Vec3>& positions) {
    const FrameInput& motion = input.motion;
    const Patch& patch = motion.patch();
    const RestShape& rest = *motion.prepared().rest;
    const Vec3 shift = motion.base().topRightCorner<3, 1>();
    const std::vector<Index>& free = motion.method().second->free_vertices();
    for_each_block(context, count_of(free), [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            const Index v = free[row];
            const Vec3 at = input.base_rotation * patch.rest[v] + shift + deviation[v].head<3>();
            positions[rest.frame_row(patch, v)] = at + patch.origin;
        }
    });
}

// Positions of a frame, for the region and then for the vertices that a refinement inserted.
std::vector<Vec3> take_positions(FrameScratch::State& scratch, const Preparation& prepared) {
    std::vector<Vec3> positions = std::exchange(scratch.positions, {});
    positions.resize(prepared.rest->positions.size() + prepared.patch().inserted.size());
    return positions;
}

const Preparation& required(const std::shared_ptr<const Preparation>& preparation,
                            const Poses& poses) {
    require(preparation != nullptr,
            "there is no preparation; make one by Deformer::prepare or prepare_deformation");
    require_poses(*preparation->constraints, poses);
    return *preparation;
}

// Poses are assigned, which takes no memory once there is some.
void remember_draft(DraftMemo& draft, const std::shared_ptr<const Preparation>& preparation,
                    const Poses& poses) {
    draft.preparation = preparation;
    draft.poses = poses;
    draft.is_there = true;
}

// The memory of `motion` goes back to the scratch.
DeformFrame finished(const std::shared_ptr<const Preparation>& preparation, FrameInput& motion,
                     FrameScratch::State& scratch, std::vector<Vec3> positions) {
    DeformFrame frame = framed(preparation, motion, scratch, std::move(positions));
    scratch.differences = motion.take_room();
    return frame;
}

DeformFrame resting(const Preparation& prepared, const Poses& poses) {
    DeformFrame frame = rest_frame(*prepared.rest);
    frame.poses = poses;
    return frame;
}

}  // namespace

FrameScratch::FrameScratch() : state_(std::make_unique<State>()) {}
FrameScratch::~FrameScratch() = default;
FrameScratch::FrameScratch(FrameScratch&&) noexcept = default;
FrameScratch& FrameScratch::operator=(FrameScratch&&) noexcept = default;

void FrameScratch::recycle(DeformFrame&& frame) {
    state_->positions = std::move(frame.positions);
    state_->poses = std::move(frame.poses);
}

DeformFrame preview_frame(const std::shared_ptr<const Preparation>& preparation, const Poses& poses,
                          FrameScratch& scratch, const Context& context) {
    const Preparation& prepared = required(preparation, poses);
    if (at_rest(*prepared.rest, *prepared.constraints, poses)) return resting(prepared, poses);
    if (prepared.levels()) {
        return solve_levels(preparation, poses, scratch.state(), FrameQuality::preview, context);
    }
    if (!prepared.implicit()) return solve_compared(preparation, poses, scratch.state(), context);
    const TargetRhs& asked = target_rhs(preparation, poses.targets, scratch.state().asked);
    FrameInput motion(prepared, poses, asked, std::exchange(scratch.state().differences, {}));
    std::vector<Vec3> positions = take_positions(scratch.state(), prepared);
    if (const LinearSolution* solution = motion.method().solution.get()) {
        const LinearSolution::Places places{motion.base() - matrix_of({}), prepared.patch().origin,
                                            motion.method().frame_row, positions};
        solution->find_weights(motion.differences(), context);
        for_each_block(context, solution->rows(), [&](Index begin, Index end) {
            solution->place(motion.differences(), asked.fixed, places, begin, end);
        });
    }
    return finished(preparation, motion, scratch.state(), std::move(positions));
}

DeformFrame solve_frame(const std::shared_ptr<const Preparation>& preparation, const Poses& poses,
                        FrameScratch& given, FrameQuality quality, const Context& context) {
    const Preparation& prepared = required(preparation, poses);
    if (quality == FrameQuality::preview) return preview_frame(preparation, poses, given, context);
    FrameScratch::State& scratch = given.state();
    if (at_rest(*prepared.rest, *prepared.constraints, poses)) return resting(prepared, poses);
    if (prepared.levels()) return solve_levels(preparation, poses, scratch, quality, context);
    if (!prepared.implicit()) return solve_compared(preparation, poses, scratch, context);
    const TargetRhs& asked = target_rhs(preparation, poses.targets, scratch.asked);
    FrameInput motion(prepared, poses, asked, std::exchange(scratch.differences, {}));
    std::vector<Vec3> positions = take_positions(scratch, prepared);
    const bool is_drafted = scratch.draft.is_of(preparation, poses);
    scratch.draft.is_there = false;
    const bool draft = quality == FrameQuality::draft;
    const RotationSystem& second = *motion.method().second;
    if (second.free_vertices().empty()) {
        solve_first(motion, context, scratch.deviation);
        return finished(preparation, motion, scratch, std::move(positions));
    }
    const SecondInput input{motion, rotation_of(motion, motion.base_linear()),
                            motion.max_turn(scratch.turns), draft};
    if (!draft && is_drafted) {
        second.finish_draft(scratch.deviation, scratch.second, context);
    } else {
        solve_first(motion, context, scratch.deviation);
        if (scratch.sized_for.lock() != preparation) {
            scratch.rotations.assign(prepared.patch().real_count, PaddedMat3::Zero());
            scratch.sized_for = preparation;
        }
        if (scratch.volume.springs_of.lock() != preparation) {
            scratch.volume.springs.factored_for = 0.0;
            scratch.volume.springs_of = preparation;
        }
        solve_second(input, scratch, context);
    }
    place_free(input, scratch.deviation, context, positions);
    if (draft && may_be_finished(motion)) remember_draft(scratch.draft, preparation, poses);
    return finished(preparation, motion, scratch, std::move(positions));
}

}  // namespace lissom
