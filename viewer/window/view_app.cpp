#include "viewer/window/view_app.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <thread>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/sketch/navigation.h"
#include "viewer/draw/projection.h"
#include "viewer/window/makers/colorer.h"
#include "viewer/window/makers/hair_maker.h"
#include "viewer/window/makers/painter.h"
#include "viewer/window/makers/surface_maker.h"
#include "viewer/window/panel/panel.h"
#include "viewer/window/screen/display.h"
#include "viewer/window/screen/frame_times.h"
#include "viewer/window/screen/glfw_window.h"
#include "viewer/window/screen/screen.h"
#include "viewer/window/session/file_watch.h"
#include "viewer/window/session/player.h"
#include "viewer/window/session/presets.h"
#include "viewer/window/session/recovery.h"
#include "viewer/window/session/session.h"

namespace lissom::window {
namespace {

// Seconds without a change after which a finished picture is drawn.
constexpr double kRest = 0.15;
// Seconds that a picture of strands may take where a finished one follows, and where none does.
constexpr double kLongFill = 3.0, kLongestFill = 60.0;
// Seconds that a parameter stays as it is before the script runs again.
constexpr double kParameterRest = 0.08;
// A frame that takes longer is drawn at half the size from then on.
constexpr double kSlowFrame = 0.05;
// Seconds between two copies of a scene.
constexpr double kCopyEvery = 1.0;
// Frames in which the driver makes its programs ready: they are not measured.
constexpr int kFirstFrames = 3;
// Meshes with more corners are made ready for the graphics card beside the window. Vertices that
// move fast cost a part of others.
constexpr Index kManyCorners = 60000, kQuickPart = 8;
// Seconds of one turn in which pieces of what is ready are sent.
constexpr double kSendAim = 0.01;
// Of a line of the wheel.
constexpr double kZoomStep = 1.15;

constexpr const char* kWelcome =
    "Drop meshes, a script or a scene here, or name them on the command line.";

std::string text_of(const lua::ParameterValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.17g", std::get<double>(value));
    return buffer;
}

// The command line that gives the script these values; what has its default is left to the script,
// whose next version may have another.
std::vector<std::string> words_of(const std::vector<lua::ScriptParameter>& parameters) {
    std::vector<std::string> words;
    for (const lua::ScriptParameter& p : parameters) {
        if (p.value && p.value != p.default_value)
            words.push_back("--" + p.name + "=" + text_of(*p.value));
    }
    return words;
}

// Of the selected vertices of all meshes, in the world.
Box selected_bounds(const Picture& picture) {
    Box box;
    for (const DrawnMesh& drawn : picture.meshes) {
        if (!drawn.style.region) continue;
        for (const Index v : drawn.style.region->vertices()) {
            box.extend(drawn.transform(drawn.mesh->position(v)));
        }
    }
    return box;
}

// A file beside those that are there.
std::string new_picture_path() {
    std::error_code error;
    for (int number = 1;; ++number) {
        std::string path = "lissom-" + std::to_string(number) + ".png";
        if (!std::filesystem::exists(path, error)) return path;
    }
}

// Corners that there is work for.
Index work_for(const std::vector<SurfaceNeeds>& needs) {
    Index work = 0;
    for (const SurfaceNeeds& one : needs) {
        const Index corners = one.drawn.mesh->topology().corner_count();
        work += one.groups && !one.colors ? corners / kQuickPart : corners;
    }
    return work;
}

std::string mesh_label(const DrawnMesh& drawn, const std::string& name) {
    return name + "  (" + std::to_string(drawn.mesh->face_count()) + " faces)";
}

class ViewApp {
  public:
    ViewApp(cli::Program& program, const ViewOptions& options)
        : options_(options),
          window_("lissom", {options.width, options.height}),
          panel_(window_),
          session_(
              program, [] { GlfwWindow::wake(); }, options.session),
          painter_(threads_of(program), [] { GlfwWindow::wake(); }),
          hair_maker_(threads_of(program), [] { GlfwWindow::wake(); }),
          surface_maker_(threads_of(program), [] { GlfwWindow::wake(); }),
          colorer_([] { GlfwWindow::wake(); }) {
        if (options_.tells) {
            window_.listen_to_driver([this](const std::string& text) { tell("driver " + text); });
        }
        content_.driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        if (options.words.empty()) content_.lines.push_back({LineKind::message, kWelcome});
        content_.tools = shipped_tools();
        offer_recovery();
        if (!options.words.empty()) open(options.words);
    }

    int run();

  private:
    static int threads_of(const cli::Program& program) {
        if (program.threads > 0) return program.threads;
        return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    }

