// Rotations of handles beyond half a turn. The first system cannot tell a turn by t from one by t
// minus a full turn; what was asked for is propagated instead, and only what the handles'
// translations add is taken as the first system would. frame_rotations.cpp leads there.
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/deform/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// Between these angles the field of turns takes over from that of the first system.
constexpr double kFirstAngle = 120.0 * kPi / 180.0;
constexpr double kLastAngle = 240.0 * kPi / 180.0;

// The mean of `value` at every local vertex, by weights from zero upwards with sum one. They are
// those of translations in the second system, which change evenly along a part that is twisted,
// and in the first for handles that the second knows nothing of.
std::vector<Vec4> mean_of_turns(const Motion& motion, const TurnAnswers& answers,
                                const std::vector<Vec4>& value) {
    const Preparation& prepared = motion.prepared();
    const LinearSolution& solution = motion.solution();
    std::vector<Vec4> field(static_cast<std::size_t>(motion.patch().vertex_count), Vec4::Zero());
    std::vector<double> total(field.size(), 0.0), remainder(field.size(), 1.0);
    const auto add = [&](Index v, double raw, const Vec4& of) {
        const double weight = std::clamp(raw, 0.0, 1.0);
        field[v] += weight * of;
        total[v] += weight;
        remainder[v] -= raw;
    };
    const std::vector<Index>& free = motion.method().first->free_vertices();
    for (std::size_t n = 0; n < value.size(); ++n) {
        const std::vector<double>& weights = answers.weights[n];
        for (std::size_t v = 0; v < weights.size(); ++v) {
            add(static_cast<Index>(v), weights[v], value[n]);
        }
        if (!weights.empty()) continue;
        for (const Index v : prepared.held[solution.handles()[n]]) add(v, 1.0, value[n]);
        for (std::size_t row = 0; row < free.size(); ++row) {
            const double weight = solution.translation_weight(n, static_cast<Index>(row));
            if (prepared.owner[free[row]] != solution.handles()[n]) {
                add(free[row], weight, value[n]);
            }
        }
    }
    for (std::size_t v = 0; v < field.size(); ++v) {
        const double sum = total[v] + std::clamp(remainder[v], 0.0, 1.0);
        if (sum > 0.0) field[v] /= sum;
    }
    return field;
}

// Handles that the second system could move as a whole: all that hold positions, but the base.
std::vector<Index> movable_handles(const Preparation& prepared) {
    std::vector<Index> movable;
    for (const Index h : prepared.implicit()->solution->handles()) {
        const Handle& handle = *prepared.holds->handles[h];
        if (handle.options.position && !handle.soft() && !handle.local.empty()) {
            movable.push_back(h);
        }
    }
    return movable;
}

// Moves each movable handle by one unit in the second system alone.
TurnAnswers find_answers(const Preparation& prepared, RotationSystem::Scratch& scratch,
                         const Context& context) {
    const RotationSystem& second = *prepared.implicit()->second;
    const std::vector<Index>& all = prepared.implicit()->solution->handles();
    const std::vector<Index> movable = movable_handles(prepared);
    const auto count = static_cast<Index>(movable.size());
    TurnAnswers answers{std::vector<std::vector<double>>(all.size()),
                        Eigen::MatrixXd(count, count)};
    for (Index first = 0; first < count; first += 3) {
        const Index last = std::min(count, first + 3);
        std::vector<Vec4> x(static_cast<std::size_t>(prepared.patch().vertex_count), Vec4::Zero());
        for (Index k = first; k < last; ++k) {
            for (const Index v : prepared.held[movable[k]]) x[v][k - first] = 1.0;
        }
        second.solve({}, x, false, scratch, context);
        for (Index k = first; k < last; ++k) {
            const auto n = std::find(all.begin(), all.end(), movable[k]) - all.begin();
            for (const Vec4& row : x) {
                answers.weights[static_cast<std::size_t>(n)].push_back(row[k - first]);
            }
        }
        for (Index j = 0; j < count; ++j) {
            const Vec3 force =
                second.force(nullptr, x, prepared.held[movable[j]], scratch, context);
            for (Index k = first; k < last; ++k) answers.stiffness(j, k) = -force[k - first];
        }
    }
    return answers;
}

