// The rotations that the first system leads to.
//
// It blends matrices: the nearer handles come to half a turn, the more all of the twist between
// them gathers in the middle, and there its gradients vanish. Beyond a right angle it is asked for
// a fraction of the turns instead, and every vertex then turns on by as much as that leaves.
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/turn_loops.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// Up to this angle the first system does as the thesis says; its turns never grow by more than the
// second angle beyond.
constexpr double kExactAngle = kPi / 2.0;
constexpr double kFurthestBeyond = kPi / 6.0;

// The fraction of the turns that the first system is asked for.
double turn_fraction(double greatest) {
    const double beyond = greatest - kExactAngle;
    if (beyond <= 0.0) return 1.0;
    return (kExactAngle + kFurthestBeyond * std::tanh(beyond / kFurthestBeyond)) / greatest;
}

// Positions of local vertices, relative to the base's motion, if the handles of the solution differ
// from it by `differences` and nothing else moves.
void spread_moves(const FrameInput& motion, std::span<const Mat4> differences,
                  const Context& context, Deviation& x) {
    const std::vector<Index>& handles = motion.solution().handles();
    const Patch& patch = motion.patch();
    const auto number_of = [&](Index owner) {
        const auto found = std::find(handles.begin(), handles.end(), owner);
        return found == handles.end() ? kNoIndex : index_of(found - handles.begin());
    };
    x.assign(patch.vertex_count, Vec4::Zero());
    for_each_block(context, patch.vertex_count, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            const Index n = number_of(motion.prepared().owner[v]);
            if (n != kNoIndex) x[v] = differences[n] * homogeneous(patch.rest[v]);
        }
    });
    const std::vector<Index>& free = motion.method().first->free_vertices();
    motion.solution().find_weights(differences, context);
    for_each_block(context, count_of(free), [&](Index begin, Index end) {
        std::array<Vec4, kFrameBlock> moved;
        motion.solution().handle_part(differences, moved.data(), begin, end);
        for (Index row = begin; row < end; ++row) x[free[row]] = moved[row - begin];
    });
}

// Gradients of weights serve up to this number of handles: more would take longer to read than
// stencils.
constexpr std::size_t kFewHandles = 4;

std::vector<std::vector<Vec3>> find_weight_gradients(const FrameInput& motion,
                                                     const Context& context) {
    const std::vector<Index>& vertices = motion.method().gathered;
    const std::size_t handles = motion.solution().handles().size();
    std::vector<std::vector<Vec3>> gradients(handles, std::vector<Vec3>(vertices.size()));
    for (std::size_t n = 0; n < handles; ++n) {
        std::vector<Vec4> unit(handles, Vec4::Zero());
        unit[n] = Vec4::UnitX();
        std::vector<Vec4> weight;
        motion.spread(unit, weight, context);
        for_each_block(context, count_of(vertices), [&](Index begin, Index end) {
            std::array<Mat3, kFrameBlock> m;
            motion.prepared().gradient_loop().gather(vertices.data(), weight.data(), m.data(),
                                                     begin, end);
            for (Index i = begin; i < end; ++i) gradients[n][i] = m[i - begin].row(0).transpose();
        });
    }
    return gradients;
}

}  // namespace

SpreadMoves::SpreadMoves(const FrameInput& motion, SpreadRoom& room, const Context& context)
    : motion_(motion), room_(room) {
    const ImplicitMethod& method = motion.method();
    if (room.of_handles.size() <= kFewHandles && method.averaged.empty() &&
        motion.asked().at.empty()) {
        weight_gradients_ =
            &method.weight_gradients.get([&] { return find_weight_gradients(motion, context); });
        return;
    }
    motion.spread(room.of_handles, room.field, context);
    motion.add_asked_moves(room.field);
}

void SpreadMoves::gather(const Index* vertices, Mat3* m, Index begin, Index end) const {
    if (!weight_gradients_) {
        motion_.prepared().gradient_loop().gather(vertices, room_.field.data(), m, begin, end);
        return;
    }
    std::fill(m, m + (end - begin), Mat3::Zero());
    for (std::size_t n = 0; n < room_.of_handles.size(); ++n) {
        const Vec3 move = room_.of_handles[n].head<3>();
        if (move.isZero(0.0)) continue;
        const std::vector<Vec3>& gradient = (*weight_gradients_)[n];
        for (Index i = begin; i < end; ++i) m[i - begin] += move * gradient[i].transpose();
    }
}

Mat3 rotation_of(const FrameInput& motion, const Mat3& gradient) {
    const Mat3 r = nearest_rotation(gradient);
    return motion.scales() ? Mat3(uniform_scale(gradient) * r) : r;
}

