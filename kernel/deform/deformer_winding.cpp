// Rotations of handles beyond half a turn. The first system cannot tell a turn by t from one by t
// minus a full turn; what was asked for is propagated instead, and only what the handles'
// translations add is taken as the first system would. deformer_fraction.cpp leads there.
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// Between these angles the field of turns takes over from that of the first system.
constexpr double kFirstAngle = 120.0 * kPi / 180.0;
constexpr double kLastAngle = 240.0 * kPi / 180.0;

// Between these angles a refinement stops going further than what fits best: sides of a part that
// is twisted more would cave in until they meet.
constexpr double kNearAngle = 178.0 * kPi / 180.0;
constexpr double kFarAngle = 270.0 * kPi / 180.0;

}  // namespace

// Turns and logarithms of scale of the solution's handles, relative to the base.
std::vector<Vec4> Deformer::State::relative_turns() const {
    const LinearSolution& solution = *prepared->solution;
    const bool based = solution.base() != kNoIndex;
    const Mat3 base = based ? handles[solution.base()].in_patch.linear : Mat3(Mat3::Identity());
    const Vec3 base_turn = based ? handles[solution.base()].turn : Vec3(Vec3::Zero());
    const Mat3 back = nearest_rotation(base).transpose();
    std::vector<Vec4> turns_of_handles;
    for (const Index h : solution.handles()) {
        const HandleState& handle = handles[h];
        Vec4 relative;
        const Mat3& linear = handle.in_patch.linear;
        relative.head<3>() = turn_near(nearest_rotation(linear) * back, handle.turn - base_turn);
        relative[3] = std::log(uniform_scale(linear) / uniform_scale(base));
        turns_of_handles.push_back(relative);
    }
    return turns_of_handles;
}

// The greatest turn between two handles. The thesis's literal formulation knows no turns.
double Deformer::State::greatest_turn() const {
    if (!prepared->solution || !options.scale_free) return 0.0;
    std::vector<Vec4> ends = relative_turns();
    ends.push_back(Vec4::Zero());
    double greatest = 0.0;
    for (const Vec4& a : ends) {
        for (const Vec4& b : ends) greatest = std::max(greatest, (a - b).head<3>().norm());
    }
    return greatest;
}

// How much of the field of turns a frame takes.
double Deformer::State::winding_share(double greatest) {
    return smooth_step((greatest - kFirstAngle) / (kLastAngle - kFirstAngle));
}

double Deformer::State::far_share(double greatest) {
    return smooth_step((greatest - kNearAngle) / (kFarAngle - kNearAngle));
}

// sum over h of w_h value_h at every local vertex, where w_h are the weights of translations in the
// first system.
std::vector<Vec4> Deformer::State::spread(const std::vector<Vec4>& value) const {
    const LinearSolution& solution = *prepared->solution;
    const std::vector<Index>& free = prepared->first->free_vertices();
    std::vector<Vec4> field(static_cast<std::size_t>(prepared->work->patch.vertex_count),
                            Vec4::Zero());
    for (std::size_t n = 0; n < value.size(); ++n) {
        for (const Index v : prepared->held[solution.handles()[n]]) {
            if (prepared->known.position[v]) field[v] = value[n];
        }
    }
    for (std::size_t row = 0; row < free.size(); ++row) {
        for (std::size_t n = 0; n < value.size(); ++n) {
            field[free[row]] += solution.translation_weight(n, static_cast<Index>(row)) * value[n];
        }
    }
    return field;
}

