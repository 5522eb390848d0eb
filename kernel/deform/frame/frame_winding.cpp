// Rotations of handles beyond half a turn. The first system cannot tell a turn by t from one by t
// minus a full turn; the prescribed turn is propagated instead, and only the handles' translations
// follow the first system. frame_rotations.cpp leads there.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/turn_loops.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"
#include "kernel/solve/dual/least_norm.h"

namespace lissom {
namespace {

// Between these angles the field of turns takes over from that of the first system.
constexpr double kFirstAngle = 120.0 * kPi / 180.0;
constexpr double kLastAngle = 240.0 * kPi / 180.0;

// The mean of `value` at local vertices, by weights from zero upwards with sum one. They are those
// of translations in the second system, which change evenly along a part that is twisted, and in
// the first for handles that the second knows nothing of.
class MeanOfTurns {
  public:
    // `room` has the turns of handles, and memory.
    MeanOfTurns(const FrameInput& motion, const HandleResponses& answers, WindingRoom& room)
        : answers_(answers), value_(room.turns), silent_(room.silent) {
        silent_.clear();
        const auto answers_to = [](const auto& response) { return !response.answer.empty(); };
        if (!std::all_of(answers.of_handles.begin(), answers.of_handles.end(), answers_to)) {
            add_silent(motion);
        }
    }

    Vec4 at(Index v) const {
        TurnSum sum = silent_.empty() ? TurnSum{} : silent_[v];
        for (std::size_t n = 0; n < value_.size(); ++n) {
            if (!answers_.of_handles[n].answer.empty())
                sum.add(answers_.of_handles[n].answer[v], value_[n]);
        }
        const double total = sum.total + std::clamp(sum.remainder, 0.0, 1.0);
        return total > 0.0 ? Vec4(sum.field / total) : sum.field;
    }

  private:
    // Those of handles that the second system does not answer to.
    void add_silent(const FrameInput& motion) {
        const Preparation& prepared = motion.prepared();
        const LinearSolution& solution = motion.solution();
        const std::vector<Index>& free = motion.method().first->free_vertices();
        silent_.resize(motion.patch().vertex_count);
        for (std::size_t n = 0; n < value_.size(); ++n) {
            if (!answers_.of_handles[n].answer.empty()) continue;
            const Index h = solution.handles()[n];
            for (const Index v : prepared.held[h]) silent_[v].add(1.0, value_[n]);
            const std::vector<Vec4>& weight = solution.row_weights(n);
            for (std::size_t row = 0; row < free.size(); ++row) {
                if (prepared.owner[free[row]] == h) continue;
                silent_[free[row]].add(weight[row][3], value_[n]);
            }
        }
    }