// Each handle goes `fraction` of its way from the base, along a screw.
std::optional<TurnPart> part_of_turns(const FrameInput& motion, double max_turn, TurnPartRoom& room,
                                      const Context& context) {
    const double fraction = turn_fraction(max_turn);
    if (fraction >= 1.0) return std::nullopt;
    const std::vector<Index>& handles = motion.solution().handles();
    const Mat4& base = motion.base();
    motion.find_relative_turns(room.turns);
    room.differences.clear();
    room.remainder.of_handles.clear();
    for (std::size_t n = 0; n < room.turns.size(); ++n) {
        const Affine& moved = motion.pose(handles[n]).local_transform;
        const Vec3 center =
            motion.prepared().constraints->handles[handles[n]]->center - motion.patch().origin;
        const Vec4 whole = (matrix_of(moved) - base) * homogeneous(center);
        const Screw screw = screw_of(room.turns[n].head<3>(), whole.head<3>());
        Affine at;
        at.linear = rotation_of_turn((fraction - 1.0) * screw.turn) * moved.linear;
        at.translation =
            (base * homogeneous(center)).head<3>() + screw.shift(fraction) - at.linear * center;
        room.differences.push_back(matrix_of(at) - base);
        room.remainder.of_handles.push_back(padded(screw.remainder));
    }
    spread_moves(motion, room.differences, context, room.deviation);
    return TurnPart{fraction, room.deviation, SpreadMoves(motion, room.remainder, context)};
}

void extrapolate_rotation(const FrameInput& motion, const TurnPart& part, const Index* vertices,
                          Mat3* gradient, Index begin, Index end) {
    const Mat3 base_linear = motion.base_linear();
    const std::size_t count = end - begin;
    Vec4 base;
    std::array<Vec4, kFrameBlock> rotation;
    std::array<Mat3, kFrameBlock> added;
    nearest_quaternions({&base_linear, 1}, {&base, 1});
    nearest_quaternions({gradient, count}, {rotation.data(), count});
    part.remainder.gather(vertices, added.data(), begin, end);
    turn_further({rotation.data(), count}, base, 1.0 / part.fraction - 1.0, {gradient, count});
    for (std::size_t i = 0; i < count; ++i) gradient[i] += added[i];
}

void first_gradients(const FrameInput& motion, const TurnPart* part,
                     std::span<const Vec4> deviation, Mat3* m, Index begin, Index end) {
    const Index* vertices = motion.method().gathered.data();
    const Vec4* x = part ? part->deviation.data() : deviation.data();
    const Mat3 base = motion.base_linear();
    motion.prepared().gradient_loop().gather(vertices, x, m, begin, end);
    for (Index i = 0; i < end - begin; ++i) m[i] += base;
    if (part) extrapolate_rotation(motion, *part, vertices, m, begin, end);
}

void first_rotations(const FrameInput& motion, const TurnPart* part,
                     std::span<const Vec4> deviation, Mat3* s, Index begin, Index end) {
    const std::size_t count = end - begin;
    std::array<double, kFrameBlock> scale;
    first_gradients(motion, part, deviation, s, begin, end);
    const bool scales = motion.scales();
    for (std::size_t i = 0; i < count; ++i) scale[i] = scales ? uniform_scale(s[i]) : 1.0;
    nearest_rotations({s, count}, {s, count});
    for (std::size_t i = 0; i < count; ++i) s[i] *= scale[i];
}

void turn_held(const SecondInput& input, Rotations& rotations) {
    const FrameInput& motion = input.motion;
    const Preparation& prepared = motion.prepared();
    const auto& handles = prepared.constraints->handles;
    for (std::size_t n = 0; n < handles.size(); ++n) {
        const Handle* h = handles[n].get();
        if (!h || h->soft() || !h->options.gradient) continue;
        const Mat3& linear = motion.pose(index_of(n)).transform.linear;
        const PaddedMat3 turn =
            padded_columns(held_transform(motion, linear) - input.base_rotation);
        for (const Index v : prepared.held[n]) rotations[v] = turn;
        for (const SparseRow& row : h->points) {
            for (const auto& [v, c] : row) {
                if (prepared.owner[v] == index_of(n)) rotations[v] = turn;
            }
        }
    }
    for (const auto& entry : motion.asked().at) {
        const Index v = entry.first;
        if (v >= motion.patch().real_count || !prepared.known.gradient[v]) continue;
        rotations[v] =
            padded_columns(held_transform(motion, motion.known_gradient(v)) - input.base_rotation);
    }
}

void find_rotations(const SecondInput& input, std::span<const Vec4> deviation, TurnPartRoom& room,
                    const Context& context, Rotations& rotations) {
    const FrameInput& motion = input.motion;
    const std::optional<TurnPart> part = part_of_turns(motion, input.max_turn, room, context);
    const TurnPart* const of = part ? &*part : nullptr;
    const std::vector<Index>& vertices = motion.method().gathered;
    for_each_block(context, count_of(vertices), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> s;
        first_rotations(motion, of, deviation, s.data(), begin, end);
        for (Index i = begin; i < end; ++i) {
            rotations[vertices[i]].topRows<3>() = s[i - begin] - input.base_rotation;
        }
    });
    for (const Index v : motion.method().averaged) {
        const Mat3 m = gradient_of(motion, deviation, v, of);
        rotations[v] = padded_columns(rotation_of(motion, m) - input.base_rotation);
    }
    turn_held(input, rotations);
}

}  // namespace lissom
