// Rotations of handles beyond a right angle. The first system blends matrices: the nearer handles
// come to half a turn, the more all of the twist between them gathers in the middle, and there its
// gradients vanish. It is asked for a fraction of the turns instead, and every vertex then turns on
// by as much as that leaves.
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// Up to this angle the first system does as the thesis says; its turns never grow by more than the
// second angle beyond.
constexpr double kExactAngle = kPi / 2.0;
constexpr double kFurthestBeyond = kPi / 6.0;

}  // namespace

// The share of the turns that the first system is asked for.
double Deformer::State::turn_fraction(double greatest) {
    const double beyond = greatest - kExactAngle;
    if (beyond <= 0.0) return 1.0;
    return (kExactAngle + kFurthestBeyond * std::tanh(beyond / kFurthestBeyond)) / greatest;
}

// Each handle goes `fraction` of its way from the base, along a screw.
TurnPart Deformer::State::part_of_turns(double fraction, const Context& context) const {
    const LinearSolution& solution = *prepared->solution;
    const Patch& patch = prepared->work->patch;
    const Mat4 base = base_transform();
    const std::vector<Vec4> turns_of_handles = relative_turns();
    std::vector<Mat4> differences;
    std::vector<Vec4> remainders;
    for (std::size_t n = 0; n < turns_of_handles.size(); ++n) {
        const HandleState& handle = handles[solution.handles()[n]];
        const Vec3 center = handle.center - patch.origin;
        const Vec4 whole = (matrix_of(handle.in_patch) - base) * homogeneous(center);
        const Screw screw = screw_of(turns_of_handles[n].head<3>(), whole.head<3>());
        Affine at;
        at.linear = rotation_of_turn((fraction - 1.0) * screw.turn) * handle.in_patch.linear;
        at.translation =
            (base * homogeneous(center)).head<3>() + screw.shift(fraction) - at.linear * center;
        differences.push_back(matrix_of(at) - base);
        remainders.push_back(padded(screw.remainder));
    }
    TurnPart part{fraction, spread_moves(differences, context), spread(remainders)};
    add_constraint_moves(part.remainder);
    return part;
}

// Where local vertices lie, relative to where the base takes them, if the handles of the solution
// differ from it by `differences` and nothing else moves.
std::vector<Vec4> Deformer::State::spread_moves(std::span<const Mat4> differences,
                                                const Context& context) const {
    const LinearSolution& solution = *prepared->solution;
    const Patch& patch = prepared->work->patch;
    const auto number_of = [&](Index owner) {
        const auto found = std::find(solution.handles().begin(), solution.handles().end(), owner);
        return found == solution.handles().end()
                   ? kNoIndex
                   : static_cast<Index>(found - solution.handles().begin());
    };
    std::vector<Vec4> x(static_cast<std::size_t>(patch.vertex_count), Vec4::Zero());
    for (Index v = 0; v < patch.vertex_count; ++v) {
        const Index n = number_of(prepared->owner[v]);
        if (n != kNoIndex) x[v] = differences[n] * homogeneous(patch.rest[v]);
    }
    const std::vector<Index>& free = prepared->first->free_vertices();
    for_each_block(context, static_cast<Index>(free.size()), [&](Index begin, Index end) {
        std::array<Vec4, kFrameBlock> moved;
        solution.handle_part(differences, moved.data(), begin, end);
        for (Index row = begin; row < end; ++row) x[free[row]] = moved[row - begin];
    });
    return x;
}

// Turns gradients of `part` on by what it leaves, and adds the remainders.
void Deformer::State::turn_on(const TurnPart& part, std::span<const Index> vertices,
                              std::span<Mat3> gradient) const {
    const Mat3 back = nearest_rotation(frame_base.topLeftCorner<3, 3>()).transpose();
    const double further = 1.0 / part.fraction - 1.0;
    std::array<Mat3, kFrameBlock> rotation, added;
    const auto count = static_cast<Index>(vertices.size());
    nearest_rotations(gradient, {rotation.data(), vertices.size()});
    prepared->gradient_loop().gather(vertices.data(), part.remainder.data(), added.data(), 0,
                                     count);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        gradient[i] = turned_further(rotation[i] * back, further) * gradient[i] + added[i];
    }
}

}  // namespace lissom
