#include "viewer/window/app/frames.h"

#include <utility>

namespace lissom::window {
namespace {

// A frame that takes longer is drawn at half the size from then on.
constexpr double kSlowFrame = 0.05;
// Seconds between two times of a frame that the panel shows.
constexpr double kMeasureEvery = 1.0;
// Frames in which the driver makes its programs ready: they are not measured.
constexpr int kFirstFrames = 3;

}  // namespace

void update_legend(ViewState& state) {
    const Canvas canvas = state.canvas();
    const Canvas before = state.screen->beside_legend(canvas);
    state.screen->set_legend(shown_legend(*state.shown->picture, state.settings), canvas.height,
                             background_of(state.settings));
    if (!(state.screen->beside_legend(canvas) == before)) state.tell_camera();
}

template <typename Calls>
void Frames::drawing(const Calls& calls) {
    const auto start = Clock::now();
    const double work = thread_seconds();
    calls();
    drawing_.seconds += seconds_since(start);
    drawing_.busy += thread_seconds() - work;
}

void Frames::end_turn(double all, double busy) {
    if (count_ <= kFirstFrames) return;
    times_.add_turn(all, {all - drawing_.seconds, busy - drawing_.busy});
}

bool Frames::has_to_show() const {
    const bool other_size = !(state_.window.size() == shown_size_);
    return !state_.is_icon() && (state_.window.is_exposed() || other_size);
}

// Any change of settings needs a new picture.
void Frames::see_settings() {
    if (settings_ == state_.settings) return;
    settings_ = state_.settings;
    state_.changes.add();
}

void Frames::draw_picture() {
    const bool other_settings = upload_.has_other_settings();
    upload_.send();
    const Canvas canvas = state_.canvas();
    const bool resized = !(canvas == drawn_canvas_);
    if (state_.shown && (resized || other_settings)) update_legend(state_);
    if (state_.changes.is_drawn() && !resized) return;
    if (resized) {
        state_.changes.add_size();
        state_.tell_camera();
    }
    drawing([&] {
        state_.screen->draw(state_.camera, canvas, background_of(state_.settings), coarseness_);
    });
    state_.changes.set_drawn();
    drawn_canvas_ = canvas;
}

// Shows the parts that differ from the window's, if any does.
void Frames::show() {
    const gl::Extent size = state_.window.size();
    const bool all = !state_.window.has_picture() || !(size == shown_size_);
    const DrawnLists& lists = state_.panel.lists();
    const bool beside = all || lists.beside_differs();
    const bool picture =
        beside || lists.over_differs() || state_.screen->version() != shown_version_;
    shown_size_ = size;
    if (!picture) return;
    shown_version_ = state_.screen->version();
    drawing([&] {
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glViewport(0, 0, size.width, size.height);
        state_.screen->show(state_.canvas(), size.height);
        state_.panel.draw(beside ? PanelPart::all : PanelPart::over_picture);
        state_.window.show();
        glFinish();
    });
}

PanelAnswers Frames::draw() {
    state_.changes.begin_frame();
    if (state_.is_icon()) return {};
    const auto start = Clock::now();
    const std::uint64_t before = state_.changes.drawn();
    see_settings();
    try {
        draw_picture();
    } catch (const Error& error) {
        upload_.give_up(error);
    }
    PanelContent& content = state_.content;
    content.is_ortho = state_.camera.is_ortho();
    content.is_z_up = state_.up_axis() == ViewUp::z;
    content.camera = state_.camera;
    content.picture_size = state_.view().size;
    PanelAnswers answers = state_.panel.make(content, state_.settings, state_.window.size(),
                                             seconds_since(std::exchange(last_, Clock::now())));
    show();
    if (count_++ == 0) state_.tell("first frame");
    if (state_.changes.drawn() != before) measure(seconds_since(start));
    see_settings();
    return answers;
}

// A number that changes with every frame would have the panel drawn with every frame.
void Frames::measure(double seconds) {
    times_.add_frame(Clock::now());
    if (seconds > kSlowFrame) coarseness_ = 2;
    if (seconds_since(last_measure_) < kMeasureEvery) return;
    last_measure_ = Clock::now();
    state_.content.milliseconds = 1e3 * seconds;
}

}  // namespace lissom::window