    void open(const std::vector<std::string>& words);
    double wait_time() const;
    void take_inputs();
    void take(const Input& input);
    void navigate(const Input& input);
    bool give_to_tool(const Input& input);
    void play();
    void start_playing(Playback playback);
    void end_playing();
    void take_while_playing(const Input& input);
    void tell_camera();
    void press_tool_key(const Input& input);
    void answer_tool(const ToolAnswers& answers);
    void take_tool_state(ToolState state);
    bool has_tool() const { return !content_.tool.tool.empty(); }
    void press_key(const Input& input);
    bool press_anywhere(const Input& input);
    void copy_scene();
    std::string scene_path() const;
    void save();
    void keep_unsaved();
    void keep_replaced();
    void offer_recovery();
    void answer_left(const PanelAnswers& answers);
    void take_results();
    void show(Shown shown);
    void update_legend();
    void take_parameters(std::vector<lua::ScriptParameter> declared);
    void watch_files();
    void answer(const PanelAnswers& answers);
    void answer_presets(const PanelAnswers& answers);
    void list_presets();
    void open_editor(const SourcePlace& place);
    void run_with_parameters();
    void frame();
    template <typename Calls>
    void drawing(const Calls& calls) {
        const auto start = Clock::now();
        const double work = thread_seconds();
        calls();
        drawing_.seconds += seconds_since(start);
        drawing_.busy += thread_seconds() - work;
    }
    void draw_scene();
    void send_scene();
    void send_pieces();
    void give_up(const Error& error);
    void forget_preparing() {
        preparing_.reset();
        sender_.reset();
        pieces_left_ = false;
    }
    struct Sent;
    void send(const Sent& sent, std::span<const PreparedSurface> prepared);
    void make_again();
    bool at_rest() const {
        return is_sent() && seconds_since(last_change_) > kRest && !dragged_ && !tool_drags_ &&
               frames_owed_ == 0;
    }
    bool is_sent() const {
        return !shown_ || (uploaded_ == shown_->picture && uploaded_settings_ == settings_);
    }
    void take_hair();
    void fill_hair();
    bool hair_is_filled() const {
        if (hair_maker_.busy()) return false;
        return screen_->hair().empty() || (filled_ == change_ && !screen_->filling());
    }
    void ask_for_sharp();
    void tell(const std::string& text) {
        told_since_rest_ = true;
        if (options_.tells) std::cout << text << std::endl;
    }
    // Once for each rest after something was seen to happen.
    void tell_rest() {
        if (!told_since_rest_ && rested_ == change_) return;
        tell("at rest");
        told_since_rest_ = false;
        rested_ = change_;
    }
    View view() const {
        const Canvas canvas = screen_->beside_legend(panel_.canvas(window_.size()));
        return {camera_, {1.0 * canvas.width, 1.0 * canvas.height}};
    }
    void moved() {
        ++change_;
        last_change_ = Clock::now();
        frames_owed_ = 2;
    }
    void set_camera(const Camera& camera) {
        camera_ = camera;
        moved();
        tell_camera();
    }
    void frame_inside(const Box& box) {
        if (!box.empty()) set_camera(framed(view(), box));
    }
    void frame_all() {
        if (shown_) frame_inside(shown_->bounds);
    }
    void frame_selection();
    void look_from(StandardView side);

    ViewOptions options_;
    GlfwWindow window_;
    Panel panel_;
    std::optional<Screen> screen_{std::in_place};
    Session session_;
    Painter painter_;
    HairMaker hair_maker_;
    SurfaceMaker surface_maker_;
    Colorer colorer_;
    FileWatch watch_, tool_watch_;
    Presets presets_;
    StartedPrograms programs_;
    PanelContent content_;
    DisplaySettings settings_;
    std::optional<Shown> shown_;
    Camera camera_;
    bool camera_is_placed_ = false;

    // Of the drag that goes on: which button, and where the cursor was last.
    std::optional<MouseButton> dragged_;
    Recovery recovery_{state_folder()};
    // Numbers of the last change of the scene, of the one in the recovery, and of the saved one.
    std::uint64_t scene_change_ = 0, copied_change_ = 0, saved_change_ = 0;
    Clock::time_point last_copy_ = Clock::now();
    std::string saved_path_;
    // The tool has the drag.
    bool tool_drags_ = false;
    // The recording that is played, how many of its events were posted, and when that was.
    std::optional<Player> player_;
    std::size_t posted_ = 0;
    Clock::time_point last_play_ = Clock::now();
    Vec2 cursor_ = Vec2::Zero();

