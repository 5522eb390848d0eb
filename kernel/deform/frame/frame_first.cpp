// The first system in a frame: positions by the handle basis, and the deformation gradients that
// they have.
#include <array>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {

void solve_first(const FrameInput& motion, const Context& context, Deviation& deviation) {
    const Preparation& prepared = motion.prepared();
    const Patch& patch = motion.patch();
    deviation.assign(patch.vertex_count, Vec4::Zero());
    for (std::size_t h = 0; h < prepared.held.size(); ++h) {
        const Mat4 difference = matrix_of(motion.pose(index_of(h)).local_transform) - motion.base();
        for (const Index v : prepared.held[h])
            deviation[v] = difference * homogeneous(patch.rest[v]);
    }
    for (const auto& entry : motion.asked().at) {
        deviation[entry.first] = padded(motion.known_deviation(entry.first));
    }
    for (Index v = patch.surface_count; v < patch.vertex_count; ++v) {
        deviation[v] = padded(motion.known_deviation(v));
    }
    if (!motion.method().solution) return;
    const std::vector<Index>& free = motion.method().first->free_vertices();
    motion.solution().find_weights(motion.differences(), context);
    for_each_block(context, count_of(free), [&](Index begin, Index end) {
        std::array<Vec4, kFrameBlock> x;
        motion.solution().deviations(motion.differences(), motion.asked().fixed, x.data(), begin,
                                     end);
        for (Index row = begin; row < end; ++row) deviation[free[row]] = x[row - begin];
    });
}

Mat3 gradient_of(const FrameInput& motion, std::span<const Vec4> deviation, Index v,
                 const TurnPart* part) {
    const Preparation& prepared = motion.prepared();
    const std::vector<char>& defined = motion.method().gradients.defined;
    if (prepared.known.gradient[v]) return motion.known_gradient(v);
    const Mat3 base = motion.base_linear();
    const Vec4* x = part ? part->deviation.data() : deviation.data();
    const auto gathered = [&](Index u) -> Mat3 {
        if (prepared.known.gradient[u]) return motion.known_gradient(u);
        Mat3 m;
        prepared.gradient_loop().gather(&u, x, &m, 0, 1);
        m += base;
        if (part) extrapolate_rotation(motion, *part, &u, &m, 0, 1);
        return m;
    };
    if (defined[v]) return gathered(v);
    Mat3 sum = Mat3::Zero();
    int count = 0;
    for (const Index n : prepared.rings().ring(v)) {
        if (!prepared.known.gradient[n] && !defined[n]) continue;
        sum += gathered(n);
        ++count;
    }
    return count > 0 ? Mat3(sum / count) : Mat3(Mat3::Identity());
}

}  // namespace lissom
