// Refinement of a result: rotations fitted to the positions that the second system found.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// Over-relaxation of a refinement, in steps from the last rotations: large in all steps but the
// last, which corrects the excess. Two such steps lower the energy as four or five without would.
constexpr double kFurther = 1.6;
constexpr double kLastFurther = 0.5;

// Between these angles over-relaxation fades out: sides of a part that is twisted more would cave
// in until they meet.
constexpr double kNearAngle = 178.0 * kPi / 180.0;
constexpr double kFarAngle = 270.0 * kPi / 180.0;

// Rotations that a refinement would change by more than this are followed less, and by twice as
// much not at all: the surface has caved in or folded there, no rotation fits, and the best one
// would fold it further or unwind the prescribed turn.
constexpr double kSureChange = 25.0 * kPi / 180.0;

// Nothing is refined if handles change the size of the surface by this logarithm or more: no
// rotation fits, and the best one would trade stretch for a moat beside the handle.
constexpr double kSizeChange = 0.05;

// Change of size by handles, as logarithms in the last entry; empty if there is none.
const std::vector<Vec4>& size_changes(const FrameInput& motion, RefineRoom& room,
                                      const Context& context) {
    room.sizes.clear();
    if (!motion.method().solution) return room.sizes;
    motion.find_relative_turns(room.turns);
    const bool any = std::any_of(room.turns.begin(), room.turns.end(),
                                 [](const Vec4& h) { return std::abs(h[3]) > 1e-9; });
    if (any) motion.spread(room.turns, room.sizes, context);
    return room.sizes;
}

}  // namespace

double over_relaxation(double max_turn, bool last) {
    const double far = smooth_step((max_turn - kNearAngle) / (kFarAngle - kNearAngle));
    return (last ? kLastFurther : kFurther) * (1.0 - far);
}

// Local step of Sorkine and Alexa, "As-rigid-as-possible surface modeling" (2007), for the energy
// of the second system: with its solution in between, that energy never increases. Successive
// over-relaxation: the rotations then go on by `further` times the change, and less if no rotation
// fits. Scales stay.
void refine_rotations(const SecondInput& input, std::span<const Vec4> deviation, double further,
                      RefineRoom& room, const Context& context, Rotations& rotations) {
    const FrameInput& motion = input.motion;
    const Patch& patch = motion.patch();
    std::vector<Vec4>& x = room.absolute;
    x.resize(patch.real_count);
    for_each_block(context, patch.real_count, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            x[v] = padded(Vec3(input.base_rotation * patch.rest[v] + deviation[v].head<3>()));
        }
    });
    const EnergyLoop loop = motion.method().second->energy();
    const std::vector<Vec4>& sizes = size_changes(motion, room, context);
    const bool scales = motion.scales();
    for (const std::vector<Index>* vertices :
         {&motion.method().gathered, &motion.method().averaged}) {
        const auto all = count_of(*vertices);
        for_each_block(context, all, [&](Index begin, Index end) {
            std::array<Mat3, kFrameBlock> m;
            const std::size_t count = end - begin;
            loop.fit(x.data(), vertices->data(), m.data(), begin, end);
            nearest_rotations({m.data(), count}, {m.data(), count});
            for (std::size_t i = 0; i < count; ++i) {
                const Index v = (*vertices)[begin + i];
                auto turn = rotations[v].topRows<3>();
                const Mat3 before = input.base_rotation + turn;
                const double scale = scales ? uniform_scale(before) : 1.0;
                // A surface that has shrunk to a point gives no rotation.
                if (!(scale > 0.0)) continue;
                const Mat3 from = before / scale;
                const Eigen::AngleAxisd change(Mat3(m[i] * from.transpose()));
                double sure = 1.0 - smooth_step((change.angle() - kSureChange) / kSureChange);
                if (!sizes.empty()) sure *= 1.0 - smooth_step(std::abs(sizes[v][3]) / kSizeChange);
                const double angle = (1.0 + further) * sure * change.angle();
                turn =
                    scale * (rotation_of_turn(angle * change.axis()) * from) - input.base_rotation;
            }
        });
    }
}

}  // namespace lissom