    // Number of the last change of what is seen, and of the change that a finished picture shows.
    std::uint64_t change_ = 1, asked_ = 0, sharp_ = 0, drawn_ = 0;
    // Of the change that light in hair was asked for, and that all strands are drawn for.
    std::uint64_t directed_ = 0, filled_ = 0;
    // What is on the graphics card, and what is made ready for it.
    struct Sent {
        Snapshot snapshot;
        std::shared_ptr<const Picture> picture;
        DisplaySettings settings;
    };
    std::optional<Sent> preparing_;
    std::optional<SurfaceMaker::Result> prepared_;
    std::optional<PieceSender> sender_;
    bool pieces_left_ = false;
    std::uint64_t preparations_ = 0;
    std::shared_ptr<const Picture> uploaded_;
    DisplaySettings uploaded_settings_;
    Canvas drawn_canvas_;
    Clock::time_point last_change_ = Clock::now(), last_frame_ = Clock::now();
    std::optional<Clock::time_point> parameters_changed_;
    int frames_owed_ = 2;
    int coarseness_ = 1;
    bool wants_picture_ = false;
    bool closes_ = false;
    bool was_at_rest_ = false, told_since_rest_ = true;
    std::uint64_t rested_ = 0;
    FrameTimes times_;
    int frames_ = 0;
    // Of the window in the last frame.
    gl::Extent framed_size_ = {};
    // This turn's calls that draw, and when its input came at the earliest.
    Turn drawing_;
    Clock::time_point heard_ = Clock::now();
};

void ViewApp::open(const std::vector<std::string>& words) {
    options_.words = words;
    player_.reset();
    content_.playing.reset();
    saved_path_.clear();
    session_.open(words);
    presets_ = Presets(is_script(words.front()) ? words.front() : "");
    list_presets();
    camera_is_placed_ = false;
    window_.set_title(std::filesystem::path(words.front()).filename().string() + " - lissom");
}

int ViewApp::run() {
    while (!window_.close_requested() && !closes_) {
        const auto before = Clock::now();
        const double most = wait_time();
        window_.wait(most);
        const auto start = Clock::now();
        const double work = thread_seconds();
        drawing_ = {};
        // Without waiting an event may have come at any time since the last look.
        heard_ = most > 0.0 ? start : before;
        // Without input, too.
        if (!(window_.size() == framed_size_)) frames_owed_ = 2;
        take_inputs();
        take_results();
        play();
        watch_files();
        run_with_parameters();
        copy_scene();
        send_pieces();
        if (frames_owed_ > 0 || panel_.owes_frame() || session_.busy()) frame();
        fill_hair();
        ask_for_sharp();
        const double all = seconds_since(start);
        // The driver makes its programs ready in the first frames.
        if (frames_ <= kFirstFrames) continue;
        times_.add_turn(all, {all - drawing_.seconds, thread_seconds() - work - drawing_.busy});
    }
    tell(times_.text());
    painter_.stop();
    keep_unsaved();
    if (!session_.finish(1.0)) {
        std::cerr << "lissom: the script did not stop when the window was closed" << std::endl;
        std::_Exit(cli::kFailure);
    }
    return cli::kSuccess;
}

// ---- What a person has made must not be lost

// The scene has changed since it was copied last: a copy is made, at most one a second.
void ViewApp::copy_scene() {
    if (scene_change_ == copied_change_ || seconds_since(last_copy_) < kCopyEvery) return;
    if (tool_drags_ || session_.busy()) return;
    copied_change_ = scene_change_;
    last_copy_ = Clock::now();
    session_.copy_scene(recovery_.file().string(), recovery_.journal().string());
}

void ViewApp::answer_left(const PanelAnswers& answers) {
    if (content_.left.empty() || !(answers.open_left || answers.forget_left)) return;
    const std::filesystem::path left = content_.left.front();
    if (answers.open_left) return open({left.string()});
    Recovery::remove(left);
    content_.left.erase(content_.left.begin());
    frames_owed_ = 2;
}

// A free name here: the scene of armadillo.obj is armadillo.lissom; that of a copy, which may go at
// any time, is recovered.lissom.
std::string ViewApp::scene_path() const {
    const std::filesystem::path first = options_.words.empty() ? "scene" : options_.words.front();
    const bool is_copy = first.parent_path() == state_folder();
    if (first.extension() == ".lissom" && !is_copy) return first.string();
    const std::string stem = is_copy ? "recovered" : first.stem().string();
    std::error_code error;
    for (int number = 1;; ++number) {
        std::string path = stem + (number > 1 ? "-" + std::to_string(number) : "") + ".lissom";
        if (!std::filesystem::exists(path, error)) return path;
    }
}

void ViewApp::save() {
    if (saved_path_.empty()) saved_path_ = scene_path();
    session_.save_scene(saved_path_);
    saved_change_ = scene_change_;
}

// At the end: what was not saved is kept, and told.
void ViewApp::keep_unsaved() {
    if (saved_change_ == scene_change_) return;
    const std::filesystem::path kept = recovery_.keep();
    if (kept.empty()) return;
    std::cerr << "lissom: the scene was not saved; lissom view " << kept.string() << " opens it"
              << std::endl;
}

// Another scene has taken the place of one that was not saved.
void ViewApp::keep_replaced() {
    const std::filesystem::path kept =
        saved_change_ == scene_change_ ? std::filesystem::path() : recovery_.keep();
    saved_change_ = copied_change_ = ++scene_change_;
    if (kept.empty()) return;
    std::string text = "the scene before was not saved; lissom view " + kept.string() + " opens it";
    tell("line " + text);
    add_line(content_.lines, {LineKind::warning, std::move(text)});
}

// At the start: what a killed window has left.
void ViewApp::offer_recovery() {
    content_.left = Recovery::left_in(state_folder());
    for (const std::filesystem::path& left : content_.left) {
        std::string text = "A window was ended without being closed. lissom view " + left.string() +
                           " opens what it showed";
        const std::filesystem::path journal = Recovery::journal_of(left);
        if (!journal.empty()) {
            text += "; lissom run " + journal.string() + " does it again without a window";
        }
        tell("line " + text);
        add_line(content_.lines, {LineKind::warning, std::move(text)});
    }
}

double ViewApp::wait_time() const {
    if (frames_owed_ > 0 || panel_.owes_frame()) return 0.0;
    if (screen_->filling() || pieces_left_) return 0.0;
    if (session_.busy()) return 0.1;
    if (player_ && !player_->is_paused()) return std::min(player_->wait(), 0.1);
    const bool sharpens = sharp_ != change_ && settings_.sharp;
    if (shown_ && (sharpens || !hair_is_filled())) return 0.03;
    return parameters_changed_ ? 0.02 : 0.25;
}

// ---- Input

void ViewApp::take_inputs() {
    for (const Input& input : window_.inputs().take()) {
        frames_owed_ = 2;
        times_.add_event(heard_);
        take(input);
    }
}

void ViewApp::take(const Input& input) {
    if (press_anywhere(input)) return;
    if (player_) return take_while_playing(input);
    const bool is_key = input.kind == Input::Kind::key_down || input.kind == Input::Kind::key_up ||
                        input.kind == Input::Kind::text;
    if (input.kind == Input::Kind::drop) return open(input.files);
    // A drag that began in the picture stays there; the panel sees every move and every release.
    const bool for_panel =
        is_key ? panel_.wants_keys()
               : panel_.wants_mouse(input.at, window_.size()) && !dragged_ && !tool_drags_;
    const bool is_position = input.kind == Input::Kind::move || input.kind == Input::Kind::release;
    if (for_panel || is_position || is_key || input.kind == Input::Kind::press) panel_.feed(input);
    const Canvas canvas = panel_.canvas(window_.size());
    if (is_key) {
        const bool stops = input.key == Key::escape && input.kind == Input::Kind::key_down;
        if (stops && session_.busy()) return session_.cancel();
        if (!for_panel && has_tool()) press_tool_key(input);
        if (!for_panel && input.kind == Input::Kind::key_down) press_key(input);
    } else if (!for_panel) {
        Input own = input;
        own.at -= Vec2(canvas.x, canvas.y);
        if (!give_to_tool(own)) navigate(own);
    }
}

// Keys that mean the same wherever the keyboard is, in the console too.
bool ViewApp::press_anywhere(const Input& input) {
    if (input.kind != Input::Kind::key_down) return false;
    const bool is_control = input.key == Key::character && input.modifiers.ctrl;
    const bool ends = is_control && input.character == U'Q';
    const bool saves = is_control && input.character == U'S' && !player_;
    closes_ = closes_ || ends;
    if (saves) save();
    if (input.key == Key::f12) wants_picture_ = true;
    return ends || saves || input.key == Key::f12;
}

// ---- Playing. The hand waits meanwhile, but for the keys that have to do with it.

void ViewApp::take_while_playing(const Input& input) {
    using Kind = Input::Kind;
    if (input.kind == Kind::drop) return open(input.files);
    if (input.kind == Kind::move || input.kind == Kind::release) return panel_.feed(input);
    if (input.kind == Kind::text && input.character == U'.') player_->step();
    if (input.kind == Kind::text && input.character == U'+') player_->change_speed(2.0);
    if (input.kind == Kind::text && input.character == U'-') player_->change_speed(0.5);
    if (input.kind != Kind::key_down) return;
    if (input.key == Key::space) player_->pause_or_go_on();
    if (input.key != Key::escape) return;
    content_.lines.push_back({LineKind::message, "stopped after event " +
                                                     std::to_string(session_.events_played()) +
                                                     " of " + std::to_string(player_->count())});
    session_.stop_playing();
}

void ViewApp::start_playing(Playback playback) {
    content_.playing = {.name = std::filesystem::path(playback.path).filename().string(),
                        .count = playback.times.size()};
    tell("playing " + std::to_string(playback.times.size()));
    player_.emplace(std::move(playback.times), options_.speed);
    posted_ = 0;
    last_play_ = Clock::now();
    dragged_.reset();
    tool_drags_ = false;
}

// Tools see what the hand sees again.
void ViewApp::end_playing() {
    player_.reset();
    content_.playing.reset();
    frames_owed_ = 2;
    tell("played");
    tell_camera();
}

// Posts the events that are due once those before them are done.
void ViewApp::play() {
    if (auto playback = session_.take_playback()) start_playing(std::move(*playback));
    if (!player_) return;
    if (!session_.is_playing()) return end_playing();
    if (session_.events_played() < posted_) return;
    const std::size_t due =
        player_->advance(seconds_since(std::exchange(last_play_, Clock::now())));
    for (; posted_ < due; ++posted_) {
        ToolInput event;
        event.kind = ToolInput::Kind::play;
        event.event = posted_;
        session_.post(std::move(event));
    }
    content_.playing->done = session_.events_played();
    content_.playing->speed = player_->speed();
    content_.playing->is_paused = player_->is_paused();
}

void ViewApp::navigate(const Input& input) {
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
                                   (has_tool() && *dragged_ == MouseButton::right);
                set_camera(turns ? orbited(view(), drag) : panned(view(), drag));
            }
            break;
        }
        case Input::Kind::scroll: {
            const double size =
                shown_ && !shown_->bounds.empty() ? std::max(shown_->bounds.diagonal(), 1e-9) : 1.0;
            set_camera(zoomed(view(), input.at, std::pow(kZoomStep, input.scroll.y()), size));
            break;
        }
        default:
            break;
    }
    cursor_ = input.at;
}

