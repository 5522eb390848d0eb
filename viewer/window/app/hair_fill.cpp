#include "viewer/window/app/hair_fill.h"

#include <string>

#include "kernel/core/error.h"
#include "viewer/render/draw/projection.h"

namespace lissom::window {
namespace {

// Limits in seconds of a picture of strands if a finished one follows, and if none does.
constexpr double kLongFill = 3.0, kLongestFill = 60.0;

}  // namespace

HairFill::HairFill(ViewState& state, int threads)
    : state_(state), maker_(threads, [] { GlfwWindow::wake(); }) {}

bool HairFill::is_filled() const {
    if (maker_.busy()) return false;
    const Screen& screen = *state_.screen;
    return screen.hair().empty() || (filled_ == state_.changes.number() && !screen.filling());
}

void HairFill::take() {
    take_made();
    take_directed();
}

void HairFill::take_made() {
    auto made = maker_.take();
    if (!made) return;
    std::string wrong = made->error;
    try {
        state_.screen->set_hair(made->hair);
    } catch (const Error& error) {
        wrong = error.message();
        state_.screen->set_hair({});
    }
    if (!wrong.empty()) state_.add_line(LineKind::error, wrong);
    state_.changes.add();
}

void HairFill::take_directed() {
    auto directed = maker_.take_directed();
    if (!directed || directed->number != state_.changes.number()) return;
    if (directed->light != state_.screen->hair().light()) return;
    state_.screen->direct_light(directed->bytes);
    state_.screen->begin_fill(state_.camera, state_.canvas(), background_of(state_.settings),
                              state_.settings.sharp ? kLongFill : kLongestFill);
    filled_ = state_.changes.number();
}

void HairFill::fill(bool at_rest) {
    const std::uint64_t now = state_.changes.number();
    Screen& screen = *state_.screen;
    if (!at_rest) {
        if (directed_ != now) maker_.stop_directing();
        return;
    }
    if (filled_ == now) {
        if (!screen.fill()) return;
        state_.tell("filled");
        state_.changes.owe_frames();
        return;
    }
    const bool ready = !screen.hair().empty() && !maker_.busy() && state_.changes.is_drawn();
    if (!ready || directed_ == now) return;
    const Mat4 turn = view_matrix(state_.camera, Vec3::Zero());
    maker_.direct(screen.hair().light(), turn.topLeftCorner<3, 3>(), now);
    directed_ = now;
}

}  // namespace lissom::window
