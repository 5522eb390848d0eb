#include "viewer/window/session/session.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "bindings/cli/repl/display.h"
#include "bindings/cli/repl/session_text.h"
#include "bindings/cli/script_text.h"
#include "bindings/cli/terminal/interrupt.h"
#include "bindings/lua/core/failure.h"
#include "viewer/lua/shown_values.h"
#include "viewer/lua/viewer_library.h"
#include "viewer/window/session/script_setup.h"
#include "viewer/window/session/unlike_sizes.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;

// Lines that are kept for a window that does not take them.
constexpr std::size_t kMostLines = 10000;

// Seconds after which a tool is stopped if its file changes.
constexpr double kLongWork = 1.0;

// Seconds after which a stroke that a slow tool follows is shown as far as it has come.
constexpr double kLongStroke = 0.05;

}  // namespace

bool is_script(const std::string& word) {
    return fs::path(word).extension() == ".lua";
}

bool is_recording(const std::string& word) {
    if (!is_script(word)) return false;
    const std::optional<std::string> text = cli::script_text(word);
    return text && cli::is_recording(*text);
}

Session::Session(cli::Program& program, std::function<void()> wake, SessionOptions options)
    : program_(program),
      wake_(std::move(wake)),
      options_(std::move(options)),
      records_(options_.record, options_.journal) {
    look_.kind = ToolInput::Kind::look;
    look_.size = {1280, 960};
    program_.log_filter = [this](LogLevel level, std::string_view text) {
        if (level == LogLevel::warning || program_.debug) {
            tell(level == LogLevel::warning ? LineKind::warning : LineKind::message,
                 std::string(text));
        }
        return false;
    };
    program_.progress_listener = [this](std::string_view label, double fraction) {
        const std::lock_guard lock(mutex_);
        shared_.stage = label;
        shared_.fraction = fraction;
    };
    listener_ = [this](const Picture& picture) {
        ++pictures_;
        show(frozen_.freeze(picture));
    };
}

Session::~Session() {
    finish(1.0);
    // The Lua state ends on the thread that it lived on.
    worker_.post_only([this] {
        bench_.reset();
        script_.reset();
    });
    worker_.wait_idle(1.0);
}

// ---- The window's thread

void Session::open(const std::vector<std::string>& words) {
    const std::uint64_t number = ++asked_;
    {
        const std::lock_guard lock(mutex_);
        shared_.asked = words;
    }
    give_up();
    post_only([this, words, number] {
        run(words, true);
        opened_ = number;
    });
}

void Session::run_again(const std::vector<std::string>& words) {
    if (is_opening()) return;
    {
        const std::lock_guard lock(mutex_);
        if (shared_.words.empty()) return;
        if (is_script(shared_.words.front())) {
            shared_.words.resize(1);
            shared_.words.insert(shared_.words.end(), words.begin(), words.end());
        }
    }
    opened_ = asked_.load();
    give_up();
    post_only([this] {
        std::unique_lock lock(mutex_);
        const std::vector<std::string> now = shared_.words;
        lock.unlock();
        run(now, false);
    });
}

void Session::evaluate(const std::string& line) {
    tell(LineKind::input, line);
    post_job([this, line] { evaluate_line(line); });
}

void Session::complete(const std::string& text) {
    post_job([this, text] { find_completions(text); });
}

void Session::cancel() {
    const std::lock_guard lock(cancel_mutex_);
    if (busy() && !saves_) cli::Interrupt::press();
}

// A save is short and asked for: no cancel meant for other work stops it.
void Session::set_saving(bool saves) {
    const std::lock_guard lock(cancel_mutex_);
    saves_ = saves;
    if (saves) program_.forget_interrupt();
}

// The next work starts without the cancel and the progress of the last.
void Session::begin_work() {
    program_.forget_interrupt();
    const std::lock_guard lock(mutex_);
    shared_.stage.clear();
    shared_.fraction = 0.0;
    shared_.work_began = Clock::now();
}

// Stops the running work because something else takes its place: nobody has to be told.
void Session::give_up() {
    given_up_ = true;
    cancel();
}

void Session::use_tool(const std::string& word) {
    post_job([this, word] {
        begin_work();
        if (settle_tool(word)) options_.tool = word;
        show_scene(true);
    });
}