// With a tool in hand the left button is the tool's, but with alt, and the wheel while that is
// down; the others move the camera.
bool ViewApp::give_to_tool(const Input& input) {
    ToolInput event;
    event.at = input.at;
    event.modifiers = input.modifiers;
    const bool is_press = input.kind == Input::Kind::press;
    if (is_press && (dragged_ || tool_drags_)) return tool_drags_;
    if (is_press)
        tool_drags_ = has_tool() && input.button == MouseButton::left && !input.modifiers.alt;
    const bool own = tool_drags_ || (has_tool() && !dragged_ && input.kind == Input::Kind::move);
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
    session_.post(event);
    return true;
}

void ViewApp::press_tool_key(const Input& input) {
    ToolInput event;
    event.kind = ToolInput::Kind::key;
    event.modifiers = input.modifiers;
    if (input.kind == Input::Kind::key_down && input.key == Key::escape) {
        event.kind = ToolInput::Kind::cancel;
        tool_drags_ = false;
        return session_.post(event);
    }
    const bool types = input.kind == Input::Kind::text;
    const bool is_named = input.kind == Input::Kind::key_down && input.key != Key::character;
    if (!types && !is_named) return;
    event.key = tool_key(input);
    if (!event.key.empty()) session_.post(event);
}

void ViewApp::tell_camera() {
    if (player_) return;
    ToolInput event;
    event.kind = ToolInput::Kind::look;
    event.camera = camera_;
    const PictureSize size = view().size;
    event.size = {static_cast<int>(size.width), static_cast<int>(size.height)};
    session_.post(event);
}

