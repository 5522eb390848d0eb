#include "viewer/window/app/pointer_input.h"

#include <algorithm>
#include <cmath>

#include "kernel/sketch/navigation.h"

namespace lissom::window {
namespace {

// Zoom of a line of the wheel.
constexpr double kZoomStep = 1.15;
// Longest tick: a window that stood still does not make tools jump.
constexpr double kMostTick = 0.1;

}  // namespace

void PointerInput::take(const Input& input) {
    if (!give_to_tool(input)) navigate(input);
}

void PointerInput::let_go() {
    dragged_.reset();
    tool_drags_ = false;
}

void PointerInput::navigate(const Input& input) {
    switch (input.kind) {
        case Input::Kind::press:
            dragged_ = input.modifiers.shift ? MouseButton::middle : input.button;
            break;
        case Input::Kind::release:
            dragged_.reset();
            break;
        case Input::Kind::move: {
            const Vec2 drag = input.at - cursor_;
            if (dragged_ && drag != Vec2::Zero()) {
                const bool turns = *dragged_ == MouseButton::left ||
                                   (state_.has_tool() && *dragged_ == MouseButton::right);
                const View view = state_.view();
                state_.set_camera(turns ? orbited(view, drag) : panned(view, drag));
            }
            break;
        }
        case Input::Kind::scroll: {
            const auto& shown = state_.shown;
            const double size =
                shown && !shown->bounds.empty() ? std::max(shown->bounds.diagonal(), 1e-9) : 1.0;
            const double nearer = std::pow(kZoomStep, input.scroll.y());
            state_.set_camera(zoomed(state_.view(), input.at, nearer, size));
            break;
        }
        default:
            break;
    }
    cursor_ = input.at;
}

// With a tool in hand the left button is the tool's, but with alt, and the wheel while that is
// down or with ctrl; the others move the camera.
bool PointerInput::give_to_tool(const Input& input) {
    ToolInput event;
    event.at = state_.pixels.at(input.at);
    event.modifiers = input.modifiers;
    const bool is_press = input.kind == Input::Kind::press;
    if (is_press && drags()) return tool_drags_;
    if (is_press) {
        tool_drags_ =
            state_.has_tool() && input.button == MouseButton::left && !input.modifiers.alt;
    }
    const bool tools_wheel = input.kind == Input::Kind::scroll && input.modifiers.ctrl;
    const bool own = tool_drags_ || (state_.has_tool() && !dragged_ &&
                                     (input.kind == Input::Kind::move || tools_wheel));
    if (!own) return false;
    cursor_ = input.at;
    switch (input.kind) {
        case Input::Kind::press:
            event.kind = ToolInput::Kind::press;
            break;
        case Input::Kind::move:
            event.kind = ToolInput::Kind::move;
            break;
        case Input::Kind::release:
            if (input.button != MouseButton::left) return true;
            event.kind = ToolInput::Kind::release;
            tool_drags_ = false;
            break;
        case Input::Kind::scroll:
            // With shift some systems turn the wheel sideways.
            event.kind = ToolInput::Kind::wheel;
            event.lines = input.scroll.y() != 0.0 ? input.scroll.y() : input.scroll.x();
            break;
        default:
            return tool_drags_;
    }
    state_.session.post(event);
    return true;
}

bool PointerInput::tick(double seconds) {
    if (!tool_drags_ || !state_.content.tool.ticks) return false;
    ToolInput event;
    event.kind = ToolInput::Kind::tick;
    // A session that is busy hears of the time later, all at once.
    event.seconds = std::min(seconds, kMostTick);
    state_.session.post(event);
    return true;
}

void PointerInput::press_tool_key(const Input& input) {
    ToolInput event;
    event.kind = ToolInput::Kind::key;
    event.modifiers = input.modifiers;
    if (input.kind == Input::Kind::key_down && input.key == Key::escape) {
        event.kind = ToolInput::Kind::cancel;
        tool_drags_ = false;
        return state_.session.post(event);
    }
    const bool types = input.kind == Input::Kind::text;
    const bool is_named = input.kind == Input::Kind::key_down && input.key != Key::character;
    if (!types && !is_named) return;
    event.key = tool_key(input);
    if (!event.key.empty()) state_.session.post(event);
}

}  // namespace lissom::window