// Work that runs for long may be the tool that never returns, and was mended for that reason.
void Session::read_tool_again() {
    {
        const std::lock_guard lock(mutex_);
        if (busy() && seconds_since(shared_.work_began) > kLongWork) cancel();
    }
    post_job([this] {
        begin_work();
        settle_tool(options_.tool);
        show_scene(true);
    });
}

// Inputs keep their place among all requests: inputs after another job wait for it.
void Session::post(ToolInput input) {
    const std::lock_guard lock(mutex_);
    shared_.last_setting.reset();
    if (!shared_.takes_inputs_last || shared_.inputs.empty()) {
        shared_.inputs.emplace_back();
        shared_.takes_inputs_last = true;
        worker_.post([this] { take_inputs(); });
    }
    push_input(shared_.inputs.back(), std::move(input));
}

void Session::post_job(Worker::Job job) {
    const std::lock_guard lock(mutex_);
    shared_.takes_inputs_last = false;
    shared_.last_setting.reset();
    worker_.post(std::move(job));
}

// Drops waiting jobs; but the view known by now counts for the next ones, too.
void Session::post_only(Worker::Job job) {
    const std::lock_guard lock(mutex_);
    std::vector<ToolInput> kept;
    for (std::vector<ToolInput>& batch : std::exchange(shared_.inputs, {})) {
        for (ToolInput& input : batch) {
            if (input.kind == ToolInput::Kind::look) kept = {std::move(input)};
        }
    }
    worker_.post_only(std::move(job));
    shared_.last_setting.reset();
    shared_.takes_inputs_last = !kept.empty();
    if (kept.empty()) return;
    shared_.inputs.push_back(std::move(kept));
    worker_.post([this] { take_inputs(); });
}

void Session::copy_scene(const std::string& path, const std::string& journal) {
    post_job([this, path, journal] {
        if (!bench_ || !bench_->has_scene() || bench_->is_held()) return;
        begin_work();
        std::string left_out;
        if (!succeeds(bench_->save(path, left_out)) || records_.has_journal()) return;
        const std::optional<std::string> text = bench_->text_of("journal_text");
        if (text && !write_whole(journal, *text)) {
            tell(LineKind::error, "the journal cannot be written to " + journal);
        }
    });
}

void Session::save_scene(const std::string& path, std::uint64_t scene, std::uint64_t change) {
    const auto save = [this, path, scene, change] {
        if (!bench_ || !bench_->has_scene() || bench_->is_held()) return;
        begin_work();
        if (scene != 0 && scene != scene_number_) {
            return tell(LineKind::warning, "another scene is open by now: nothing was saved");
        }
        if (bench_->is_empty()) {
            return tell(LineKind::warning, "the scene has no objects: nothing was saved");
        }
        std::string left_out;
        set_saving(true);
        const cli::ScriptResult result = bench_->save(path, left_out);
        set_saving(false);
        if (!succeeds(result)) return;
        tell(LineKind::result, "saved " + path);
        if (!left_out.empty()) tell(LineKind::warning, left_out);
        const std::lock_guard lock(mutex_);
        shared_.news.saved = change;
    };
    const std::lock_guard lock(mutex_);
    shared_.takes_inputs_last = false;
    shared_.last_setting.reset();
    worker_.post(save, true);
}

void Session::export_object(const std::string& path) {
    const auto write = [this, path] {
        if (!bench_ || !bench_->has_scene()) {
            return tell(LineKind::warning, "there is no scene: nothing was exported");
        }
        if (bench_->is_held()) return;
        begin_work();
        std::string told;
        set_saving(true);
        const cli::ScriptResult result = bench_->export_object(path, told);
        set_saving(false);
        if (succeeds(result)) tell(LineKind::result, told);
    };
    const std::lock_guard lock(mutex_);
    shared_.takes_inputs_last = false;
    shared_.last_setting.reset();
    worker_.post(write, true);
}

void Session::show_object(const std::string& name, bool visible) {
    post_job([this, name, visible] {
        if (!bench_ || !bench_->has_scene()) return;
        begin_work();
        succeeds(bench_->show(name, visible));
        show_scene(true);
    });
}

