#include "kernel/deform/bones/bone_chain.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"

namespace lissom {
namespace {

// Beyond this coordinates have no squares.
constexpr double kFarthest = 1e100;

void require_near(const Vec3& place, const char* name) {
    require(place.allFinite() && place.cwiseAbs().maxCoeff() <= kFarthest,
            std::string(name) + " is not finite, or beyond 1e100", ErrorCode::not_finite);
}

void require_joints(const std::vector<Vec3>& joints, const std::vector<double>& limits) {
    require(joints.size() >= 2, "a chain of bones has two joints at least");
    for (const Vec3& joint : joints) {
        require_near(joint, "a joint");
    }
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        require((joints[i + 1] - joints[i]).norm() > 0.0,
                "bone " + std::to_string(i + 1) + " has no length: take out one of its joints");
    }
    require(limits.empty() || limits.size() + 1 == joints.size(),
            "there is one limit for each bone, or none at all");
    for (const double limit : limits) {
        require(limit >= 0.0 && limit <= kPi + 1e-9, "limits are angles from 0 to 180 degrees");
    }
}

}  // namespace

BoneChain::BoneChain(std::vector<Vec3> joints, std::vector<double> limits)
    : rest_(std::move(joints)), limits_(std::move(limits)) {
    require_joints(rest_, limits_);
    if (limits_.empty()) limits_.assign(rest_.size() - 1, kPi);
    turns_.assign(rest_.size() - 1, Eigen::Quaterniond::Identity());
    base_ = rest_.front();
}

std::vector<Eigen::Quaterniond> BoneChain::frames() const {
    std::vector<Eigen::Quaterniond> frames;
    Eigen::Quaterniond frame = Eigen::Quaterniond::Identity();
    for (const Eigen::Quaterniond& turn : turns_) {
        frame = (frame * turn).normalized();
        frames.push_back(frame);
    }
    return frames;
}

std::vector<Vec3> BoneChain::joints() const {
    const std::vector<Eigen::Quaterniond> turned = frames();
    std::vector<Vec3> places = {base_};
    for (std::size_t i = 0; i < turned.size(); ++i) {
        places.push_back(places.back() + turned[i] * (rest_[i + 1] - rest_[i]));
    }
    return places;
}

std::vector<Affine> BoneChain::transforms() const {
    const std::vector<Eigen::Quaterniond> turned = frames();
    const std::vector<Vec3> places = joints();
    std::vector<Affine> maps;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        maps.push_back({turned[i].toRotationMatrix(), places[i] - turned[i] * rest_[i]});
    }
    return maps;
}

double BoneChain::length() const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < rest_.size(); ++i) sum += (rest_[i + 1] - rest_[i]).norm();
    return sum;
}

Eigen::Quaterniond BoneChain::rotation(Index bone) const {
    require(bone >= 0 && bone < size(), "there is no such bone", ErrorCode::out_of_range);
    return frames()[at(bone)];
}

void BoneChain::set(std::span<const Eigen::Quaterniond> rotations, const Vec3& base) {
    require(rotations.size() == turns_.size(), "there is one rotation for each bone");
    Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
    for (std::size_t i = 0; i < turns_.size(); ++i) {
        turns_[i] = (before.conjugate() * rotations[i]).normalized();
        before = rotations[i];
    }
    base_ = base;
}

void BoneChain::set_base(const Vec3& place) {
    require_near(place, "the base");
    base_ = place;
}

bool BoneChain::limit(Index bone) {
    Eigen::AngleAxisd turn(turns_[at(bone)].normalized());
    // The angle is from 0 to pi.
    if (turn.angle() <= limits_[at(bone)]) return false;
    turn.angle() = limits_[at(bone)];
    turns_[at(bone)] = Eigen::Quaterniond(turn);
    return true;
}

bool BoneChain::is_free() const {
    return std::all_of(limits_.begin(), limits_.end(),
                       [](double limit) { return limit >= kPi - 1e-9; });
}

double BoneChain::distance_to(const Vec3& target) const {
    return (joints().back() - target).norm();
}

void BoneChain::turn(Index bone, const Vec3& axis, double angle) {
    require(axis.allFinite() && std::isfinite(angle), "axis and angle are finite numbers",
            ErrorCode::not_finite);
    require(axis.norm() > 0.0, "the axis of a turn has no length");
    const Eigen::Quaterniond now =
        Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())) * rotation(bone);
    const Eigen::Quaterniond before =
        bone > 0 ? rotation(bone - 1) : Eigen::Quaterniond::Identity();
    turns_[at(bone)] = (before.conjugate() * now).normalized();
    limit(bone);
}

}  // namespace lissom
