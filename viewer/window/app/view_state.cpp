#include "viewer/window/app/view_state.h"

#include <iostream>
#include <utility>

namespace lissom::window {

void Changes::add() {
    ++number_;
    last_ = Clock::now();
    owe_frames();
}

View ViewState::view() const {
    const Canvas free = screen->beside_legend(canvas());
    return {camera, {1.0 * free.width, 1.0 * free.height}};
}

ViewUp ViewState::up_axis() const {
    return up.value_or(shown ? shown->picture->framing.up : ViewUp::y);
}

bool ViewState::is_icon() const {
    return window.size().width == 0 || window.size().height == 0;
}

void ViewState::tell(const std::string& text) {
    has_told = true;
    if (tells) std::cout << text << std::endl;
}

void ViewState::add_line(LineKind kind, std::string text) {
    window::add_line(content.lines, {kind, std::move(text)});
    changes.owe_frames();
}

void ViewState::set_camera(const Camera& next) {
    camera = next;
    changes.add();
    tell_camera();
}

void ViewState::tell_camera() {
    if (plays) return;
    ToolInput event;
    event.kind = ToolInput::Kind::look;
    event.camera = camera;
    event.up = up_axis();
    event.size = pixels.size(view().size);
    session.post(event);
}

}  // namespace lissom::window
