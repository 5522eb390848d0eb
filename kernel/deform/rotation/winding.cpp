#include "kernel/deform/rotation/winding.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lissom {
namespace {

constexpr double kFullTurn = 2.0 * kPi;

// Below this angle the axis of a rotation is noise.
constexpr double kNoAngle = 1e-9;

// Largest step along a path, far below the angle at which the nearest turn is in doubt.
constexpr double kStep = kPi / 8.0;
constexpr double kMaxSteps = 4096.0;

// A screw takes shifts across its axis along from this angle on, and up to the angles between which
// that fades.
constexpr double kScrewAngle = kPi / 2.0;
constexpr double kWideScrew = 200.0 * kPi / 180.0, kWidestScrew = 280.0 * kPi / 180.0;

// The mean of the rotations from none to all of `turn`.
Mat3 mean_rotation(const Vec3& turn) {
    const double half = 0.5 * turn.norm();
    if (half < kNoAngle) return Mat3::Identity();
    const Vec3 axis = turn / (2.0 * half);
    const Mat3 along = axis * axis.transpose();
    return along +
           std::sin(half) / half * rotation_of_turn(0.5 * turn) * (Mat3::Identity() - along);
}

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

double smooth_step(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

Mat3 rotation_between(const Mat3& from, const Mat3& to, double fraction) {
    const Eigen::AngleAxisd way(Mat3(to * from.transpose()));
    return rotation_of_turn(fraction * way.angle() * way.axis()) * from;
}

Mat3 turned_further(const Mat3& rotation, double part) {
    const Eigen::AngleAxisd least(rotation);
    const double sure = 1.0 - smooth_step((least.angle() - kSureTurn) / (kPi - kSureTurn));
    return rotation_of_turn(part * sure * least.angle() * least.axis());
}

Vec3 Screw::shift(double part) const {
    return part * (mean_rotation(part * turn) * velocity);
}

Screw screw_of(const Vec3& turn, const Vec3& shift) {
    const double angle = turn.norm();
    if (angle < kNoAngle) return {turn, Vec3::Zero(), shift};
    const Vec3 axis = turn / angle, along = axis.dot(shift) * axis;
    const double begun = smooth_step(angle / kScrewAngle);
    const double screw_part = 1.0 - smooth_step((angle - kWideScrew) / (kWidestScrew - kWideScrew));
    Screw screw{turn, begun * along, Vec3::Zero()};
    if (screw_part > 0.0) {
        const double wider = 0.5 * angle / std::sin(0.5 * angle);
        screw.velocity +=
            begun * screw_part * wider * (rotation_of_turn(-0.5 * turn) * (shift - along));
    }
    screw.remainder = shift - screw.shift(1.0);
    return screw;
}

Vec3 turned(const Vec3& before, const Vec3& further) {
    if (are_parallel(before, further)) return before + further;
    const double steps = std::clamp(std::ceil(further.norm() / kStep), 1.0, kMaxSteps);
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
