/// Player: when the events of a recording are due.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/sketch/camera.h"

namespace lissom::window {

class Player {
  public:
    /// Plays events at `times`, in seconds and not decreasing, `speed` times as fast.
    Player(std::vector<double> times, double speed);

    /// `seconds` have passed: the number of events that are due by now. The recording's own time
    /// goes on by a tenth of a second times its speed at most, so that a machine slower than the
    /// recording shows it slowed down, and never has much of it waiting.
    std::size_t advance(double seconds);
    /// Returns seconds until the next event is due, if nothing is slower; a large number if there
    /// is none.
    double wait() const;

    void pause_or_go_on() { is_paused_ = !is_paused_; }
    /// Pauses, and makes the next event due.
    void step();
    /// Multiplies the speed, which stays between 1/64 and 64 times the recording's own.
    void change_speed(double factor);

    bool is_paused() const { return is_paused_; }
    double speed() const { return speed_; }
    std::size_t count() const { return times_.size(); }

  private:
    std::vector<double> times_;
    double speed_, now_ = 0.0;
    std::size_t due_ = 0;
    bool is_paused_ = false;
};

/// Place of a recorded picture in another: as large as fits, in the middle.
struct PictureFit {
    double scale = 1.0;
    Vec2 corner = Vec2::Zero();

    PictureFit() = default;
    PictureFit(const PictureSize& recorded, const PictureSize& now);

    Vec2 operator()(const Vec2& pixel) const { return corner + scale * pixel; }
};

/// Returns the camera that shows in a picture of size `now` the view of `camera` in a `recorded`
/// one, and its surroundings.
Camera fitted(const Camera& camera, const PictureSize& recorded, const PictureSize& now);

}  // namespace lissom::window