    const HandleResponses& answers_;
    const std::vector<Vec4>& value_;
    std::vector<TurnSum>& silent_;
};

// Handles that the second system could move as a whole: all that hold positions, but the base.
std::vector<Index> movable_handles(const Preparation& prepared) {
    std::vector<Index> movable;
    for (const Index h : prepared.implicit()->solution->handles()) {
        const Handle& handle = *prepared.constraints->handles[h];
        if (handle.options.position && !handle.soft() && !handle.local.empty()) {
            movable.push_back(h);
        }
    }
    return movable;
}

std::vector<std::span<const Index>> groups_of(const Preparation& prepared,
                                              const std::vector<Index>& handles) {
    std::vector<std::span<const Index>> groups;
    for (const Index h : handles) groups.push_back(prepared.held[at(h)]);
    return groups;
}

// Moves each movable handle by one unit in the second system alone.
HandleResponses find_answers(const Preparation& prepared, RotationSystem::Scratch& scratch,
                             const Context& context) {
    const RotationSystem& second = *prepared.implicit()->second;
    const std::vector<Index>& all = prepared.implicit()->solution->handles();
    const std::vector<Index> movable = movable_handles(prepared);
    const std::vector<std::span<const Index>> groups = groups_of(prepared, movable);
    const auto count = count_of(movable);
    HandleResponses answers{std::vector<RotationSystem::Response>(all.size()),
                            Eigen::MatrixXd(count, count), movable};
    for (Index first = 0; first < count; first += 3) {
        const Index last = std::min(count, first + 3);
        std::vector<Vec4> x(prepared.patch().vertex_count, Vec4::Zero());
        for (Index k = first; k < last; ++k) {
            for (const Index v : prepared.held[movable[k]]) x[v][k - first] = 1.0;
        }
        second.solve({}, x, false, scratch, context);
        std::vector<RotationSystem::Response> responses =
            second.responses(x, last - first, scratch, context);
        for (Index k = first; k < last; ++k) {
            const auto n = std::find(all.begin(), all.end(), movable[k]) - all.begin();
            answers.of_handles[n] = std::move(responses[k - first]);
        }
        const std::vector<Vec3> forces = second.forces(nullptr, x, groups, scratch, context);
        for (Index j = 0; j < count; ++j) {
            for (Index k = first; k < last; ++k)
                answers.stiffness(j, k) = -forces[at(j)][k - first];
        }
    }
    return answers;
}

// Forces on movable handles in the solution of the second system.
void find_forces(const SecondInput& input, const HandleResponses& answers,
                 FrameScratch::State& scratch, const Context& context) {
    const Preparation& prepared = input.motion.prepared();
    const RotationSystem& second = *input.motion.method().second;
    const std::vector<Index>& all = input.motion.solution().handles();
    const Rotations& rotations = scratch.rotations;
    std::vector<Vec3>& forces = scratch.winding.forces;
    forces.clear();
    if (second.has_ties()) {
        Deviation& x = scratch.winding.tied;
        x = scratch.deviation;
        second.solve(rotations, x, input.draft, scratch.second, context);
        for (const Index h : answers.movable) {
            forces.push_back(
                second.force(rotations.data(), x, prepared.held[h], scratch.second, context));
        }
        return;
    }
    for (const Index h : answers.movable) {
        const auto n = std::find(all.begin(), all.end(), h) - all.begin();
        forces.push_back(second.solved_force(rotations.data(), scratch.deviation,
                                             answers.of_handles[n], scratch.second, context));
    }
}

// Distance of each handle of the solution from its place under the present turns alone.
void find_mismatches(const SecondInput& input, const HandleResponses& answers,
                     FrameScratch::State& scratch, const Context& context) {
    std::vector<Vec3>& shifts = scratch.winding.forces;
    find_forces(input, answers, scratch, context);
    if (!shifts.empty()) solve_least_norm(answers.stiffness, shifts);
    const std::vector<Index>& movable = answers.movable;
    std::vector<Vec4>& result = scratch.winding.mismatch.of_handles;
    result.clear();
    for (const Index h : input.motion.solution().handles()) {
        const auto found = std::find(movable.begin(), movable.end(), h);
        const Vec3 shift = found == movable.end() ? Vec3(Vec3::Zero())
                                                  : shifts[at(index_of(found - movable.begin()))];
        result.push_back(padded(Vec3(-shift)));
    }
}

// Makes `rotations` the means of the handles' turns.
void take_mean_turns(const SecondInput& input, const HandleResponses& answers,
                     const Context& context, WindingRoom& room, Rotations& rotations) {
    const FrameInput& motion = input.motion;
    const bool scales = motion.scales();
    const Mat3 base_linear = motion.base_linear();
    const double base_scale = scales ? uniform_scale(base_linear) : 1.0;
    Vec4 base;
    nearest_quaternions({&base_linear, 1}, {&base, 1});
    motion.find_relative_turns(room.turns);
    const MeanOfTurns mean(motion, answers, room);
    for (const std::vector<Index>* vertices :
         {&motion.method().gathered, &motion.method().averaged}) {
        for_each_block(context, count_of(*vertices), [&](Index begin, Index end) {
            std::array<Vec4, kFrameBlock> turn;
            std::array<Mat3, kFrameBlock> s;
            const std::size_t count = end - begin;
            for (Index i = begin; i < end; ++i) turn[i - begin] = mean.at((*vertices)[i]);
            rotations_of_turns({turn.data(), count}, base, {s.data(), count});
            for (Index i = begin; i < end; ++i) {
                const double scale = scales ? base_scale * std::exp(turn[i - begin][3]) : 1.0;
                rotations[(*vertices)[i]].topRows<3>() = scale * s[i - begin] - input.base_rotation;
            }
        });
    }
}

// S_i of a block of vertices, as rotations and scales, nearest to gradients.
class NearestBlock {
  public:
    NearestBlock(const FrameInput& motion, std::span<const Mat3> gradient) {
        if (motion.scales()) {
            std::transform(gradient.begin(), gradient.end(), scale_.begin(), uniform_scale);
        } else {
            std::fill_n(scale_.begin(), gradient.size(), 1.0);
        }
        nearest_quaternions(gradient, {rotation_.data(), gradient.size()});
    }

