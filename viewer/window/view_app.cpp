#include "viewer/window/view_app.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>
#include <thread>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "viewer/window/app/camera_moves.h"
#include "viewer/window/app/frames.h"
#include "viewer/window/app/hair_fill.h"
#include "viewer/window/app/pointer_input.h"
#include "viewer/window/app/replay.h"
#include "viewer/window/app/scene_autosave.h"
#include "viewer/window/app/scene_upload.h"
#include "viewer/window/app/script_reload.h"
#include "viewer/window/app/still_render.h"
#include "viewer/window/app/view_state.h"
#include "viewer/window/makers/colorer.h"
#include "viewer/window/screen/driver_memory.h"
#include "viewer/window/tools/tool_list.h"

namespace lissom::window {
namespace {

// Seconds without a change after which a finished picture is drawn.
// Seconds between two ticks of a tool.
constexpr double kTick = 1.0 / 30.0;
constexpr double kRest = 0.15;
// Work of the session that is over sooner is not shown.
constexpr double kBusyAfter = 0.15;

constexpr const char* kWelcome =
    "Drop meshes, a script or a scene here, or name them on the command line.";

// The program was asked to end: it does so as if its window were closed.
volatile std::sig_atomic_t terminated = 0;

void listen_to_termination() {
    for (const int signal : {SIGTERM, SIGHUP}) {
        std::signal(signal, [](int) { terminated = 1; });
    }
}

int threads_of(const cli::Program& program) {
    if (program.threads > 0) return program.threads;
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

PanelHost host_of(GlfwWindow& window) {
    return {window.scale().panel(),
            [&window](const std::string& text) { window.set_clipboard(text); },
            [&window] { return window.clipboard(); }};
}

std::string mesh_label(const DrawnMesh& drawn, const std::string& name) {
    return name + "  (" + std::to_string(drawn.mesh->face_count()) + " faces)";
}

class ViewApp {
  public:
    ViewApp(cli::Program& program, const ViewOptions& options);

    int run();

  private:
    void drop(const std::vector<std::string>& files);
    void take_tools(const std::vector<std::pair<std::string, std::string>>& tools);
    void add_buttons(const std::vector<std::string>& words);
    double wait_time() const;
    void turn(Clock::time_point heard);
    void tick();
    int end();

    // ---- Inputs
    void take_inputs(Clock::time_point heard);
    void take(const Input& input);
    void take_while_playing(const Input& input);
    bool picks_by(const Input& input) const;
    void take_key(const Input& input, bool for_panel);
    bool press_anywhere(const Input& input);
    void press_key(const Input& input);
    void press_letter(char32_t letter);
    void answer(const PanelAnswers& answers);
    void answer_tool(const ToolAnswers& answers);

    // ---- Results of others
    void take_results();
    void take_opened(const std::vector<std::string>& words);
    void take_news(SessionNews news);
    void take_tool_state(ToolState state);
    void see_played(const PlayedHand& hand);
    void take_progress();
    void show(Shown shown);
    void list_picks();

    void make_again();
    bool at_rest() const {
        return upload_.is_sent() && state_.changes.seconds() > kRest && !pointer_.drags() &&
               !state_.changes.owes_frame();
    }

    GlfwWindow window_;
    Panel panel_;
    Session session_;
    ViewState state_;
    HairFill hair_;
    SceneUpload upload_;
    Frames frames_;
    StillRender still_render_;
    Colorer colorer_;
    PointerInput pointer_;
    SceneAutosave autosave_;
    Replay replay_;
    ScriptReload reload_;
    // Since when the session works.
    std::optional<Clock::time_point> busy_since_;
    // The last tick of the tool's drag.
    std::optional<Clock::time_point> ticked_;
    bool closes_ = false;
};

ViewApp::ViewApp(cli::Program& program, const ViewOptions& options)
    : window_("lissom", {options.width, options.height}),
      panel_(host_of(window_)),
      session_(
          program, [] { GlfwWindow::wake(); }, options.session),
      state_{window_, panel_, session_, {window_.scale().panel()}, options.tells},
      hair_(state_, threads_of(program)),
      upload_(state_, hair_, threads_of(program)),
      frames_(state_, upload_),
      still_render_(state_, threads_of(program)),
      colorer_([] { GlfwWindow::wake(); }),
      pointer_(state_),
      autosave_(state_),
      replay_(state_, options.speed),
      reload_(state_) {
    if (options.tells) {
        window_.listen_to_driver(
            [this](const std::string& text) { state_.tell("driver " + text); });
    }
    state_.settings.scale = state_.pixels.scale;
    state_.content.driver = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    if (options.words.empty()) state_.add_line(LineKind::message, kWelcome);
    add_buttons(shipped_tools());
    add_buttons(own_tools());
    add_buttons(options.tools);
    autosave_.offer();
    if (!options.words.empty()) session_.open(options.words);
}

void ViewApp::add_buttons(const std::vector<std::string>& words) {
    auto& buttons = state_.content.tools;
    for (const std::string& word : words) {
        const auto is_it = [&](const ToolButton& one) { return one.word == word; };
        if (std::none_of(buttons.begin(), buttons.end(), is_it)) buttons.push_back(button_of(word));
    }
}

void ViewApp::drop(const std::vector<std::string>& files) {
    if (files.size() == 1) return session_.open(files);
    std::vector<std::string> meshes = files, scripts;
    std::erase_if(meshes, is_script);
    std::copy_if(files.begin(), files.end(), std::back_inserter(scripts), is_script);
    if (!meshes.empty()) session_.open(meshes);
    if (!scripts.empty()) session_.find_tools(scripts);
}

void ViewApp::take_tools(const std::vector<std::pair<std::string, std::string>>& tools) {
    for (const auto& [word, name] : tools) {
        keep_button(state_.content.tools, word, name);
        state_.tell("button " + name);
        state_.changes.owe_frames();
    }
}

// It has replaced the open document.
void ViewApp::take_opened(const std::vector<std::string>& words) {
    replay_.forget();
    autosave_.begin(words.front());
    reload_.begin(words.front());
    state_.camera_is_placed = false;
    state_.up.reset();
    window_.set_title(std::filesystem::path(words.front()).filename().string() + " - lissom");
    state_.tell("opened " + words.front());
}

int ViewApp::run() {
    while (!window_.close_requested() && !closes_ && !terminated) {
        const auto before = Clock::now();
        const double most = wait_time();
        window_.wait(most);
        const auto start = Clock::now();
        const double work = thread_seconds();
        frames_.begin_turn();
        // Without waiting an event may have come at any time since the last look.
        turn(most > 0.0 ? start : before);
        frames_.end_turn(seconds_since(start), thread_seconds() - work);
    }
    return end();
}

void ViewApp::turn(Clock::time_point heard) {
    // Without input, too.
    if (frames_.has_to_show()) state_.changes.owe_frames();
    take_inputs(heard);
    tick();
    take_results();
    replay_.play();
    reload_.look();
    if (!pointer_.tool_drags()) autosave_.copy();
    upload_.send_pieces();
    if (state_.changes.owes_frame() || panel_.owes_frame() || session_.busy()) {
        if (window_.lost()) make_again();
        answer(frames_.draw());
    }
    hair_.fill(at_rest());
    still_render_.draw(at_rest(), hair_.is_filled());
    const bool busy = !hair_.is_filled() || session_.busy() || colorer_.busy();
    still_render_.tell_rest(at_rest(), busy);
    // The work until now has changed nothing visible.
    if (state_.changes.is_drawn() && upload_.is_sent() && !session_.busy()) frames_.end_event();
}

int ViewApp::end() {
    state_.tell(frames_.times());
    still_render_.stop();
    autosave_.keep_unsaved();
    if (session_.finish(1.0)) return cli::kSuccess;
    std::cerr << "lissom: the running work did not stop within a second, and was ended"
              << std::endl;
    std::_Exit(cli::kFailure);
}

double ViewApp::wait_time() const {
    if (state_.changes.owes_frame() || panel_.owes_frame()) return 0.0;
    if (state_.screen->filling() || upload_.has_pieces()) return 0.0;
    if (session_.busy()) return 0.1;
    if (ticked_) return kTick;
    if (const auto wait = replay_.wait()) return std::min(*wait, 0.1);
    if (state_.shown && (still_render_.is_owed() || !hair_.is_filled())) return 0.03;
    return reload_.waits() ? 0.02 : 0.25;
}

// Time goes by for a tool while it has a drag.
void ViewApp::tick() {
    const auto now = Clock::now();
    if (!ticked_ || !pointer_.tool_drags()) {
        ticked_.reset();
        if (pointer_.tool_drags() && pointer_.tick(0.0)) ticked_ = now;
        return;
    }
    const double seconds = std::chrono::duration<double>(now - *ticked_).count();
    if (seconds < kTick || session_.busy()) return;
    pointer_.tick(seconds);
    ticked_ = now;
}

// ---- Inputs

void ViewApp::take_inputs(Clock::time_point heard) {
    for (const Input& input : window_.inputs().take()) {
        state_.changes.owe_frames();
        frames_.add_event(heard);
        take(input);
    }
}

void ViewApp::take(const Input& input) {
    if (press_anywhere(input)) return;
    if (input.kind == Input::Kind::drop) return drop(input.files);
    if (replay_.plays()) return take_while_playing(input);
    const bool is_key = input.kind == Input::Kind::key_down || input.kind == Input::Kind::key_up ||
                        input.kind == Input::Kind::text;
    // A drag that began in the picture stays there; the panel sees every move and every release.
    const bool for_panel = is_key
                               ? panel_.wants_keys()
                               : panel_.wants_mouse(input.at, window_.size()) && !pointer_.drags();
    const bool is_position = input.kind == Input::Kind::move || input.kind == Input::Kind::release;
    if (for_panel || is_position || is_key || input.kind == Input::Kind::press) panel_.feed(input);
    if (is_key) return take_key(input, for_panel);
    if (for_panel || picks_by(input)) return;
    const Canvas canvas = state_.canvas();
    Input own = input;
    own.at -= Vec2(canvas.x, canvas.y);
    pointer_.take(own);
}

// The left button picks a boundary for a parameter, and the others go on moving the camera.
bool ViewApp::picks_by(const Input& input) const {
    const bool is_button = input.kind == Input::Kind::press || input.kind == Input::Kind::release;
    return state_.content.picking && is_button && input.button == MouseButton::left;
}

void ViewApp::take_while_playing(const Input& input) {
    using Kind = Input::Kind;
    if (input.kind == Kind::move || input.kind == Kind::release) return panel_.feed(input);
    replay_.take_key(input);
}

void ViewApp::take_key(const Input& input, bool for_panel) {
    const bool stops = input.key == Key::escape && input.kind == Input::Kind::key_down;
    if (stops && session_.busy()) return session_.cancel();
    if (for_panel) return;
    if (state_.has_tool()) pointer_.press_tool_key(input);
    if (input.kind == Input::Kind::key_down) press_key(input);
}

// Keys that mean the same wherever the keyboard is, in the console too.
bool ViewApp::press_anywhere(const Input& input) {
    if (input.kind != Input::Kind::key_down) return false;
    const bool is_control = input.key == Key::character && input.modifiers.ctrl;
    const bool ends = is_control && input.character == U'Q';
    const bool saves = is_control && input.character == U'S' && !replay_.plays();
    closes_ = closes_ || ends;
    if (saves) autosave_.save();
    const bool exports = is_control && input.character == U'E' && !replay_.plays();
    if (exports) session_.export_object(state_.content.export_name);
    if (input.key == Key::f12) still_render_.want_file();
    return ends || saves || exports || input.key == Key::f12;
}

void ViewApp::press_key(const Input& input) {
    const bool shift = input.modifiers.shift;
    if (input.key == Key::home) shift ? frame_all(state_) : frame_selection(state_);
    if (input.key == Key::f5) answer({.run_again = true});
    if (input.key != Key::character || input.modifiers.alt) return;
    if (input.modifiers.ctrl) {
        const bool redoes = input.character == U'Y' || shift;
        if (input.character == U'Z' || input.character == U'Y') {
            answer_tool({.undo = !redoes, .redo = redoes});
        }
        return;
    }
    if (state_.has_tool()) return;
    if (input.character == U'F') shift ? frame_all(state_) : frame_selection(state_);
    press_letter(input.character);
}

void ViewApp::press_letter(char32_t letter) {
    constexpr std::array kSides{
        StandardView::front, StandardView::back,   StandardView::left,         StandardView::right,
        StandardView::top,   StandardView::bottom, StandardView::three_quarter};
    DisplaySettings& settings = state_.settings;
    if (letter >= U'1' && letter <= U'7') look_from(state_, kSides[letter - U'1']);
    if (letter == U'O') toggle_perspective(state_);
    if (letter == U'U') toggle_up(state_);
    if (letter == U'W') settings.wire = !settings.wire;
    if (letter == U'B') settings.boundaries = !settings.boundaries;
}

void ViewApp::answer(const PanelAnswers& answers) {
    if (answers.view) look_from(state_, *answers.view);
    if (answers.frame_all) frame_all(state_);
    if (answers.toggle_ortho) toggle_perspective(state_);
    if (answers.toggle_up) toggle_up(state_);
    if (answers.coloring) colorer_.choose(*answers.coloring);
    if (answers.compare_with_this) colorer_.compare_with_this();
    state_.content.coloring = colorer_.coloring();
    if (answers.screenshot) still_render_.want_file();
    if (answers.cancel) session_.cancel();
    answer_tool(answers.tool);
    if (answers.save) autosave_.save();
    if (answers.exports) session_.export_object(state_.content.export_name);
    if (answers.line) session_.evaluate(*answers.line);
    if (answers.complete) session_.complete(*answers.complete);
    reload_.answer(answers);
    if (const auto left = autosave_.answer(answers)) session_.open({*left});
}

void ViewApp::answer_tool(const ToolAnswers& answers) {
    if (answers.tool) session_.use_tool(*answers.tool);
    if (answers.object) session_.show_object(answers.object->name, answers.object->visible);
    if (answers.parameter) {
        const lua::ScriptParameter& p = state_.content.tool.parameters[*answers.parameter];
        if (p.value) session_.set_tool_parameter(p.name, *p.value);
    }
    ToolInput event;
    event.kind = answers.undo ? ToolInput::Kind::undo : ToolInput::Kind::redo;
    if (answers.undo || answers.redo) session_.post(event);
}

// ---- Results of others

void ViewApp::take_results() {
    take_news(session_.take_news());
    reload_.take_failures();
    if (auto colored = colorer_.take()) {
        if (!colored->error.empty()) state_.add_line(LineKind::error, colored->error);
        show(std::move(colored->shown));
    }
    hair_.take();
    upload_.take();
    still_render_.take();
    take_progress();
}

void ViewApp::take_news(SessionNews news) {
    for (ConsoleLine& line : news.lines) {
        state_.tell((line.kind == LineKind::error ? "error " : "line ") + line.text);
        state_.add_line(line.kind, std::move(line.text));
    }
    if (news.completion) {
        state_.content.completion = std::move(news.completion);
        state_.tell("completed");
        state_.changes.owe_frames();
    }
    if (news.opened) take_opened(*news.opened);
    if (news.saved) autosave_.take_saved(*news.saved);
    if (news.parameters) {
        state_.content.parameters = std::move(*news.parameters);
        list_picks();
        state_.changes.owe_frames();
    }
    take_tools(news.tools);
    if (news.tool_state) take_tool_state(std::move(*news.tool_state));
    if (news.shown) colorer_.show(std::move(*news.shown));
    if (!news.playback) return;
    replay_.begin(*news.playback);
    pointer_.let_go();
}

void ViewApp::take_tool_state(ToolState state) {
    ToolState& known = state_.content.tool;
    const bool has_stepped = state.place != known.place || state.steps.size() != known.steps.size();
    if (state.tool != known.tool) state_.tell("tool " + state.tool);
    if (state.scene != known.scene) {
        autosave_.replace();
    } else if (has_stepped) {
        autosave_.add_change();
    }
    if (has_stepped) {
        state_.tell("history " + std::to_string(state.place) + " of " +
                    std::to_string(state.steps.size()));
    }
    // Newer settings of the person stay in the panel.
    if (state.tool == known.tool && session_.has_setting()) state.parameters = known.parameters;
    known = std::move(state);
    list_picks();
    keep_button(state_.content.tools, known);
    state_.changes.owe_frames();
    if (known.hand) return see_played(*known.hand);
    if (!known.camera) return;
    state_.camera = *known.camera;
    if (known.up) state_.up = known.up;
    state_.camera_is_placed = true;
    state_.changes.add();
}

// Shows the view of the recorded hand; the last of it may come after the end.
void ViewApp::see_played(const PlayedHand& hand) {
    const PictureSize seen{1.0 * hand.size.width, 1.0 * hand.size.height};
    state_.camera_is_placed = true;
    state_.set_camera(fitted(hand.camera, seen, state_.view().size));
}

void ViewApp::take_progress() {
    const auto [stage, fraction] = session_.progress();
    if (!session_.busy()) busy_since_.reset();
    if (session_.busy() && !busy_since_) busy_since_ = Clock::now();
    state_.content.busy = busy_since_ && seconds_since(*busy_since_) > kBusyAfter;
    state_.content.stage = stage.empty() ? state_.content.tool.tool : stage;
    state_.content.fraction = fraction;
}

void ViewApp::show(Shown shown) {
    state_.shown = std::move(shown);
    const Shown& now = *state_.shown;
    state_.content.objects.clear();
    for (std::size_t i = 0; i < now.picture->meshes.size(); ++i) {
        state_.content.objects.push_back(
            mesh_label(now.picture->meshes[i],
                       i < now.names.size() ? now.names[i] : "mesh " + std::to_string(i + 1)));
    }
    list_picks();
    state_.content.colorings = colorings_of(*now.picture);
    update_legend(state_);
    if (!state_.camera_is_placed) place_camera(state_);
    state_.changes.add();
    reload_.watch();
    state_.tell("shown " + std::to_string(now.number));
}

// Choices are listed only for parameters that are picked.
void ViewApp::list_picks() {
    PanelContent& content = state_.content;
    const auto any = [](const std::vector<lua::ScriptParameter>& list) {
        return std::any_of(list.begin(), list.end(),
                           [](const lua::ScriptParameter& p) { return is_picked(p.type); });
    };
    content.picks = {};
    if (!state_.shown || !(any(content.parameters) || any(content.tool.parameters))) return;
    content.picks = pick_choices_of(*state_.shown, content.tool);
}

// The driver has lost all that was drawn: it is sent to a new window.
void ViewApp::make_again() {
    upload_.forget();
    state_.screen.reset();
    panel_.leave_context();
    try {
        window_.reopen();
    } catch (const Error&) {
        autosave_.keep_unsaved();
        throw;
    }
    panel_.enter_context();
    state_.screen.emplace();
    frames_.forget();
    state_.changes.add();
    const char* const text = "the graphics driver had lost the picture; all of it was made again";
    state_.add_line(LineKind::warning, text);
    state_.tell(std::string("line ") + text);
}

}  // namespace

int run_view(cli::Program& program, const ViewOptions& options) {
    keep_driver_memory();
    listen_to_termination();
    ViewApp app(program, options);
    return app.run();
}

}  // namespace lissom::window
