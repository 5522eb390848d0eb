#include "viewer/window/session/player.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lissom::window {
namespace {

// Part of a passed second that is played at once, at most.
constexpr double kLongest = 0.1;
constexpr double kMaxSpeed = 64.0;
constexpr double kNever = 1e9;

}  // namespace

Player::Player(std::vector<double> times, double speed) : times_(std::move(times)), speed_(speed) {}

std::size_t Player::advance(double seconds) {
    if (is_paused_) return due_;
    now_ += speed_ * std::clamp(seconds, 0.0, kLongest);
    while (due_ < times_.size() && times_[due_] <= now_) ++due_;
    return due_;
}

double Player::wait() const {
    if (is_paused_ || due_ >= times_.size()) return kNever;
    return std::max(times_[due_] - now_, 0.0) / speed_;
}

void Player::step() {
    is_paused_ = true;
    if (due_ >= times_.size()) return;
    now_ = std::max(now_, times_[due_]);
    ++due_;
}

void Player::change_speed(double factor) {
    speed_ = std::clamp(speed_ * factor, 1.0 / kMaxSpeed, kMaxSpeed);
}

PictureFit::PictureFit(const PictureSize& recorded, const PictureSize& now)
    : scale(std::min(now.width / recorded.width, now.height / recorded.height)),
      corner(0.5 * (now.width - scale * recorded.width),
             0.5 * (now.height - scale * recorded.height)) {}

Camera fitted(const Camera& camera, const PictureSize& recorded, const PictureSize& now) {
    const double grown = now.height / (PictureFit(recorded, now).scale * recorded.height);
    CameraOptions options = camera.options();
    options.fov = 2.0 * std::atan(grown * std::tan(0.5 * options.fov));
    if (options.ortho) *options.ortho *= grown;
    return Camera(options);
}

}  // namespace lissom::window
