/// PanelInput: input on its way to Dear ImGui, in its order.
#pragma once

#include <deque>

#include "viewer/window/screen/input.h"

namespace lissom::window {

class PanelInput {
  public:
    void feed(const Input& input) { inputs_.push_back(input); }
    /// Gives a frame its input: a press and a release are never taken at once.
    void take();
    /// Asks for one frame more.
    void owe();
    /// Returns whether input is left, or a frame is owed.
    bool owes_frame() const { return !inputs_.empty() || frames_owed_ > 0; }

  private:
    std::deque<Input> inputs_;
    // Frames after one that took input: lists open in the second.
    int frames_owed_ = 0;
};

}  // namespace lissom::window