void ViewApp::answer_tool(const ToolAnswers& answers) {
    if (answers.tool) session_.use_tool(*answers.tool);
    if (answers.object) session_.show_object(answers.object->name, answers.object->visible);
    if (answers.parameter) {
        const lua::ScriptParameter& p = content_.tool.parameters[*answers.parameter];
        if (p.value) session_.set_tool_parameter(p.name, *p.value);
    }
    ToolInput event;
    event.kind = answers.undo ? ToolInput::Kind::undo : ToolInput::Kind::redo;
    if (answers.undo || answers.redo) session_.post(event);
}

void ViewApp::take_tool_state(ToolState state) {
    if (state.tool != content_.tool.tool) tell("tool " + state.tool);
    if (state.scene != content_.tool.scene) {
        keep_replaced();
    } else if (state.place != content_.tool.place ||
               state.steps.size() != content_.tool.steps.size()) {
        ++scene_change_;
    }
    if (state.place != content_.tool.place || state.steps.size() != content_.tool.steps.size()) {
        tell("history " + std::to_string(state.place) + " of " +
             std::to_string(state.steps.size()));
    }
    content_.tool = std::move(state);
    frames_owed_ = 2;
    if (content_.tool.camera && !content_.tool.hand) {
        camera_ = *content_.tool.camera;
        moved();
    }
    if (!content_.tool.hand) return;
    // What the recorded hand saw; the last of it may come after the end.
    const gl::Extent seen = content_.tool.hand->size;
    camera_ =
        fitted(content_.tool.hand->camera, {1.0 * seen.width, 1.0 * seen.height}, view().size);
    camera_is_placed_ = true;
    moved();
    tell_camera();
}

void ViewApp::look_from(StandardView side) {
    if (!shown_ || shown_->bounds.empty()) return;
    FramingOptions framing = shown_->picture->framing;
    framing.aspect = view().size.aspect();
    framing.ortho = camera_.is_ortho();
    set_camera(frame_box(side, shown_->bounds, framing));
}

// All where nothing is selected.
void ViewApp::frame_selection() {
    if (!shown_) return;
    const Box selected = selected_bounds(*shown_->picture);
    frame_inside(selected.empty() ? shown_->bounds : selected);
}