// The mean of `value` at every local vertex, by weights from zero upwards with sum one. They are
// those of translations in the second system, which change evenly along a part that is twisted,
// and in the first for handles that the second knows nothing of.
std::vector<Vec4> Deformer::State::mean_of_turns(const std::vector<Vec4>& value) const {
    const LinearSolution& solution = *prepared->solution;
    std::vector<Vec4> field(static_cast<std::size_t>(prepared->work->patch.vertex_count),
                            Vec4::Zero());
    std::vector<double> total(field.size(), 0.0), remainder(field.size(), 1.0);
    const auto add = [&](Index v, double raw, const Vec4& of) {
        const double weight = std::clamp(raw, 0.0, 1.0);
        field[v] += weight * of;
        total[v] += weight;
        remainder[v] -= raw;
    };
    const std::vector<Index>& free = prepared->first->free_vertices();
    for (std::size_t n = 0; n < value.size(); ++n) {
        const std::vector<double>& weights = prepared->turn_weights[n];
        for (std::size_t v = 0; v < weights.size(); ++v) {
            add(static_cast<Index>(v), weights[v], value[n]);
        }
        if (!weights.empty()) continue;
        for (const Index v : prepared->held[solution.handles()[n]]) add(v, 1.0, value[n]);
        for (std::size_t row = 0; row < free.size(); ++row) {
            const double weight = solution.translation_weight(n, static_cast<Index>(row));
            if (prepared->owner[free[row]] != solution.handles()[n]) {
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

// Moves each movable handle by one unit in the second system alone: `turn_weights` are where that
// takes the vertices, and entry (j, k) of `handle_stiffness` is the force on handle j that handle k
// makes.
void Deformer::State::find_responses(const Context& context) {
    const std::vector<Index>& all = prepared->solution->handles();
    if (prepared->turn_weights.size() == all.size()) return;
    const std::vector<Index> held = movable_handles();
    const auto count = static_cast<Index>(held.size());
    Eigen::MatrixXd forces(count, count);
    std::vector<std::vector<double>> weights(all.size());
    for (Index first = 0; first < count; first += 3) {
        const Index last = std::min(count, first + 3);
        std::vector<Vec4> x(deviation.size(), Vec4::Zero());
        for (Index k = first; k < last; ++k) {
            for (const Index v : prepared->held[held[k]]) x[v][k - first] = 1.0;
        }
        prepared->second->solve({}, x, false, context);
        for (Index k = first; k < last; ++k) {
            const auto n = std::find(all.begin(), all.end(), held[k]) - all.begin();
            for (const Vec4& row : x) {
                weights[static_cast<std::size_t>(n)].push_back(row[k - first]);
            }
        }
        for (Index j = 0; j < count; ++j) {
            const Vec3 force =
                prepared->second->force(nullptr, x, prepared->held[held[j]], context);
            for (Index k = first; k < last; ++k) forces(j, k) = -force[k - first];
        }
    }
    prepared->handle_stiffness = forces;
    prepared->turn_weights = std::move(weights);
}

// Handles that the second system could move as a whole: all that hold positions, but the base.
std::vector<Index> Deformer::State::movable_handles() const {
    std::vector<Index> movable;
    for (const Index h : prepared->solution->handles()) {
        const HandleState& handle = handles[h];
        if (handle.options.position && !handle.soft() && !handle.local.empty()) {
            movable.push_back(h);
        }
    }
    return movable;
}

// How far each handle of the solution is from where the present turns alone would put it.
std::vector<Vec4> Deformer::State::mismatches(std::span<const Vec4> x, const Context& context) {
    const std::vector<Index> held = movable_handles();
    const auto count = static_cast<Index>(held.size());
    Eigen::MatrixXd forces(count, 3);
    for (Index j = 0; j < count; ++j) {
        forces.row(j) =
            prepared->second->force(turns.data(), x, prepared->held[held[j]], context).transpose();
    }
    Eigen::MatrixXd natural(count, 3);
    if (count > 0)
        natural = prepared->handle_stiffness.completeOrthogonalDecomposition().solve(forces);
    std::vector<Vec4> result;
    for (const Index h : prepared->solution->handles()) {
        const auto at = std::find(held.begin(), held.end(), h);
        const Vec3 shift =
            at == held.end() ? Vec3(Vec3::Zero()) : Vec3(natural.row(at - held.begin()));
        result.push_back(padded(Vec3(-shift)));
    }
    return result;
}

// Blends into `turns`, by `share`, the rotations of the field of turns: each vertex turns by the
// mean of the handles' rotation vectors; the second system says where the handles would then lie
// by themselves, and what they are off by bends the surface as pure translations do.
void Deformer::State::wind_turns(const Mat3& base_rotation, double share, bool draft,
                                 const Context& context) {
    std::vector<PaddedMat3> before;
    if (share < 1.0) before = turns;
    find_responses(context);
    take_mean_turns(base_rotation, context);
    std::vector<Vec4> x = deviation;
    prepared->second->solve(turns, x, draft, context);
    std::vector<Vec4> y = spread(mismatches(x, context));
    add_constraint_moves(y);

    const std::vector<Index>& vertices = prepared->gathered;
    for_each_block(context, static_cast<Index>(vertices.size()), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> m;
        const std::span<Mat3> block(m.data(), static_cast<std::size_t>(end - begin));
        prepared->gradient_loop().gather(vertices.data(), y.data(), m.data(), begin, end);
        bend_turns({vertices.data() + begin, block.size()}, block, base_rotation);
        blend_turns({vertices.data() + begin, block.size()}, before, share, base_rotation);
    });
    blend_turns(prepared->averaged, before, share, base_rotation);
}

// Makes `turns` the means of the handles' turns.
void Deformer::State::take_mean_turns(const Mat3& base_rotation, const Context& context) {
    const bool scales = options.local_size == LocalSize::scale;
    const Mat3 base = nearest_rotation(frame_base.topLeftCorner<3, 3>());
    const double base_scale = scales ? uniform_scale(frame_base.topLeftCorner<3, 3>()) : 1.0;
    const std::vector<Vec4> field = mean_of_turns(relative_turns());
    for (const std::vector<Index>* vertices : {&prepared->gathered, &prepared->averaged}) {
        for_each_block(context, static_cast<Index>(vertices->size()), [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                const Index v = (*vertices)[static_cast<std::size_t>(i)];
                const double scale = scales ? base_scale * std::exp(field[v][3]) : 1.0;
                turns[v].topRows<3>() =
                    scale * rotation_of_turn(field[v].head<3>()) * base - base_rotation;
            }
        });
    }
}

// Takes the rotations nearest to `turns` with the given gradients added, which are overwritten.
void Deformer::State::bend_turns(std::span<const Index> vertices, std::span<Mat3> gradient,
                                 const Mat3& base_rotation) {
    const bool scales = options.local_size == LocalSize::scale;
    std::array<double, kFrameBlock> scale;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        gradient[i] += base_rotation + turns[vertices[i]].topRows<3>();
        scale[i] = scales ? uniform_scale(gradient[i]) : 1.0;
    }
    nearest_rotations(gradient, gradient);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        turns[vertices[i]].topRows<3>() = scale[i] * gradient[i] - base_rotation;
    }
}

