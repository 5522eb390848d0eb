// Stretch of handles in the second system.
#include <Eigen/LU>
#include <algorithm>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/polar.h"

namespace lissom {
namespace {

// Largest deviation from a rotation of a rigid transform.
constexpr double kRigid = 1e-9;

// Laplacian coordinates (Eq 2.10) know rotations only.
bool knows_lengths(const FrameInput& motion) {
    return motion.options().second != SecondSystem::laplacian;
}

bool stretches(const FrameInput& motion, const Mat3& linear) {
    const Mat3 turn = rotation_of(motion, linear);
    return (linear - turn).norm() > kRigid * turn.norm();
}

// The part of `asked` present in `found`, at most `share` of it.
Mat3 part_of_stretch(const Mat3& asked, const Mat3& found, double share) {
    const Mat3 change = asked - Mat3::Identity();
    const double along = (found - Mat3::Identity()).cwiseProduct(change).sum();
    return Mat3::Identity() + std::clamp(along / change.squaredNorm(), 0.0, share) * change;
}

class StretchTaker {
  public:
    StretchTaker(const FrameInput& motion, std::span<const Vec4> deviation,
                 std::vector<TakenStretch>& taken)
        : motion_(motion), deviation_(deviation), taken_(taken) {}

    void run() {
        const Preparation& prepared = motion_.prepared();
        for (const GradientTie& tie : prepared.work->gradient_ties) take_tie(tie);
        for (std::size_t h = 0; h < prepared.held.size(); ++h) take_positions(index_of(h));
    }

  private:
    // Strength for an area of one squared radius, as weights are given.
    void take_tie(const GradientTie& tie) {
        const WorkingPatch& work = *motion_.prepared().work;
        const double area = work.geometry.area[at(tie.vertex)];
        const double strength = tie.weight * work.radius * work.radius;
        take(tie.vertex, motion_.known_gradient(tie.anchor), strength / (strength + area));
    }

    void take_positions(Index h) {
        const Handle* handle = motion_.prepared().constraints->handles[at(h)].get();
        if (!handle || handle->soft() || handle->options.gradient) return;
        const Mat3& linear = motion_.pose(h).transform.linear;
        for (const Index v : motion_.prepared().held[at(h)]) take(v, linear, 1.0);
    }

    void take(Index v, const Mat3& linear, double share) {
        if (motion_.prepared().known.gradient[at(v)] || !stretches(motion_, linear)) return;
        const Mat3 found = stretch_of(gradient_of(motion_, deviation_, v));
        taken_.push_back({v, part_of_stretch(stretch_of(linear), found, share)});
    }

    // The symmetric part of `gradient`, in the axes of rest, beside the part already in S.
    Mat3 stretch_of(const Mat3& gradient) const {
        return rotation_of(motion_, gradient).inverse() * gradient;
    }

    const FrameInput& motion_;
    std::span<const Vec4> deviation_;
    std::vector<TakenStretch>& taken_;
};

}  // namespace

Mat3 held_transform(const FrameInput& motion, const Mat3& linear) {
    const bool whole = knows_lengths(motion) && stretches(motion, linear);
    return whole ? linear : rotation_of(motion, linear);
}

void find_taken_stretches(const FrameInput& motion, std::span<const Vec4> deviation,
                          std::vector<TakenStretch>& taken) {
    taken.clear();
    if (knows_lengths(motion)) StretchTaker(motion, deviation, taken).run();
}

}  // namespace lissom