void ViewApp::press_key(const Input& input) {
    const auto frame_what_shift_says = [&] {
        input.modifiers.shift ? frame_all() : frame_selection();
    };
    if (input.key == Key::home) frame_what_shift_says();
    if (input.key == Key::f5) answer({.run_again = true});
    if (input.key != Key::character || input.modifiers.alt) return;
    if (input.modifiers.ctrl) {
        const bool redoes = input.character == U'Y' || input.modifiers.shift;
        if (input.character == U'Z' || input.character == U'Y') {
            answer_tool({.undo = !redoes, .redo = redoes});
        }
        return;
    }
    if (has_tool()) return;
    constexpr std::array kSides{
        StandardView::front, StandardView::back,   StandardView::left,         StandardView::right,
        StandardView::top,   StandardView::bottom, StandardView::three_quarter};
    const char32_t letter = input.character;
    if (letter >= U'1' && letter <= U'7') look_from(kSides[letter - U'1']);
    if (letter == U'F') frame_what_shift_says();
    if (letter == U'O') answer({.toggle_ortho = true});
    if (letter == U'W') settings_.wire = !settings_.wire;
    if (letter == U'B') settings_.boundaries = !settings_.boundaries;
}

// ---- What the session has made

void ViewApp::take_results() {
    for (ConsoleLine& line : session_.take_lines()) {
        tell((line.kind == LineKind::error ? "error " : "line ") + line.text);
        add_line(content_.lines, std::move(line));
        frames_owed_ = 2;
    }
    for (const std::string& failure : programs_.failures()) {
        content_.lines.push_back({LineKind::error, failure});
        frames_owed_ = 2;
    }
    if (auto completion = session_.take_completion()) {
        content_.completion = std::move(completion);
        tell("completed");
        frames_owed_ = 2;
    }
    if (auto declared = session_.take_parameters()) take_parameters(std::move(*declared));
    if (auto state = session_.take_tool_state()) take_tool_state(std::move(*state));
    if (auto shown = session_.take_shown()) colorer_.show(std::move(*shown));
    if (auto colored = colorer_.take()) {
        if (!colored->error.empty()) content_.lines.push_back({LineKind::error, colored->error});
        show(std::move(colored->shown));
    }
    take_hair();
    if (auto made = surface_maker_.take()) {
        prepared_ = std::move(made);
        moved();
    }
    if (auto result = painter_.take(); result && result->number == change_) {
        sharp_ = change_;
        if (result->error.empty()) screen_->take(result->image);
        if (!result->error.empty()) {
            content_.lines.push_back({LineKind::error, result->error});
            settings_.sharp = false;
        }
        if (result->error.empty() && !result->path.empty()) {
            content_.lines.push_back({LineKind::result, "saved " + result->path});
            tell("picture " + result->path);
        }
        drawn_ = change_;
        frames_owed_ = 2;
    }
    const auto [stage, fraction] = session_.progress();
    content_.busy = session_.busy();
    content_.stage = stage;
    content_.fraction = fraction;
}

void ViewApp::show(Shown shown) {
    shown_ = std::move(shown);
    content_.objects.clear();
    for (std::size_t i = 0; i < shown_->picture->meshes.size(); ++i) {
        content_.objects.push_back(mesh_label(
            shown_->picture->meshes[i],
            i < shown_->names.size() ? shown_->names[i] : "mesh " + std::to_string(i + 1)));
    }
    content_.colorings = colorings_of(*shown_->picture);
    update_legend();
    if (!camera_is_placed_) {
        const View now = view();
        const Picture& picture = *shown_->picture;
        set_camera(picture.camera && !picture.camera->is_ortho()
                       ? *picture.camera
                       : quick_camera_of(picture, shown_->snapshot, now.size.aspect()));
        camera_is_placed_ = true;
    }
    moved();
    watch_.set(session_.files());
    tell("shown " + std::to_string(shown_->number));
}

// Values that a person has set stay where the script still declares them.
void ViewApp::take_parameters(std::vector<lua::ScriptParameter> declared) {
    content_.parameters = std::move(declared);
    frames_owed_ = 2;
}

void ViewApp::watch_files() {
    if (!session_.busy()) watch_.set(session_.files());
    tool_watch_.set(session_.tool_files());
    if (tool_watch_.changed(Clock::now()) && !player_) {
        tell("tool changed");
        session_.read_tool_again();
    }
    if (!watch_.changed(Clock::now())) return;
    tell("changed");
    session_.run_again(words_of(content_.parameters));
}

void ViewApp::run_with_parameters() {
    if (!parameters_changed_ || seconds_since(*parameters_changed_) < kParameterRest) return;
    parameters_changed_.reset();
    session_.run_again(words_of(content_.parameters));
}

