#include "kernel/deform/rotation/winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

constexpr double kFullTurn = 2.0 * kPi;

// Below this angle the axis of a rotation is noise.
constexpr double kNoAngle = 1e-9;

// A path is followed in steps of at most this angle, far below where the nearest turn is in doubt.
constexpr double kStep = kPi / 8.0;
constexpr double kMostSteps = 4096.0;

bool are_parallel(const Vec3& a, const Vec3& b) {
    return a.cross(b).norm() <= kNoAngle * a.norm() * b.norm();
}

}  // namespace

Mat3 rotation_of_turn(const Vec3& turn) {
    const double angle = turn.norm();
    if (!(angle > 0.0)) return Mat3::Identity();
    return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

Vec3 turn_near(const Mat3& rotation, const Vec3& before) {
    const Eigen::AngleAxisd least(rotation);
    const double wound = before.norm();
    Vec3 axis = least.axis();
    double angle = least.angle();
    if (angle < kNoAngle) {
        if (wound < kPi) return angle * axis;
        axis = before / wound;
        angle = 0.0;
    }
    const double along = axis.dot(before);
    return (angle + kFullTurn * std::round((along - angle) / kFullTurn)) * axis;
}

Vec3 turned(const Vec3& before, const Vec3& further) {
    if (are_parallel(before, further)) return before + further;
    const double steps = std::clamp(std::ceil(further.norm() / kStep), 1.0, kMostSteps);
    const Mat3 step = rotation_of_turn(further / steps);
    Mat3 rotation = rotation_of_turn(before);
    Vec3 turn = before;
    for (double i = 0.0; i < steps; i += 1.0) {
        rotation = step * rotation;
        turn = turn_near(rotation, turn);
    }
    return turn;
}

}  // namespace lissom