// If the last waiting job sets the same parameter, the newer value takes its place.
void Session::set_tool_parameter(const std::string& name, const lua::ParameterValue& value) {
    const std::lock_guard lock(mutex_);
    if (shared_.last_setting && shared_.last_setting->first == name) {
        shared_.last_setting->second = value;
        return;
    }
    auto setting = std::make_shared<Setting>(name, value);
    shared_.takes_inputs_last = false;
    shared_.last_setting = setting;
    worker_.post([this, setting] { set_parameter(setting); });
}

void Session::set_parameter(const std::shared_ptr<Setting>& setting) {
    std::unique_lock lock(mutex_);
    if (shared_.last_setting == setting) shared_.last_setting.reset();
    const auto [name, value] = *setting;
    lock.unlock();
    if (!bench_ || !bench_->has_scene()) return;
    begin_work();
    succeeds(bench_->set(name, value));
    show_scene(true);
}

bool Session::is_opening() const {
    const std::lock_guard lock(mutex_);
    return opened_ != asked_ && !shared_.words.empty() && shared_.asked != shared_.words;
}

bool Session::has_setting() const {
    const std::lock_guard lock(mutex_);
    return shared_.last_setting != nullptr;
}

void Session::stop_playing() {
    if (!plays_.exchange(false)) return;
    cancel();
    ToolInput stop;
    stop.kind = ToolInput::Kind::stop;
    post(std::move(stop));
}

std::vector<fs::path> Session::tool_files() const {
    const std::lock_guard lock(mutex_);
    return shared_.tool_files;
}

std::pair<std::string, double> Session::progress() const {
    const std::lock_guard lock(mutex_);
    return {shared_.stage, shared_.fraction};
}

SessionNews Session::take_news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(shared_.news, {});
}

std::vector<fs::path> Session::files() const {
    const std::lock_guard lock(mutex_);
    return shared_.files;
}

bool Session::finish(double seconds) {
    if (!busy()) return true;
    cli::Interrupt::press();
    return worker_.wait_idle(seconds);
}

// ---- The worker's thread

void Session::run(const std::vector<std::string>& words, bool is_new) {
    begin_work();
    given_up_ = plays_ = shows_hand_ = false;
    // If nothing is open yet, nothing is lost.
    const bool is_first = is_new && !has_words();
    if (is_first) adopt(words);
    if (!opens(words, is_new && !is_first)) let_go();
    wake_();
}

bool Session::opens(const std::vector<std::string>& words, bool is_new) {
    if (is_recording(words.front())) return open_recording(words.front(), is_new);
    if (is_script(words.front())) return run_script(words, is_new);
    return load_files(words, is_new);
}

// Makes these words the open document.
void Session::adopt(const std::vector<std::string>& words) {
    const std::lock_guard lock(mutex_);
    shared_.words = words;
    shared_.news.opened = words;
    shared_.news.parameters = std::vector<lua::ScriptParameter>();
}

bool Session::has_words() const {
    const std::lock_guard lock(mutex_);
    return !shared_.words.empty();
}

// Returns whether the failed words are the open document, to be mended and read again.
bool Session::keeps_failed(const std::vector<std::string>& words, bool is_new) const {
    const std::lock_guard lock(mutex_);
    const bool is_same_script = is_script(words.front()) && shared_.words.front() == words.front();
    return !is_new || is_same_script || shared_.words == words;
}

// Nothing of a script stays with the open document now.
void Session::forget_script() {
    ran_.clear();
    kept_.clear();
}

Session::Document Session::put_aside() {
    return {std::move(script_), std::move(bench_), pictures_};
}

// Restores the document after its replacement has failed.
void Session::put_back(Document document) {
    bench_ = std::move(document.bench);
    script_ = std::move(document.script);
    pictures_ = document.pictures;
    if (script_) cli::Interrupt::attend(script_->lua());
}

// Shows the picture again if something else was shown meanwhile.
void Session::show_again(const std::optional<Shown>& shown) {
    if (!shown || !last_shown_ || last_shown_->number == shown->number) return;
    last_shown_ = shown;
    show_last();
}

void Session::show_last() {
    if (!last_shown_) return;
    const std::lock_guard lock(mutex_);
    last_shown_->number = ++shared_.number;
    shared_.news.shown = last_shown_;
}