void ViewApp::answer(const PanelAnswers& answers) {
    if (answers.view) look_from(*answers.view);
    if (answers.frame_all) frame_all();
    if (answers.toggle_ortho) {
        set_camera(camera_.is_ortho() ? with_perspective(camera_) : without_perspective(camera_));
    }
    if (answers.coloring) colorer_.choose(*answers.coloring);
    if (answers.compare_with_this) colorer_.compare_with_this();
    content_.coloring = colorer_.coloring();
    if (answers.screenshot) wants_picture_ = true;
    if (answers.run_again) session_.run_again(words_of(content_.parameters));
    if (answers.cancel) session_.cancel();
    if (answers.parameters_changed) parameters_changed_ = Clock::now();
    answer_tool(answers.tool);
    if (answers.save) save();
    if (answers.line) session_.evaluate(*answers.line);
    if (answers.complete) session_.complete(*answers.complete);
    if (answers.place) open_editor(*answers.place);
    answer_presets(answers);
    answer_left(answers);
}

// Without parameters in sight there is nothing to keep; a broken file is told when it is met.
void ViewApp::list_presets() {
    content_.presets.reset();
    if (presets_.file().empty()) return;
    content_.presets.emplace();
    try {
        content_.presets = presets_.names();
    } catch (const Error& error) {
        content_.lines.push_back({LineKind::error, error.message()});
    }
}

void ViewApp::answer_presets(const PanelAnswers& answers) {
    if (!answers.load_preset && !answers.save_preset && !answers.remove_preset) return;
    try {
        if (answers.save_preset) {
            presets_.save(*answers.save_preset, values_of(content_.parameters));
        }
        if (answers.remove_preset) presets_.remove(*answers.remove_preset);
        if (answers.load_preset) {
            for (const std::string& refused :
                 apply_preset(presets_.load(*answers.load_preset), content_.parameters)) {
                content_.lines.push_back({LineKind::warning, refused});
            }
            parameters_changed_ = Clock::now();
        }
    } catch (const Error& error) {
        content_.lines.push_back({LineKind::error, error.message()});
    }
    list_presets();
}

void ViewApp::open_editor(const SourcePlace& place) {
    const EditorHost host{
        [](const char* name) { return std::getenv(name); },
        [this](const std::vector<std::string>& words) { return programs_.start(words); }};
    const std::string wrong = open_in_editor(place, host);
    if (!wrong.empty()) content_.lines.push_back({LineKind::error, wrong});
    tell(wrong.empty() ? "editor" : "error " + wrong);
}

// ---- Drawing

// Tools learn how wide the picture is beside it.
void ViewApp::update_legend() {
    const Canvas canvas = panel_.canvas(window_.size());
    const Canvas before = screen_->beside_legend(canvas);
    screen_->set_legend(shown_legend(*shown_->picture, settings_), canvas.height,
                        background_of(settings_));
    if (!(screen_->beside_legend(canvas) == before)) tell_camera();
}

// The driver has lost all that was drawn: it is sent to a new window.
void ViewApp::make_again() {
    forget_preparing();
    screen_.reset();
    panel_.leave_context();
    try {
        window_.reopen();
    } catch (const Error&) {
        keep_unsaved();
        throw;
    }
    panel_.enter_context();
    screen_.emplace();
    uploaded_.reset();
    hair_maker_.forget();
    drawn_canvas_ = {};
    moved();
    const char* const text = "the graphics driver had lost the picture; all of it was made again";
    content_.lines.push_back({LineKind::warning, text});
    tell(std::string("line ") + text);
}

void ViewApp::send(const Sent& sent, std::span<const PreparedSurface> prepared) {
    screen_->update(sent.snapshot, prepared);
    hair_maker_.make(sent.snapshot);
    uploaded_ = sent.picture;
    uploaded_settings_ = sent.settings;
}

// Some pieces of what is ready.
void ViewApp::send_pieces() {
    if (!pieces_left_) return;
    const auto start = Clock::now();
    try {
        while (pieces_left_ && seconds_since(start) < kSendAim) pieces_left_ = sender_->send();
    } catch (const Error& error) {
        give_up(error);
    }
    if (!pieces_left_) moved();
}

// What cannot be drawn is told, and nothing is seen.
void ViewApp::give_up(const Error& error) {
    content_.lines.push_back({LineKind::error, error.message()});
    tell("error " + error.message());
    forget_preparing();
    shown_.reset();
}

// What takes long is made beside the window and sent in pieces; the window shows what was there
// before meanwhile. Of many that follow each other some are seen.
void ViewApp::send_scene() {
    auto ready = std::exchange(prepared_, std::nullopt);
    if (preparing_ && ready && ready->number == preparations_) {
        if (!ready->error.empty()) {
            preparing_.reset();
            throw Error(ErrorCode::internal, ready->error);
        }
        sender_.emplace(std::move(ready->surfaces));
        pieces_left_ = true;
    }
    if (preparing_) {
        if (!sender_ || pieces_left_) return;
        const Sent sent = *std::exchange(preparing_, std::nullopt);
        send(sent, sender_->surfaces());
        surface_maker_.end(sender_->give_away());
        sender_.reset();
        if (is_sent()) return;
    }
    Sent next{quick_snapshot(*shown_->picture, settings_), shown_->picture, settings_};
    std::vector<SurfaceNeeds> needs = screen_->needs(next.snapshot);
    if (work_for(needs) <= kManyCorners) return send(next, {});
    preparing_ = std::move(next);
    surface_maker_.make(std::move(needs), ++preparations_);
}

