/// HairFill: the strands of the shown picture: made beside the window, and drawn one slice after
/// the other once nothing moves.
#pragma once

#include <cstdint>

#include "viewer/window/app/view_state.h"
#include "viewer/window/makers/hair_maker.h"

namespace lissom::window {

class HairFill {
  public:
    /// Makes strands with `threads` threads; `state` must outlive it.
    HairFill(ViewState& state, int threads);

    /// `snapshot` is on the graphics card now.
    void begin(const Snapshot& snapshot) { maker_.make(snapshot); }
    /// All of it is gone from there.
    void forget() { maker_.forget(); }
    /// Takes the finished hair.
    void take();
    /// Draws a slice if nothing moves; look for events before the next.
    void fill(bool at_rest);
    /// Returns whether nothing is left to be drawn.
    bool is_filled() const;

  private:
    void take_made();
    void take_directed();

    ViewState& state_;
    HairMaker maker_;
    // Numbers of the change that light in hair was asked for, and that all strands are drawn for.
    std::uint64_t directed_ = 0, filled_ = 0;
};

}  // namespace lissom::window