// Turns those from before to `turns` by `share` of the way.
void Deformer::State::blend_turns(std::span<const Index> vertices,
                                  std::span<const PaddedMat3> before, double share,
                                  const Mat3& base_rotation) {
    if (before.empty()) return;
    const bool scales = options.local_size == LocalSize::scale;
    for (const Index v : vertices) {
        const Mat3 first = base_rotation + before[v].topRows<3>();
        const Mat3 now = base_rotation + turns[v].topRows<3>();
        const double scale =
            scales ? (1.0 - share) * uniform_scale(first) + share * uniform_scale(now) : 1.0;
        const Mat3 mean =
            scales ? rotation_between(nearest_rotation(first), nearest_rotation(now), share)
                   : rotation_between(first, now, share);
        turns[v].topRows<3>() = scale * mean - base_rotation;
    }
}

// What vertex constraints add to the positions, where the base is still.
void Deformer::State::add_constraint_moves(std::vector<Vec4>& field) const {
    if (asked.empty()) return;
    for (const auto& entry : asked) field[entry.first] += padded(known_deviation(entry.first));
    const std::vector<Index>& free = prepared->first->free_vertices();
    for (std::size_t row = 0; row < free.size(); ++row) {
        field[free[row]] += padded(prepared->solution->fixed_part(static_cast<Index>(row)));
    }
}

}  // namespace lissom