void ViewApp::draw_scene() {
    const Canvas canvas = panel_.canvas(window_.size());
    const bool resized = !(canvas == drawn_canvas_);
    const bool other_settings = !(uploaded_settings_ == settings_);
    if (is_sent()) {
        forget_preparing();
    } else {
        send_scene();
    }
    if (shown_ && (resized || other_settings)) update_legend();
    if (drawn_ != change_ || resized) {
        if (resized) {
            ++change_;
            tell_camera();
        }
        drawing([&] { screen_->draw(camera_, canvas, background_of(settings_), coarseness_); });
        drawn_ = change_;
        drawn_canvas_ = canvas;
    }
    drawing([&] { screen_->show(canvas, window_.size().height); });
}

void ViewApp::frame() {
    if (frames_owed_ > 0) --frames_owed_;
    const gl::Extent size = window_.size();
    framed_size_ = size;
    if (size.width == 0 || size.height == 0) return;
    const auto start = Clock::now();
    const std::uint64_t before = drawn_;
    if (window_.lost()) make_again();
    try {
        draw_scene();
    } catch (const Error& error) {
        give_up(error);
    }
    content_.is_ortho = camera_.is_ortho();
    content_.camera = camera_;
    content_.picture_size = view().size;
    const DisplaySettings old = settings_;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.width, size.height);
    const PanelAnswers answers = panel_.draw(content_, settings_, size, seconds_since(last_frame_));
    last_frame_ = Clock::now();
    drawing([&] {
        window_.show();
        glFinish();
    });
    if (frames_ == 0) tell("first frame");
    ++frames_;
    if (drawn_ != before) {
        times_.add_frame(Clock::now());
        content_.milliseconds = 1e3 * seconds_since(start);
        coarseness_ = content_.milliseconds > 1e3 * kSlowFrame ? 2 : coarseness_;
    }
    if (!(old == settings_)) moved();
    answer(answers);
}

// ---- What is drawn once nothing moves

void ViewApp::take_hair() {
    if (auto made = hair_maker_.take()) {
        std::string wrong = made->error;
        try {
            screen_->set_hair(made->hair);
        } catch (const Error& error) {
            wrong = error.message();
            screen_->set_hair({});
        }
        if (!wrong.empty()) content_.lines.push_back({LineKind::error, wrong});
        moved();
    }
    auto directed = hair_maker_.take_directed();
    if (!directed || directed->number != change_) return;
    if (directed->light != screen_->hair().light()) return;
    screen_->direct_light(directed->bytes);
    screen_->begin_fill(camera_, panel_.canvas(window_.size()), background_of(settings_),
                        settings_.sharp ? kLongFill : kLongestFill);
    filled_ = change_;
}

// One slice of the strands; events are looked for before the next.
void ViewApp::fill_hair() {
    if (!at_rest()) {
        if (directed_ != change_) hair_maker_.stop_directing();
        return;
    }
    if (filled_ == change_) {
        if (!screen_->fill()) return;
        tell("filled");
        frames_owed_ = 1;
        return;
    }
    const bool ready = !screen_->hair().empty() && !hair_maker_.busy() && drawn_ == change_;
    if (!ready || directed_ == change_) return;
    const Mat4 turn = view_matrix(camera_, Vec3::Zero());
    hair_maker_.direct(screen_->hair().light(), turn.topLeftCorner<3, 3>(), change_);
    directed_ = change_;
}

// Draws a finished picture.
void ViewApp::ask_for_sharp() {
    if (!at_rest()) {
        if (asked_ != change_) painter_.stop();
        was_at_rest_ = false;
        return;
    }
    const bool wanted = shown_ && ((settings_.sharp && hair_is_filled()) || wants_picture_);
    if (wanted && (asked_ != change_ || wants_picture_)) {
        const Canvas canvas = panel_.canvas(window_.size());
        painter_.draw(std::make_shared<const Picture>(displayed(
                          *shown_->picture, settings_, camera_, canvas.width, canvas.height)),
                      change_, std::exchange(wants_picture_, false) ? new_picture_path() : "");
        asked_ = change_;
        sharp_ = 0;
    }
    const bool done =
        (!wanted || sharp_ == change_) && hair_is_filled() && !session_.busy() && !colorer_.busy();
    if (done && !was_at_rest_) tell_rest();
    was_at_rest_ = done;
}

}  // namespace

int run_view(cli::Program& program, const ViewOptions& options) {
    ViewApp app(program, options);
    return app.run();
}

}  // namespace lissom::window