// How far each handle of the solution is from where the present turns alone would put it.
std::vector<Vec4> mismatches(const Motion& motion, const TurnAnswers& answers,
                             const Rotations& rotations, std::span<const Vec4> x,
                             RotationSystem::Scratch& scratch, const Context& context) {
    const Preparation& prepared = motion.prepared();
    const std::vector<Index> movable = movable_handles(prepared);
    const auto count = static_cast<Index>(movable.size());
    Eigen::MatrixXd forces(count, 3);
    for (Index j = 0; j < count; ++j) {
        forces.row(j) =
            motion.method()
                .second->force(rotations.data(), x, prepared.held[movable[j]], scratch, context)
                .transpose();
    }
    Eigen::MatrixXd natural(count, 3);
    if (count > 0) natural = answers.stiffness.completeOrthogonalDecomposition().solve(forces);
    std::vector<Vec4> result;
    for (const Index h : motion.solution().handles()) {
        const auto found = std::find(movable.begin(), movable.end(), h);
        const Vec3 shift = found == movable.end() ? Vec3(Vec3::Zero())
                                                  : Vec3(natural.row(found - movable.begin()));
        result.push_back(padded(Vec3(-shift)));
    }
    return result;
}

// Makes `rotations` the means of the handles' turns.
void take_mean_turns(const SecondInput& input, const TurnAnswers& answers, const Context& context,
                     Rotations& rotations) {
    const Motion& motion = input.motion;
    const bool scales = motion.scales();
    const Mat3 base = nearest_rotation(motion.base_linear());
    const double base_scale = scales ? uniform_scale(motion.base_linear()) : 1.0;
    const std::vector<Vec4> field = mean_of_turns(motion, answers, motion.relative_turns());
    for (const std::vector<Index>* vertices :
         {&motion.method().gathered, &motion.method().averaged}) {
        for_each_block(context, static_cast<Index>(vertices->size()), [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                const Index v = (*vertices)[static_cast<std::size_t>(i)];
                const double scale = scales ? base_scale * std::exp(field[v][3]) : 1.0;
                rotations[v].topRows<3>() =
                    scale * rotation_of_turn(field[v].head<3>()) * base - input.base_rotation;
            }
        });
    }
}

// Takes the rotations nearest to `rotations` with the given gradients added, which are overwritten.
void bend(const SecondInput& input, std::span<const Index> vertices, std::span<Mat3> gradient,
          Rotations& rotations) {
    const bool scales = input.motion.scales();
    std::array<double, kFrameBlock> scale;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        gradient[i] += input.base_rotation + rotations[vertices[i]].topRows<3>();
        scale[i] = scales ? uniform_scale(gradient[i]) : 1.0;
    }
    nearest_rotations(gradient, gradient);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        rotations[vertices[i]].topRows<3>() = scale[i] * gradient[i] - input.base_rotation;
    }
}

// Takes those from before by `share` of the way to `rotations`.
void blend(const SecondInput& input, std::span<const Index> vertices, const Rotations& before,
           double share, Rotations& rotations) {
    if (before.empty()) return;
    const bool scales = input.motion.scales();
    for (const Index v : vertices) {
        const Mat3 first = input.base_rotation + before[v].topRows<3>();
        const Mat3 now = input.base_rotation + rotations[v].topRows<3>();
        const double scale =
            scales ? (1.0 - share) * uniform_scale(first) + share * uniform_scale(now) : 1.0;
        const Mat3 mean =
            scales ? rotation_between(nearest_rotation(first), nearest_rotation(now), share)
                   : rotation_between(first, now, share);
        rotations[v].topRows<3>() = scale * mean - input.base_rotation;
    }
}

}  // namespace

// Each vertex turns by the mean of the handles' rotation vectors; the second system says where the
// handles would then lie by themselves, and what they are off by bends the surface as pure
// translations do.
void wind_rotations(const SecondInput& input, std::span<const Vec4> deviation,
                    RotationSystem::Scratch& scratch, const Context& context,
                    Rotations& rotations) {
    const double share =
        smooth_step((input.greatest_turn - kFirstAngle) / (kLastAngle - kFirstAngle));
    if (share <= 0.0) return;
    const Motion& motion = input.motion;
    const ImplicitMethod& method = motion.method();
    Rotations before;
    if (share < 1.0) before = rotations;
    const TurnAnswers& answers =
        method.answers.get([&] { return find_answers(motion.prepared(), scratch, context); });
    take_mean_turns(input, answers, context, rotations);
    Deviation x(deviation.begin(), deviation.end());
    method.second->solve(rotations, x, input.draft, scratch, context);
    std::vector<Vec4> y =
        motion.spread(mismatches(motion, answers, rotations, x, scratch, context));
    motion.add_asked_moves(y);

    const GradientLoop loop = motion.prepared().gradient_loop();
    const std::vector<Index>& vertices = method.gathered;
    for_each_block(context, static_cast<Index>(vertices.size()), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> m;
        const std::span<Mat3> block(m.data(), static_cast<std::size_t>(end - begin));
        loop.gather(vertices.data(), y.data(), m.data(), begin, end);
        bend(input, {vertices.data() + begin, block.size()}, block, rotations);
        blend(input, {vertices.data() + begin, block.size()}, before, share, rotations);
    });
    blend(input, method.averaged, before, share, rotations);
}

}  // namespace lissom
