/// Frames: draws the picture where it has changed, and shows what differs in the window.
#pragma once

#include <cstdint>
#include <string>

#include "viewer/window/app/stage.h"
#include "viewer/window/app/view_state.h"
#include "viewer/window/screen/frame_times.h"

namespace lissom::window {

/// Legend, canvas and tools learn how wide the picture is beside it.
void update_legend(ViewState& state);

class Frames {
  public:
    /// Both must outlive it.
    Frames(ViewState& state, Stage& stage) : state_(state), stage_(stage) {}

    /// Whether all of the window has to be shown again.
    bool has_to_show() const;
    /// The next frame; what a person has asked for in the panel. Nothing in an icon.
    PanelAnswers draw();
    /// The graphics card has lost all.
    void forget() { drawn_canvas_ = {}; }

    // ---- Times, see FrameTimes

    /// A turn of the program begins.
    void begin_turn() { drawing_ = {}; }
    /// It took `all` seconds, in which this thread had a processor for `busy`.
    void end_turn(double all, double busy);
    void add_event(Clock::time_point time) { times_.add_event(time); }
    void end_event() { times_.end_event(); }
    std::string times() const { return times_.text(); }

  private:
    template <typename Calls>
    void drawing(const Calls& calls);
    void see_settings();
    void draw_picture();
    void show();
    void measure(double seconds);

    ViewState& state_;
    Stage& stage_;
    // The picture is so many times smaller than what it is shown on.
    int coarseness_ = 1;
    Canvas drawn_canvas_;
    // Of the last frame.
    DisplaySettings settings_;
    // What is in the window.
    gl::Extent shown_size_ = {};
    std::uint64_t shown_version_ = 0;
    Clock::time_point last_ = Clock::now(), last_measure_ = {};
    int count_ = 0;
    FrameTimes times_;
    // This turn's calls that draw.
    Turn drawing_;
};

}  // namespace lissom::window
