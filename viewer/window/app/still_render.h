/// StillRender: the finished picture that is drawn once nothing moves, for the eye and for files.
#pragma once

#include <cstdint>

#include "viewer/window/app/view_state.h"
#include "viewer/window/makers/painter.h"

namespace lissom::window {

class StillRender {
  public:
    /// Draws with `threads` threads; `state` must outlive it.
    StillRender(ViewState& state, int threads);

    /// A person wants it in a file, which is a new one in this folder.
    void want_file();
    /// Takes the finished picture.
    void take();
    /// Draws it if nothing moves and all strands are there.
    void draw(bool at_rest, bool hair_is_filled);
    /// Reports once for each rest that all is done, if nothing else is `busy`.
    void tell_rest(bool at_rest, bool busy);
    /// Returns whether it is still to come.
    bool is_owed() const;
    void stop() { painter_.stop(); }

  private:
    bool is_wanted(bool hair_is_filled) const;

    ViewState& state_;
    Painter painter_;
    // Numbers of the change that was asked for, of the shown one, and of the last rest.
    std::uint64_t asked_ = 0, drawn_ = 0, rested_ = 0;
    // It is wanted in a file; it is drawn for one.
    bool wants_file_ = false, draws_file_ = false;
    bool was_done_ = false;
};

}  // namespace lissom::window
