#include "viewer/window/app/still_render.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

namespace lissom::window {
namespace {

// Returns the path of a new file beside existing ones.
std::string new_picture_path() {
    std::error_code error;
    for (int number = 1;; ++number) {
        std::string path = "lissom-" + std::to_string(number) + ".png";
        if (!std::filesystem::exists(path, error)) return path;
    }
}

}  // namespace

StillRender::StillRender(ViewState& state, int threads)
    : state_(state), painter_(threads, [] { GlfwWindow::wake(); }) {}

// It may take a while to come.
void StillRender::want_file() {
    wants_file_ = true;
    state_.content.draws_picture = true;
    state_.tell("taking a picture");
    state_.add_line(LineKind::message,
                    state_.shown ? "the picture is saved as soon as it is finished"
                                 : "a picture is saved as soon as there is something to see");
}

void StillRender::take() {
    const auto result = painter_.take();
    if (!result || result->number != state_.changes.number()) return;
    drawn_ = result->number;
    draws_file_ = false;
    state_.content.draws_picture = wants_file_;
    if (result->error.empty()) {
        state_.screen->take(result->image);
    } else {
        state_.add_line(LineKind::error, result->error);
        state_.settings.sharp = false;
    }
    if (result->error.empty() && !result->path.empty()) {
        state_.add_line(LineKind::result, "saved " + result->path);
        state_.tell("picture " + result->path);
    }
    state_.changes.set_drawn();
    state_.changes.owe_frames();
}

bool StillRender::is_owed() const {
    return drawn_ != state_.changes.number() && state_.settings.sharp;
}

bool StillRender::is_wanted(bool hair_is_filled) const {
    return state_.shown && ((state_.settings.sharp && hair_is_filled) || wants_file_);
}

void StillRender::draw(bool at_rest, bool hair_is_filled) {
    const std::uint64_t now = state_.changes.number();
    if (!at_rest) {
        if (asked_ == now) return;
        painter_.stop();
        // The picture drawn for a file is out of date.
        wants_file_ = wants_file_ || std::exchange(draws_file_, false);
        return;
    }
    if (!is_wanted(hair_is_filled) || (asked_ == now && !wants_file_)) return;
    const Canvas canvas = state_.canvas();
    draws_file_ = std::exchange(wants_file_, false);
    painter_.draw(
        std::make_shared<const Picture>(displayed(*state_.shown->picture, state_.settings,
                                                  state_.camera, canvas.width, canvas.height)),
        now, draws_file_ ? new_picture_path() : "");
    asked_ = now;
    drawn_ = 0;
}

void StillRender::tell_rest(bool at_rest, bool busy) {
    const std::uint64_t now = state_.changes.number();
    const bool done = at_rest && !busy && !draws_file_ && (!is_wanted(true) || drawn_ == now);
    if (done && !was_done_ && (state_.has_told || rested_ != now)) {
        state_.tell("at rest");
        state_.has_told = false;
        rested_ = now;
    }
    was_done_ = done;
}

}  // namespace lissom::window