// A state of its own, whose prints and pictures come here.
void Session::open_script(const lua::ScriptArguments& arguments) {
    bench_.reset();
    script_.reset();
    script_ = std::make_unique<cli::Script>(program_, arguments);
    bench_ = std::make_unique<ToolBench>(*script_);
    lua_State* L = script_->lua();
    lua_pushlightuserdata(L, this);
    lua_pushcclosure(L, print, 1);
    lua_setglobal(L, "print");
    guard_exit(L);
    lua::set_picture_listener(L, &listener_);
    pictures_ = 0;
}

// A script that runs again finds the selection and the tool as they were; one that fails leaves the
// scene before it to the tools.
bool Session::run_script(const std::vector<std::string>& words, bool is_new) {
    const bool is_same = ran_ == words[0];
    if (is_same && bench_) kept_ = bench_->kept().value_or(kept_);
    const std::optional<Shown> seen = last_shown_;
    Document before = put_aside();
    open_script({words[0], {words.begin() + 1, words.end()}});
    const cli::ScriptResult result = script_->run_file(words[0]);
    const bool works = result.status == cli::kSuccess;
    const bool is_tool = works && bench_->tool_among({1, lua_gettop(script_->lua())}).has_value();
    tell_whether_mended(words[0], works);
    if (!works) succeeds(result);
    const bool is_seen = works && !is_tool && has_shown(words[0]);
    if (is_tool || (!is_seen && !keeps_failed(words, is_new))) {
        put_back(std::move(before));
        show_again(seen);
        if (is_tool) take_own_tool(words[0]);
        return false;
    }
    if (is_new) adopt(words);
    publish_parameters();
    find_files(words[0]);
    if (!works) {
        settle_failed(std::move(before), is_same);
        return false;
    }
    settle_script(words, is_same);
    return true;
}

// Returns whether a script that has run has anything to show; reports if it has not.
bool Session::has_shown(const std::string& script) {
    if (pictures_ > 0 || has_values()) return true;
    tell(LineKind::warning, script +
                                " shows nothing: let it draw with lissom.render, or return an "
                                "object to show: a mesh, strands, a scene, or a table of them");
    return bench_->has_scene_among({1, lua_gettop(script_->lua())});
}

void Session::settle_failed(Document before, bool is_same) {
    lua_settop(script_->lua(), 0);
    if (is_same && before.bench && before.bench->has_scene()) put_back(std::move(before));
}

void Session::settle_script(const std::vector<std::string>& words, bool is_same) {
    lua_State* L = script_->lua();
    if (!is_same) kept_.clear();
    ran_ = words[0];
    // They were shown before it was known that they would stay.
    if (pictures_ > 0) show_last();
    show_values();
    succeeds(bench_->take_values({1, lua_gettop(L)}));
    // The words of its command line are not in a recording.
    settle_scene(words.size() == 1 ? words : std::vector<std::string>());
    lua_settop(L, 0);
}

// A tool was opened: it is taken in hand, now or with the next scene.
void Session::take_own_tool(const std::string& path) {
    if (bench_ && bench_->has_scene()) {
        if (settle_tool(path)) options_.tool = path;
        return show_scene(true);
    }
    options_.tool = path;
    tell(LineKind::message, path + " is a tool: open an object for it to work on");
}

void Session::find_tools(const std::vector<std::string>& scripts) {
    post_job([this, scripts] { look_for_tools(scripts); });
}

// Each runs in a state of its own, as if it was opened.
void Session::look_for_tools(const std::vector<std::string>& scripts) {
    begin_work();
    std::string names;
    std::vector<std::pair<std::string, std::string>> found;
    for (const std::string& script : scripts) {
        Document before = put_aside();
        const std::optional<Shown> seen = last_shown_;
        const std::optional<std::string> name = name_of_tool(script);
        put_back(std::move(before));
        show_again(seen);
        if (!name) continue;
        names += (names.empty() ? "" : ", ") + *name;
        found.emplace_back(script, *name);
    }
    if (!found.empty()) tell(LineKind::result, "tools that have a button now: " + names);
    {
        const std::lock_guard lock(mutex_);
        shared_.news.tools.insert(shared_.news.tools.end(), found.begin(), found.end());
    }
    wake_();
}

// Nothing if the script fails or is no tool, which is told.
std::optional<std::string> Session::name_of_tool(const std::string& script) {
    open_script({script, {}});
    const cli::ScriptResult result = script_->run_file(script);
    if (result.status != cli::kSuccess) {
        tell(LineKind::error, result.message);
        return std::nullopt;
    }
    if (auto name = bench_->tool_among({1, lua_gettop(script_->lua())})) return name;
    tell(LineKind::warning, script + " is no tool: drop it alone to run it");
    return std::nullopt;
}

