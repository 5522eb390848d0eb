#include "viewer/window/app/scene_upload.h"

#include <utility>
#include <vector>

namespace lissom::window {
namespace {

// Meshes with more corners are made ready beside the window. Vertices that move fast cost a part of
// others.
constexpr Index kManyCorners = 60000, kQuickPart = 8;
// Seconds of one turn for sending finished pieces.
constexpr double kSendAim = 0.01;

// Corners that there is work for.
Index work_for(const std::vector<SurfaceNeeds>& needs) {
    Index work = 0;
    for (const SurfaceNeeds& one : needs) {
        const Index corners = one.drawn.mesh->topology().corner_count();
        work += one.groups && !one.colors ? corners / kQuickPart : corners;
    }
    return work;
}

}  // namespace

SceneUpload::SceneUpload(ViewState& state, HairFill& hair, int threads)
    : state_(state), hair_(hair), maker_(threads, [] { GlfwWindow::wake(); }) {}

bool SceneUpload::is_sent() const {
    const auto& shown = state_.shown;
    return !shown || (sent_ == shown->picture && sent_settings_ == state_.settings);
}

void SceneUpload::forget_preparing() {
    preparing_.reset();
    sender_.reset();
    pieces_left_ = false;
}

void SceneUpload::forget() {
    forget_preparing();
    sent_.reset();
    hair_.forget();
}

void SceneUpload::take() {
    auto made = maker_.take();
    if (!made) return;
    prepared_ = std::move(made);
    state_.changes.add();
}

void SceneUpload::send(const Sent& sent, std::span<const PreparedSurface> prepared) {
    state_.screen->update(sent.snapshot, prepared);
    hair_.begin(sent.snapshot);
    sent_ = sent.picture;
    sent_settings_ = sent.settings;
}

void SceneUpload::send_pieces() {
    if (!pieces_left_) return;
    const auto start = Clock::now();
    try {
        while (pieces_left_ && seconds_since(start) < kSendAim) pieces_left_ = sender_->send();
    } catch (const Error& error) {
        give_up(error);
    }
    if (!pieces_left_) state_.changes.add();
}

void SceneUpload::give_up(const Error& error) {
    state_.add_line(LineKind::error, error.message());
    state_.tell("error " + error.message());
    forget_preparing();
    state_.shown.reset();
}

void SceneUpload::begin_sending() {
    auto ready = std::exchange(prepared_, std::nullopt);
    if (!preparing_ || !ready || ready->number != preparations_) return;
    if (!ready->error.empty()) {
        preparing_.reset();
        throw Error(ErrorCode::internal, ready->error);
    }
    sender_.emplace(std::move(ready->surfaces));
    pieces_left_ = true;
}

// Returns false if there is more to wait for.
bool SceneUpload::end_sending() {
    if (!sender_ || pieces_left_) return false;
    const Sent sent = *std::exchange(preparing_, std::nullopt);
    send(sent, sender_->surfaces());
    maker_.end(sender_->give_away());
    sender_.reset();
    return true;
}

// Some of many that follow each other are shown.
void SceneUpload::send() {
    if (is_sent()) return forget_preparing();
    begin_sending();
    if (preparing_ && !end_sending()) return;
    if (is_sent()) return;
    const auto& picture = state_.shown->picture;
    Sent next{quick_snapshot(*picture, state_.settings), picture, state_.settings};
    std::vector<SurfaceNeeds> needs = state_.screen->needs(next.snapshot);
    if (work_for(needs) <= kManyCorners) return send(next, {});
    preparing_ = std::move(next);
    maker_.make(std::move(needs), ++preparations_);
}

}  // namespace lissom::window
