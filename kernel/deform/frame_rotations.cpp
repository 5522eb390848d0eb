// The rotations that the first system leads to.
//
// It blends matrices: the nearer handles come to half a turn, the more all of the twist between
// them gathers in the middle, and there its gradients vanish. Beyond a right angle it is asked for
// a fraction of the turns instead, and every vertex then turns on by as much as that leaves.
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/deform/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

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

// Where local vertices lie, relative to where the base takes them, if the handles of the solution
// differ from it by `differences` and nothing else moves.
Deviation spread_moves(const Motion& motion, std::span<const Mat4> differences,
                       const Context& context) {
    const std::vector<Index>& handles = motion.solution().handles();
    const Patch& patch = motion.patch();
    const auto number_of = [&](Index owner) {
        const auto found = std::find(handles.begin(), handles.end(), owner);
        return found == handles.end() ? kNoIndex : static_cast<Index>(found - handles.begin());
    };
    Deviation x(static_cast<std::size_t>(patch.vertex_count), Vec4::Zero());
    for (Index v = 0; v < patch.vertex_count; ++v) {
        const Index n = number_of(motion.prepared().owner[v]);
        if (n != kNoIndex) x[v] = differences[n] * homogeneous(patch.rest[v]);
    }
    const std::vector<Index>& free = motion.method().first->free_vertices();
    for_each_block(context, static_cast<Index>(free.size()), [&](Index begin, Index end) {
        std::array<Vec4, kFrameBlock> moved;
        motion.solution().handle_part(differences, moved.data(), begin, end);
        for (Index row = begin; row < end; ++row) x[free[row]] = moved[row - begin];
    });
    return x;
}

// Handles turn as a whole, and targets as they are asked to.
void turn_held(const SecondInput& input, Rotations& rotations) {
    const Motion& motion = input.motion;
    const Preparation& prepared = motion.prepared();
    const auto& handles = prepared.holds->handles;
    for (std::size_t n = 0; n < handles.size(); ++n) {
        const Handle* h = handles[n].get();
        if (!h || h->soft() || !h->options.gradient) continue;
        const Mat3& linear = motion.pose(static_cast<Index>(n)).transform.linear;
        const PaddedMat3 turn = padded_columns(rotation_of(motion, linear) - input.base_rotation);
        for (const Index v : prepared.held[n]) rotations[v] = turn;
        for (const SparseRow& row : h->points) {
            for (const auto& [v, c] : row) {
                if (prepared.owner[v] == static_cast<Index>(n)) rotations[v] = turn;
            }
        }
    }
    for (const auto& entry : motion.asked().at) {
        const Index v = entry.first;
        if (v >= motion.patch().real_count || !prepared.known.gradient[v]) continue;
        rotations[v] =
            padded_columns(rotation_of(motion, motion.known_gradient(v)) - input.base_rotation);
    }
}

}  // namespace

Mat3 rotation_of(const Motion& motion, const Mat3& gradient) {
    const Mat3 r = nearest_rotation(gradient);
    return motion.scales() ? Mat3(uniform_scale(gradient) * r) : r;
}

// Each handle goes `fraction` of its way from the base, along a screw.
std::optional<TurnPart> part_of_turns(const Motion& motion, double greatest_turn,
                                      const Context& context) {
    const double fraction = turn_fraction(greatest_turn);
    if (fraction >= 1.0) return std::nullopt;
    const std::vector<Index>& handles = motion.solution().handles();
    const Mat4& base = motion.base();
    const std::vector<Vec4> turns = motion.relative_turns();
    std::vector<Mat4> differences;
    std::vector<Vec4> remainders;
    for (std::size_t n = 0; n < turns.size(); ++n) {
        const Affine& moved = motion.pose(handles[n]).local_transform;
        const Vec3 center =
            motion.prepared().holds->handles[handles[n]]->center - motion.patch().origin;
        const Vec4 whole = (matrix_of(moved) - base) * homogeneous(center);
        const Screw screw = screw_of(turns[n].head<3>(), whole.head<3>());
        Affine at;
        at.linear = rotation_of_turn((fraction - 1.0) * screw.turn) * moved.linear;
        at.translation =
            (base * homogeneous(center)).head<3>() + screw.shift(fraction) - at.linear * center;
        differences.push_back(matrix_of(at) - base);
        remainders.push_back(padded(screw.remainder));
    }
    TurnPart part{fraction, spread_moves(motion, differences, context), motion.spread(remainders)};
    motion.add_asked_moves(part.remainder);
    return part;
}

void turn_on(const Motion& motion, const TurnPart& part, std::span<const Index> vertices,
             std::span<Mat3> gradient) {
    const Mat3 back = nearest_rotation(motion.base_linear()).transpose();
    const double further = 1.0 / part.fraction - 1.0;
    std::array<Mat3, kFrameBlock> rotation, added;
    const auto count = static_cast<Index>(vertices.size());
    nearest_rotations(gradient, {rotation.data(), vertices.size()});
    motion.prepared().gradient_loop().gather(vertices.data(), part.remainder.data(), added.data(),
                                             0, count);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        gradient[i] = turned_further(rotation[i] * back, further) * gradient[i] + added[i];
    }
}

void find_rotations(const SecondInput& input, std::span<const Vec4> deviation,
                    const Context& context, Rotations& rotations) {
    const Motion& motion = input.motion;
    const std::optional<TurnPart> part = part_of_turns(motion, input.greatest_turn, context);
    const Vec4* x = part ? part->deviation.data() : deviation.data();
    const Mat3 base = motion.base_linear();
    const bool scales = motion.scales();
    const GradientLoop loop = motion.prepared().gradient_loop();
    const std::vector<Index>& vertices = motion.method().gathered;
    for_each_block(context, static_cast<Index>(vertices.size()), [&](Index begin, Index end) {
        std::array<Mat3, kFrameBlock> m;
        std::array<double, kFrameBlock> scale;
        const auto count = static_cast<std::size_t>(end - begin);
        loop.gather(vertices.data(), x, m.data(), begin, end);
        for (std::size_t i = 0; i < count; ++i) m[i] += base;
        if (part) turn_on(motion, *part, {vertices.data() + begin, count}, {m.data(), count});
        for (std::size_t i = 0; i < count; ++i) scale[i] = scales ? uniform_scale(m[i]) : 1.0;
        nearest_rotations({m.data(), count}, {m.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const Index v = vertices[static_cast<std::size_t>(begin) + i];
            rotations[v].topRows<3>() = scale[i] * m[i] - input.base_rotation;
        }
    });
    for (const Index v : motion.method().averaged) {
        const Mat3 m = gradient_of(motion, deviation, v, part ? &*part : nullptr);
        rotations[v] = padded_columns(rotation_of(motion, m) - input.base_rotation);
    }
    turn_held(input, rotations);
}

}  // namespace lissom