// Red lines stay: a file that works again is told below them.
void Session::tell_whether_mended(const std::string& file, bool works) {
    if (works && broken_ == file) tell(LineKind::result, file + " works again");
    if (!works) broken_ = file;
    if (works) broken_.clear();
}

// Returns whether the values on the stack can be seen; values that cannot be drawn are reported
// when shown.
bool Session::has_values() {
    lua_State* L = script_->lua();
    try {
        return !lua::is_empty(lua::picture_of_values(L, 1, lua_gettop(L)));
    } catch (const std::exception&) {
        return true;
    }
}

// Shows the values on the stack; returns false if there is nothing to see.
bool Session::show_values() {
    lua_State* L = script_->lua();
    try {
        Picture picture = lua::picture_of_values(L, 1, lua_gettop(L));
        if (lua::is_empty(picture)) return false;
        show(frozen_.freeze(std::move(picture)));
    } catch (const Error& error) {
        tell(LineKind::error, error.message());
    } catch (const std::bad_alloc&) {
        tell(LineKind::error, "there is no memory to show this");
    }
    return true;
}

// The old document stays if the files cannot be read.
bool Session::load_files(const std::vector<std::string>& paths, bool is_new) {
    Document before = put_aside();
    open_script({});
    const bool works = succeeds(bench_->open(paths, options_.load));
    if (!works) put_back(std::move(before));
    if (!works && !keeps_failed(paths, is_new)) return false;
    if (is_new) adopt(paths);
    set_files({paths.begin(), paths.end()});
    if (!works) return false;
    forget_script();
    settle_scene(paths);
    tell_sizes();
    return true;
}

void Session::tell_sizes() {
    const ToolPicture seen = bench_->picture();
    const std::string hint = unlike_sizes(seen.picture.meshes, seen.names);
    if (!hint.empty()) tell(LineKind::warning, hint);
}

// ---- Recordings

// The old document stays if the recording cannot be opened.
bool Session::open_recording(const std::string& path, bool is_new) {
    Document before = put_aside();
    open_script({});
    recording_ = {};
    const bool works = succeeds(bench_->open_recording(path, recording_));
    if (!works) put_back(std::move(before));
    if (!works && !keeps_failed({path}, is_new)) return false;
    if (is_new) adopt({path});
    set_files({path});
    if (!works) return false;
    forget_script();
    settle_scene(recording_.files, false);
    events_played_ = 0;
    plays_ = shows_hand_ = !recording_.times.empty();
    const std::lock_guard lock(mutex_);
    shared_.news.playback = Playback{path, recording_.times};
    return true;
}

void Session::play(std::size_t event) {
    const std::size_t count = recording_.times.size();
    if (!plays_ || event >= count) return;
    PlayedEvent done;
    cli::ScriptResult result = bench_->play(event, done);
    if (!done.difference.empty()) tell(LineKind::error, done.difference);
    if (done.tool) keep_tool(*done.tool);
    if (result.status != cli::kSuccess) {
        if (!plays_.exchange(false)) result.message = "a step was stopped and taken back";
        result.message = "event " + std::to_string(event + 1) + " of " + std::to_string(count) +
                         ", " + recording_.kinds[event] + ": " + result.message;
        succeeds(result);
        return let_go();
    }
    events_played_ = event + 1;
    if (event + 1 < count) return;
    plays_ = false;
    let_go();
    if (done.differs) return;
    tell(LineKind::result,
         "played " + std::to_string(count) + " events, which come to the scene that was recorded");
}

// A recording that ends early leaves no button down.
void Session::let_go() {
    if (!bench_ || !bench_->has_scene() || !bench_->is_held()) return;
    ToolInput cancel;
    cancel.kind = ToolInput::Kind::cancel;
    succeeds(bench_->take(cancel));
}

// ---- Tools

// Reports an error; returns false then.
bool Session::succeeds(const cli::ScriptResult& result) {
    if (result.status == cli::kSuccess) return true;
    if (!given_up_) tell(LineKind::error, result.message);
    recover();
    return false;
}