    // At `share` of the way from `first` to these.
    void blend(const NearestBlock& first, double share, std::span<Mat3> s) const {
        const std::size_t count = s.size();
        blend_rotations({first.rotation_.data(), count}, {rotation_.data(), count}, share, s);
        for (std::size_t i = 0; i < count; ++i) {
            s[i] *= (1.0 - share) * first.scale_[i] + share * scale_[i];
        }
    }

  private:
    std::array<Vec4, kFrameBlock> rotation_;
    std::array<double, kFrameBlock> scale_;
};

// The same of one vertex.
Mat3 blended(const FrameInput& motion, const Mat3& first, const Mat3& now, double share) {
    if (!motion.scales()) return rotation_between(first, now, share);
    const double scale = (1.0 - share) * uniform_scale(first) + share * uniform_scale(now);
    return scale * rotation_between(nearest_rotation(first), nearest_rotation(now), share);
}

// Adds S_i of `rotations` to gradients of the bending field.
void bend(const SecondInput& input, std::span<const Index> vertices, const Rotations& rotations,
          std::span<Mat3> gradient) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        gradient[i] += input.base_rotation + rotations[vertices[i]].topRows<3>();
    }
}

void take_nearest(const FrameInput& motion, std::span<Mat3> s) {
    std::array<double, kFrameBlock> scale;
    const bool scales = motion.scales();
    for (std::size_t i = 0; i < s.size(); ++i) scale[i] = scales ? uniform_scale(s[i]) : 1.0;
    nearest_rotations(s, s);
    for (std::size_t i = 0; i < s.size(); ++i) s[i] *= scale[i];
}

}  // namespace

void TurnSum::add(double raw, const Vec4& of) {
    const double weight = std::clamp(raw, 0.0, 1.0);
    field += weight * of;
    total += weight;
    remainder -= raw;
}

double share_of_turns(double max_turn) {
    return smooth_step((max_turn - kFirstAngle) / (kLastAngle - kFirstAngle));
}

// Each vertex turns by the mean of the handles' rotation vectors; the second system gives the
// places of the handles then, and their mismatch bends the surface as pure translations do.
void wind_rotations(const SecondInput& input, FrameScratch::State& scratch,
                    const Context& context) {
    const double share = share_of_turns(input.max_turn);
    const FrameInput& motion = input.motion;
    const ImplicitMethod& method = motion.method();
    const Deviation& deviation = scratch.deviation;
    Rotations& rotations = scratch.rotations;
    const HandleResponses& answers = method.answers.get(
        [&] { return find_answers(motion.prepared(), scratch.second, context); });
    turn_held(input, rotations);
    take_mean_turns(input, answers, context, scratch.winding, rotations);
    find_mismatches(input, answers, scratch, context);
    const SpreadMoves moves(motion, scratch.winding.mismatch, context);
    // Beyond a right angle, and so here, the first system is never asked for all of the turns.
    const std::optional<TurnPart> part =
        share < 1.0 ? part_of_turns(motion, input.max_turn, scratch.part, context) : std::nullopt;

    const std::vector<Index>& vertices = method.gathered;
    for_each_block(context, count_of(vertices), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> now, first;
        const std::size_t count = end - begin;
        const std::span<Mat3> s(now.data(), count);
        moves.gather(vertices.data(), now.data(), begin, end);
        bend(input, {vertices.data() + begin, count}, rotations, s);
        if (part) {
            first_gradients(motion, &*part, deviation, first.data(), begin, end);
            NearestBlock(motion, s).blend(NearestBlock(motion, {first.data(), count}), share, s);
        } else {
            take_nearest(motion, s);
        }
        for (Index i = begin; i < end; ++i) {
            rotations[vertices[i]].topRows<3>() = now[i - begin] - input.base_rotation;
        }
    });
    if (!part) return;
    for (const Index v : method.averaged) {
        const Mat3 first = rotation_of(motion, gradient_of(motion, deviation, v, &*part));
        const Mat3 now = input.base_rotation + rotations[v].topRows<3>();
        rotations[v].topRows<3>() = blended(motion, first, now, share) - input.base_rotation;
    }
}

}  // namespace lissom
