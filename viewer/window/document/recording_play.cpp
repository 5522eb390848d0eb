#include "viewer/window/document/recording_play.h"

#include <utility>

namespace lissom::window {

bool RecordingPlay::open(const std::string& path) {
    recording_ = {};
    return scene_.succeeds(scene_.bench().open_recording(path, recording_));
}

void RecordingPlay::begin(const std::string& path) {
    parts_.playing.events = 0;
    const bool goes_on = !recording_.times.empty();
    parts_.playing.goes_on = goes_on;
    scene_.show_hand(goes_on);
    parts_.news.change([&](SessionNews& news) {
        news.playback = Playback{path, recording_.times};
    });
}

void RecordingPlay::end() {
    parts_.playing.goes_on = false;
    scene_.show_hand(false);
}

void RecordingPlay::play(std::size_t event) {
    const std::size_t count = recording_.times.size();
    if (!parts_.playing.goes_on || event >= count) return;
    PlayedEvent done;
    cli::ScriptResult result = scene_.bench().play(event, done);
    if (!done.difference.empty()) parts_.news.tell(LineKind::error, done.difference);
    if (done.tool) scene_.keep_tool(*done.tool);
    if (result.status != cli::kSuccess) return fail(std::move(result), event);
    parts_.playing.events = event + 1;
    if (event + 1 < count) return;
    parts_.playing.goes_on = false;
    scene_.let_go();
    if (done.differs) return;
    parts_.news.tell(LineKind::result, "played " + std::to_string(count) +
                                           " events, which come to the scene that was recorded");
}

void RecordingPlay::fail(cli::ScriptResult result, std::size_t event) {
    const bool was_stopped = !parts_.playing.goes_on.exchange(false);
    if (was_stopped) result.message = "a step was stopped and taken back";
    result.message = "event " + std::to_string(event + 1) + " of " +
                     std::to_string(recording_.times.size()) + ", " + recording_.kinds[event] +
                     ": " + result.message;
    scene_.succeeds(result);
    // A recording that ends early leaves no button down.
    scene_.let_go();
}

}  // namespace lissom::window