void Session::recover() {
    // Somebody may go on pressing Escape.
    constexpr int kMostTimes = 20;
    for (int i = 0; bench_ && i < kMostTimes; ++i) {
        program_.forget_interrupt();
        if (bench_->recover()) break;
    }
}

// A scene is there that was not before: it is seen and recorded as `open`, and the tool works on
// it unless a recording brings its own.
void Session::settle_scene(const std::vector<std::string>& open, bool takes_tool) {
    ++scene_number_;
    if (bench_->has_scene()) {
        bench_->publish_scene();
        succeeds(bench_->take(look_));
        for (const auto& begun : records_.begin(*bench_, open, options_.load)) succeeds(begun);
        // A recording begins with the scene that the script has made.
        const bool selects = !records_.has_recording();
        if (!kept_.empty()) succeeds(bench_->restore(std::exchange(kept_, ""), selects));
        if (!options_.tool.empty() && takes_tool) settle_tool(options_.tool);
        if (pictures_ == 0) return show_scene(true);
    }
    ToolState state = bench_->state();
    state.hand.reset();
    state.scene = scene_number_;
    const std::lock_guard lock(mutex_);
    shared_.news.tool_state = std::move(state);
}

bool Session::settle_tool(const std::string& word) {
    if (!bench_ || !bench_->has_scene()) {
        tell(LineKind::warning,
             "tools work on a scene: open meshes, or let the script return a scene or meshes");
        return false;
    }
    const bool done =
        succeeds(bench_->use(word, word.ends_with(".lua") ? records_.told_path(word) : word));
    tell_whether_mended(word, done);
    const std::vector<fs::path> files = bench_->tool_files(word);
    const std::lock_guard lock(mutex_);
    shared_.tool_files = files;
    return done;
}

// A recording has taken it in hand.
void Session::keep_tool(const std::string& word) {
    options_.tool = word;
    const std::vector<fs::path> files = bench_->tool_files(word);
    const std::lock_guard lock(mutex_);
    shared_.tool_files = files;
}

void Session::take_inputs() {
    std::unique_lock lock(mutex_);
    if (shared_.inputs.empty()) return;
    const std::vector<ToolInput> inputs = std::move(shared_.inputs.front());
    shared_.inputs.pop_front();
    lock.unlock();
    begin_work();
    bool only_looks = true;
    auto seen = Clock::now();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ToolInput& input = inputs[i];
        if (input.kind == ToolInput::Kind::look) look_ = input;
        if (!bench_ || !bench_->has_scene()) continue;
        const bool is_hover = input.kind == ToolInput::Kind::move && !bench_->is_held();
        const bool is_late = is_followed(inputs, i);
        if (is_hover && is_late) continue;
        only_looks = only_looks && (is_hover || input.kind == ToolInput::Kind::look);
        take_input(input, is_late);
        if (seconds_since(seen) < kLongStroke || i + 1 == inputs.size()) continue;
        show_scene(!std::exchange(only_looks, true));
        seen = Clock::now();
    }
    show_scene(!only_looks);
}

void Session::take_input(const ToolInput& input, bool is_late) {
    if (input.kind == ToolInput::Kind::play) {
        play(input.event);
    } else if (input.kind == ToolInput::Kind::stop) {
        let_go();
    } else {
        succeeds(bench_->take(input, is_late));
    }
}

// Draws the marks of the tool; an error that comes again with every event is told once.
void Session::draw_marks() {
    const cli::ScriptResult drawn = bench_->draw();
    const bool fails = drawn.status != cli::kSuccess;
    if (fails && drawn.message == draw_error_) return recover();
    succeeds(drawn);
    draw_error_ = fails ? drawn.message : "";
}

// Shows the scene with the tool's marks; unchanged ones only if `always`.
void Session::show_scene(bool always) {
    if (!bench_ || !bench_->has_scene()) return;
    draw_marks();
    try {
        ToolState state = bench_->state();
        state.scene = scene_number_;
        if (state.camera) look_.camera = *state.camera;
        if (state.up) look_.up = *state.up;
        if (!shows_hand_) state.hand.reset();
        // The last event shows it as well.
        shows_hand_ = plays_;
        const bool same = state == last_state_ && !state.camera;
        if (same && !always) return;
        ToolPicture seen = bench_->picture();
        show(frozen_.freeze(std::move(seen.picture)), std::move(seen.names));
        last_state_ = state;
        const std::lock_guard lock(mutex_);
        // One that the window has not seen yet.
        if (shared_.news.tool_state && !state.camera) {
            state.camera = shared_.news.tool_state->camera;
            state.up = shared_.news.tool_state->up;
        }
        shared_.news.tool_state = std::move(state);
    } catch (const Error& error) {
        tell(LineKind::error, error.message());
    } catch (const std::bad_alloc&) {
        tell(LineKind::error, "there is no memory to show this");
    }
    const std::string problem = always ? records_.save(*bench_) : "";
    if (!problem.empty()) tell(LineKind::error, problem);
    wake_();
}

