/// Frames of one preparation that two threads solve at the same time.
#pragma once

#include <thread>

#include "kernel/deform/pipeline.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

namespace lissom::test {

inline bool same_frame(const DeformFrame& a, const DeformFrame& b) {
    return a.positions == b.positions && a.inserted == b.inserted;
}

// Turns below and beyond half a turn, so that threads find what turns need at the same time.
inline std::vector<Poses> poses_of(const Scene& scene, Edit& edit, const Preparation& prepared) {
    std::vector<Poses> poses;
    const Vec3 center = edit.deformer.handle(edit.high).center;
    for (const double angle : {0.7, 3.5, 4.5, 1.6}) {
        poses.push_back(edit.deformer.snapshot().poses);
        const Affine move = translation({0.1 * angle, 0.2, 0.0}) *
                            rotation(scene.across + Vec3(0.1, 0.5, 0.2), angle, Vec3::Zero());
        pose_handle(prepared, poses.back(), edit.high, move, center, Vec3(0.0, angle, 0.0));
        for (TargetPose& target : poses.back().targets) target.position += Vec3(angle / 9, 0, 0);
    }
    return poses;
}

// Solves each pose in turn, and then on two threads at once, which begin with different ones.
inline void check_threads(const Scene& scene, Edit& edit) {
    // Nothing is found yet that a frame asks for first.
    const auto made = edit.deformer.prepare(),
               prepared = prepare_deformation(rest_of(*made), constraints_of(*made));
    const std::vector<Poses> poses = poses_of(scene, edit, *prepared);
    const auto solve_all = [&](const std::shared_ptr<const Preparation>& by, std::size_t first) {
        FrameScratch scratch;
        std::vector<DeformFrame> frames(2 * poses.size());
        for (std::size_t k = 0; k < poses.size(); ++k) {
            const std::size_t n = (first + k) % poses.size();
            frames[2 * n] = preview_frame(by, poses[n], scratch);
            frames[2 * n + 1] = solve_frame(by, poses[n], scratch);
            frames[2 * n + 1].gradients = frame_gradients(frames[2 * n + 1], scratch);
        }
        return frames;
    };
    std::vector<DeformFrame> a, b;
    std::thread other([&] { a = solve_all(prepared, 1); });
    b = solve_all(prepared, 2);
    other.join();
    // Of another preparation, which no two threads have seen.
    const auto alone = prepare_deformation(rest_of(*prepared), constraints_of(*prepared));
    const std::vector<DeformFrame> in_turn = solve_all(alone, 0);
    for (std::size_t n = 0; n < in_turn.size(); ++n) {
        CAPTURE(n);
        CHECK(same_frame(a[n], in_turn[n]));
        CHECK(same_frame(b[n], in_turn[n]));
        CHECK(a[n].gradients == in_turn[n].gradients);
        CHECK(b[n].gradients == in_turn[n].gradients);
    }
}

}  // namespace lissom::test
