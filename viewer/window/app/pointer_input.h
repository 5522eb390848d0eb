/// PointerInput: input over the picture: it moves the camera, or goes to the tool in hand.
#pragma once

#include <optional>

#include "viewer/window/app/view_state.h"

namespace lissom::window {

class PointerInput {
  public:
    /// `state` must outlive it.
    explicit PointerInput(ViewState& state) : state_(state) {}

    /// Takes an input of the mouse, in pixels from the top left corner of the picture.
    void take(const Input& input);
    /// Takes a key that is the tool's.
    void press_tool_key(const Input& input);
    /// Tells the tool in hand how much time went by since the last call, while it has a drag, if it
    /// wants to know. Returns whether it does.
    bool tick(double seconds);
    /// Forgets the drag that goes on.
    void let_go();
    /// Returns whether a button is down that was pressed over the picture.
    bool drags() const { return dragged_ || tool_drags_; }
    bool tool_drags() const { return tool_drags_; }

  private:
    void navigate(const Input& input);
    bool give_to_tool(const Input& input);

    ViewState& state_;
    // The button that moves the camera, and the last place of the cursor.
    std::optional<MouseButton> dragged_;
    Vec2 cursor_ = Vec2::Zero();
    // The tool has the drag.
    bool tool_drags_ = false;
};

}  // namespace lissom::window
