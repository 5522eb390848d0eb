/// Frames: draws the picture if it has changed, and shows its differing parts in the window.
#pragma once

#include <cstdint>
#include <string>

#include "viewer/window/app/scene_upload.h"
#include "viewer/window/app/view_state.h"
#include "viewer/window/screen/frame_times.h"

namespace lissom::window {

/// Legend, canvas and tools learn how wide the picture is beside it.
void update_legend(ViewState& state);

class Frames {
  public:
    /// Both must outlive it.
    Frames(ViewState& state, SceneUpload& stage) : state_(state), upload_(stage) {}

    /// Returns whether all of the window has to be shown again.
    bool has_to_show() const;
    /// Draws the next frame and returns the answers of the panel. Nothing in an icon.
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
    SceneUpload& upload_;
    // Factor by which the picture is smaller than its canvas.
    int coarseness_ = 1;
    Canvas drawn_canvas_;
    // Settings of the last frame.
    DisplaySettings settings_;
    // Size of the window's picture.
    gl::Extent shown_size_ = {};
    std::uint64_t shown_version_ = 0;
    Clock::time_point last_ = Clock::now(), last_measure_ = {};
    int count_ = 0;
    FrameTimes times_;
    // This turn's calls that draw.
    Turn drawing_;
};

}  // namespace lissom::window