// The state of the script, else one of its own, with the variable `lissom`.
lua_State* Session::console_state() {
    begin_work();
    if (!script_) open_script({});
    lua_State* L = script_->lua();
    lua_settop(L, 0);
    provide_library(L);
    return L;
}

void Session::find_completions(const std::string& text) {
    Completion completion{text, cli::completions(console_state(), text)};
    lua_settop(script_->lua(), 0);
    {
        const std::lock_guard lock(mutex_);
        shared_.news.completion = std::move(completion);
    }
    wake_();
}

void Session::evaluate_line(const std::string& line) {
    lua_State* L = console_state();
    const std::string expression = "return " + line;
    const std::string statement = cli::with_session_variables(line);
    const auto load = [&](const std::string& text) {
        return luaL_loadbufferx(L, text.data(), text.size(), "=console", "t") == LUA_OK;
    };
    bool loaded = load(expression);
    if (!loaded) {
        lua_settop(L, 0);
        loaded = load(statement);
    }
    if (!loaded) {
        tell(LineKind::error, lua_tostring(L, -1));
    } else {
        bench_->begin_outside();
        const cli::ScriptResult result = script_->call_function();
        const bool failed = result.status != cli::kSuccess;
        begin_work();
        if (bench_->changed_outside(statement, failed)) {
            tell(LineKind::warning,
                 "the recording does not hold lines of the console: it cannot be repeated");
        }
        if (failed) {
            tell(LineKind::error, result.message);
            show_scene(true);
        } else {
            for (int i = 1; i <= lua_gettop(L); ++i) tell(LineKind::result, cli::display(L, i));
            const bool holds = bench_->holds({1, lua_gettop(L)});
            if (holds || !show_values()) show_scene(true);
        }
    }
    lua_settop(L, 0);
    wake_();
}

void Session::show(Picture picture, std::vector<std::string> names) {
    Shown next;
    next.names = std::move(names);
    try {
        next.snapshot = snapshot_of(picture);
        next.bounds = bounds_.of(next.snapshot);
    } catch (const Error& error) {
        return tell(LineKind::error, error.message());
    }
    next.picture = std::make_shared<const Picture>(std::move(picture));
    {
        const std::lock_guard lock(mutex_);
        next.number = ++shared_.number;
        last_shown_ = next;
        shared_.news.shown = std::move(next);
    }
    wake_();
}

void Session::tell(LineKind kind, const std::string& text) {
    {
        const std::lock_guard lock(mutex_);
        if (shared_.news.lines.size() < kMostLines) shared_.news.lines.push_back({kind, text});
    }
    wake_();
}

void Session::publish_parameters() {
    const auto& declared = script_->state().parameters;
    const std::lock_guard lock(mutex_);
    if (declared) shared_.news.parameters = declared->list;
}

void Session::find_files(const std::string& script) {
    std::vector<fs::path> files = module_files(script_->lua());
    files.emplace_back(script);
    set_files(std::move(files));
}

// Files that the open document was read from.
void Session::set_files(std::vector<fs::path> files) {
    const std::lock_guard lock(mutex_);
    shared_.files = std::move(files);
}

// print, with the session as upvalue 1.
int Session::print(lua_State* L) {
    auto* session = static_cast<Session*>(lua_touserdata(L, lua_upvalueindex(1)));
    const int count = lua_gettop(L);
    for (int i = 1; i <= count; ++i) luaL_tolstring(L, i, nullptr);
    lua::Failure failure;
    failure.guard([&] {
        std::string text;
        for (int i = 1; i <= count; ++i) {
            text += (i > 1 ? "\t" : "");
            text += lua_tostring(L, count + i);
        }
        session->tell(LineKind::message, text);
    });
    return 0;
}

}  // namespace lissom::window
