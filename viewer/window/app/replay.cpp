#include "viewer/window/app/replay.h"

#include <filesystem>
#include <utility>

namespace lissom::window {

void Replay::begin(const Playback& playback) {
    const std::size_t count = playback.times.size();
    state_.content.playing = {.name = std::filesystem::path(playback.path).filename().string(),
                              .count = count};
    state_.tell("playing " + std::to_string(count));
    player_.emplace(playback.times, speed_);
    state_.plays = true;
    posted_ = 0;
    last_ = Clock::now();
}

void Replay::forget() {
    player_.reset();
    state_.plays = false;
    state_.content.playing.reset();
}

// Tools see the hand's camera again.
void Replay::end() {
    forget();
    state_.changes.owe_frames();
    state_.tell("played");
    state_.tell_camera();
}

void Replay::play() {
    if (!player_) return;
    if (!state_.session.is_playing()) return end();
    if (state_.session.events_played() < posted_) return;
    const std::size_t due = player_->advance(seconds_since(std::exchange(last_, Clock::now())));
    for (; posted_ < due; ++posted_) {
        ToolInput event;
        event.kind = ToolInput::Kind::play;
        event.event = posted_;
        state_.session.post(std::move(event));
    }
    state_.content.playing->done = state_.session.events_played();
    state_.content.playing->speed = player_->speed();
    state_.content.playing->is_paused = player_->is_paused();
}

void Replay::take_key(const Input& input) {
    if (input.kind == Input::Kind::text && input.character == U'.') player_->step();
    if (input.kind == Input::Kind::text && input.character == U'+') player_->change_speed(2.0);
    if (input.kind == Input::Kind::text && input.character == U'-') player_->change_speed(0.5);
    if (input.kind != Input::Kind::key_down) return;
    if (input.key == Key::space) player_->pause_or_go_on();
    if (input.key != Key::escape) return;
    state_.add_line(LineKind::message, "stopped after event " +
                                           std::to_string(state_.session.events_played()) + " of " +
                                           std::to_string(player_->count()));
    state_.session.stop_playing();
}

std::optional<double> Replay::wait() const {
    if (!player_ || player_->is_paused()) return std::nullopt;
    return player_->wait();
}

}  // namespace lissom::window
