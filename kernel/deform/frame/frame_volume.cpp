// The volume of a solid, kept by springs across its inside.
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/volume/volume_springs.h"

namespace lissom {
namespace {

VolumeSprings make_springs(const Preparation& prepared, const Context& context) {
    const RestShape& rest = *prepared.rest;
    const Thickness& thickness =
        rest.thickness->get([&] { return find_thickness(*rest.work, context); });
    return {thickness, *prepared.work, prepared.known, *prepared.implicit()->second, context};
}

// The logarithm of the greatest stretch of a linear map.
double strain_of(const Mat3& linear) {
    const Vec3 stretch = Eigen::JacobiSVD<Mat3>(linear).singularValues();
    return std::max(std::log(stretch[0]), -std::log(stretch[2]));
}

// The strains of the handles, spread over the surface; empty if none stretches.
std::span<const Vec4> strains(const FrameInput& motion, VolumeRoom& room, const Context& context) {
    if (!motion.method().solution) return {};
    room.values.clear();
    double most = 0.0;
    const double base = strain_of(motion.base_linear());
    for (const Index h : motion.solution().handles()) {
        const double strain = std::max(base, strain_of(motion.pose(h).transform.linear));
        room.values.push_back({0.0, 0.0, 0.0, strain - base});
        most = std::max(most, strain);
    }
    if (!(most > 1e-9)) return {};
    motion.spread(room.values, room.strain, context);
    for (Vec4& strain : room.strain) strain[3] += base;
    return room.strain;
}

}  // namespace

double volume_share(const FrameInput& motion) {
    return motion.poses().volume.value_or(motion.options().volume);
}

void keep_volume(const SecondInput& input, FrameScratch::State& scratch, const Context& context) {
    const FrameInput& motion = input.motion;
    const double share = volume_share(motion);
    if (!(share > 0.0)) return;
    const VolumeSprings& springs =
        motion.method().springs.get([&] { return make_springs(motion.prepared(), context); });
    if (springs.empty()) return;
    const VolumeSprings::Shape shape{input.base_rotation, scratch.rotations,
                                     strains(motion, scratch.volume, context)};
    springs.correct(shape, share, scratch.deviation, scratch.volume.springs, context);
}

}  // namespace lissom
