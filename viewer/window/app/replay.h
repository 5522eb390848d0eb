/// Replay: plays the recording that is open. The hand waits meanwhile, but for the keys that have
/// to do with it.
#pragma once

#include <cstddef>
#include <optional>

#include "viewer/window/app/view_state.h"
#include "viewer/window/session/player.h"

namespace lissom::window {

class Replay {
  public:
    /// Plays at `speed` times a recording's own; `state` must outlive it.
    Replay(ViewState& state, double speed) : state_(state), speed_(speed) {}

    bool plays() const { return player_.has_value(); }
    /// Begins a recording that the session has opened; the hand is to let go.
    void begin(const Playback& playback);
    /// Posts the events that are due once those before them are done, and ends after the last.
    void play();
    void take_key(const Input& input);
    /// Something else is open.
    void forget();
    /// Returns seconds until the next event; nothing at rest.
    std::optional<double> wait() const;

  private:
    void end();

    ViewState& state_;
    double speed_;
    std::optional<Player> player_;
    // Number of events posted, and the time of the last.
    std::size_t posted_ = 0;
    Clock::time_point last_ = Clock::now();
};

}  // namespace lissom::window
