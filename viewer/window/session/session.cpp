#include "viewer/window/session/session.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <utility>

#include "bindings/cli/repl/display.h"
#include "bindings/cli/repl/help_function.h"
#include "bindings/cli/repl/session_text.h"
#include "bindings/cli/script_text.h"
#include "bindings/cli/terminal/interrupt.h"
#include "bindings/lua/core/failure.h"
#include "viewer/lua/shown_values.h"
#include "viewer/lua/viewer_library.h"
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

// Refuses os.exit, which would end the window and its contents.
int refuse_exit(lua_State* L) {
    return luaL_error(L, "os.exit does not end the window: return, or raise an error");
}

// Puts `refuse_exit` into the library `os`. Runs inside lua_pcall.
int guard_exit(lua_State* L) {
    lua_getglobal(L, "os");
    lua_pushcfunction(L, refuse_exit);
    lua_setfield(L, -2, "exit");
    return 0;
}

// Adds the files of the modules that the state has loaded to the list at upvalue 1. Runs inside
// lua_pcall: a script may have put anything in the place of `package`.
int list_module_files(lua_State* L) {
    auto* files = static_cast<std::vector<fs::path>*>(lua_touserdata(L, lua_upvalueindex(1)));
    lua_getglobal(L, "package");
    lua_getfield(L, 1, "loaded");
    lua_pushnil(L);
    while (lua_next(L, 2)) {
        lua_settop(L, 3);
        if (lua_type(L, 3) != LUA_TSTRING) continue;
        lua_getfield(L, 1, "searchpath");
        lua_pushvalue(L, 3);
        lua_getfield(L, 1, "path");
        lua_call(L, 2, 1);
        lua::Failure failure;
        const char* found = lua_tostring(L, 4);
        failure.guard([&] {
            if (found) files->emplace_back(found);
        });
        lua_settop(L, 3);
    }
    return 0;
}

bool has_global(lua_State* L, const char* name) {
    lua_getglobal(L, name);
    const bool has = !lua_isnil(L, -1);
    lua_pop(L, 1);
    return has;
}

// Provides the variables `lissom` and `help`, for lines of the console, if the script has none.
// Runs inside lua_pcall.
int provide_library(lua_State* L) {
    if (!has_global(L, "help")) {
        lua_getglobal(L, "require");
        lua_pushliteral(L, "lissom");
        lua_call(L, 1, 1);
        cli::provide_help(L);
    }
    if (has_global(L, "lissom")) return 0;
    lua_getglobal(L, "require");
    lua_pushliteral(L, "lissom");
    lua_call(L, 1, 1);
    lua_setglobal(L, "lissom");
    return 0;
}

// Writes a file whole or not at all.
bool write_whole(const std::string& path, const std::string& text) {
    const std::string beside = path + ".part";
    std::error_code error;
    {
        std::ofstream file(beside, std::ios::binary);
        if (!(file << text && file.flush())) {
            file.close();
            fs::remove(beside, error);
            return false;
        }
    }
    fs::rename(beside, path, error);
    return !error;
}

std::string without_digits(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return text;
}

}  // namespace

void add_line(std::vector<ConsoleLine>& lines, ConsoleLine line) {
    const bool repeats = !lines.empty() && line.kind == LineKind::warning &&
                         lines.back().kind == line.kind &&
                         without_digits(lines.back().text) == without_digits(line.text);
    if (repeats) {
        line.times += lines.back().times;
        lines.back() = std::move(line);
    } else {
        lines.push_back(std::move(line));
    }
}

bool is_script(const std::string& word) {
    return fs::path(word).extension() == ".lua";
}

bool is_recording(const std::string& word) {
    if (!is_script(word)) return false;
    const std::optional<std::string> text = cli::script_text(word);
    return text && cli::is_recording(*text);
}

Session::Session(cli::Program& program, std::function<void()> wake, SessionOptions options)
    : program_(program), wake_(std::move(wake)), options_(std::move(options)) {
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
        news_.stage = label;
        news_.fraction = fraction;
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
        news_.asked = words;
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
        if (news_.words.empty()) return;
        if (is_script(news_.words.front())) {
            news_.words.resize(1);
            news_.words.insert(news_.words.end(), words.begin(), words.end());
        }
    }
    opened_ = asked_.load();
    give_up();
    post_only([this] {
        std::unique_lock lock(mutex_);
        const std::vector<std::string> now = news_.words;
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
    news_.stage.clear();
    news_.fraction = 0.0;
    news_.work_began = Clock::now();
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
        if (busy() && seconds_since(news_.work_began) > kLongWork) cancel();
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
    news_.last_setting.reset();
    if (!news_.takes_inputs_last || news_.inputs.empty()) {
        news_.inputs.emplace_back();
        news_.takes_inputs_last = true;
        worker_.post([this] { take_inputs(); });
    }
    push_input(news_.inputs.back(), std::move(input));
}

void Session::post_job(Worker::Job job) {
    const std::lock_guard lock(mutex_);
    news_.takes_inputs_last = false;
    news_.last_setting.reset();
    worker_.post(std::move(job));
}

// Drops waiting jobs; but the view known by now counts for the next ones, too.
void Session::post_only(Worker::Job job) {
    const std::lock_guard lock(mutex_);
    std::vector<ToolInput> kept;
    for (std::vector<ToolInput>& batch : std::exchange(news_.inputs, {})) {
        for (ToolInput& input : batch) {
            if (input.kind == ToolInput::Kind::look) kept = {std::move(input)};
        }
    }
    worker_.post_only(std::move(job));
    news_.last_setting.reset();
    news_.takes_inputs_last = !kept.empty();
    if (kept.empty()) return;
    news_.inputs.push_back(std::move(kept));
    worker_.post([this] { take_inputs(); });
}

void Session::copy_scene(const std::string& path, const std::string& journal) {
    post_job([this, path, journal] {
        if (!bench_ || !bench_->has_scene() || bench_->is_held()) return;
        begin_work();
        std::string left_out;
        if (!succeeds(bench_->save(path, left_out)) || !options_.journal.empty()) return;
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
        news_.saved = change;
    };
    const std::lock_guard lock(mutex_);
    news_.takes_inputs_last = false;
    news_.last_setting.reset();
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
    news_.takes_inputs_last = false;
    news_.last_setting.reset();
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
    if (news_.last_setting && news_.last_setting->first == name) {
        news_.last_setting->second = value;
        return;
    }
    auto setting = std::make_shared<Setting>(name, value);
    news_.takes_inputs_last = false;
    news_.last_setting = setting;
    worker_.post([this, setting] { set_parameter(setting); });
}

void Session::set_parameter(const std::shared_ptr<Setting>& setting) {
    std::unique_lock lock(mutex_);
    if (news_.last_setting == setting) news_.last_setting.reset();
    const auto [name, value] = *setting;
    lock.unlock();
    if (!bench_ || !bench_->has_scene()) return;
    begin_work();
    succeeds(bench_->set(name, value));
    show_scene(true);
}

bool Session::is_opening() const {
    const std::lock_guard lock(mutex_);
    return opened_ != asked_ && !news_.words.empty() && news_.asked != news_.words;
}

bool Session::has_setting() const {
    const std::lock_guard lock(mutex_);
    return news_.last_setting != nullptr;
}

std::optional<Playback> Session::take_playback() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.playback, std::nullopt);
}

void Session::stop_playing() {
    if (!plays_.exchange(false)) return;
    cancel();
    ToolInput stop;
    stop.kind = ToolInput::Kind::stop;
    post(std::move(stop));
}

std::optional<ToolState> Session::take_tool_state() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.tool_state, std::nullopt);
}

std::vector<fs::path> Session::tool_files() const {
    const std::lock_guard lock(mutex_);
    return news_.tool_files;
}

std::pair<std::string, double> Session::progress() const {
    const std::lock_guard lock(mutex_);
    return {news_.stage, news_.fraction};
}

std::optional<std::vector<std::string>> Session::take_opened() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.opened, std::nullopt);
}

std::optional<std::uint64_t> Session::take_saved() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.saved, std::nullopt);
}

std::vector<std::pair<std::string, std::string>> Session::take_tools() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.tools, {});
}

std::optional<Shown> Session::take_shown() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.shown, std::nullopt);
}

std::vector<ConsoleLine> Session::take_lines() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.lines, {});
}

std::optional<std::vector<lua::ScriptParameter>> Session::take_parameters() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.parameters, std::nullopt);
}

std::optional<Completion> Session::take_completion() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_.completion, std::nullopt);
}

std::vector<fs::path> Session::files() const {
    const std::lock_guard lock(mutex_);
    return news_.files;
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
    news_.words = words;
    news_.opened = words;
    news_.parameters = std::vector<lua::ScriptParameter>();
}

bool Session::has_words() const {
    const std::lock_guard lock(mutex_);
    return !news_.words.empty();
}

// Returns whether the failed words are the open document, to be mended and read again.
bool Session::keeps_failed(const std::vector<std::string>& words, bool is_new) const {
    const std::lock_guard lock(mutex_);
    const bool is_same_script = is_script(words.front()) && news_.words.front() == words.front();
    return !is_new || is_same_script || news_.words == words;
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
    last_shown_->number = ++news_.number;
    news_.shown = last_shown_;
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
    lua_pushcfunction(L, guard_exit);
    if (lua_pcall(L, 0, 0, 0) != LUA_OK) lua_pop(L, 1);
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
    const bool is_tool = works && bench_->is_tool(1, lua_gettop(script_->lua()));
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
    return bench_->has_scene_among(1, lua_gettop(script_->lua()));
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
    succeeds(bench_->take_values(1, lua_gettop(L)));
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
        news_.tools.insert(news_.tools.end(), found.begin(), found.end());
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
    const int count = lua_gettop(script_->lua());
    if (bench_->is_tool(1, count)) return bench_->tool_name(1);
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
    const Picture picture = bench_->picture();
    const std::string hint = unlike_sizes(picture.meshes, bench_->names_of(picture));
    if (!hint.empty()) tell(LineKind::warning, hint);
}

// ---- Recordings

// The old document stays if the recording cannot be opened.
bool Session::open_recording(const std::string& path, bool is_new) {
    Document before = put_aside();
    open_script({});
    Playback playback{path, {}};
    std::vector<std::string> files;
    const bool works = succeeds(bench_->open_recording(path, files, playback.times));
    if (!works) put_back(std::move(before));
    if (!works && !keeps_failed({path}, is_new)) return false;
    if (is_new) adopt({path});
    set_files({path});
    if (!works) return false;
    forget_script();
    settle_scene(files, false);
    event_count_ = playback.times.size();
    events_played_ = 0;
    plays_ = shows_hand_ = event_count_ > 0;
    const std::lock_guard lock(mutex_);
    news_.playback = std::move(playback);
    return true;
}

void Session::play(std::size_t event) {
    if (!plays_ || event >= event_count_) return;
    PlayedEvent done;
    cli::ScriptResult result = bench_->play(event, done);
    if (!done.difference.empty()) tell(LineKind::error, done.difference);
    if (done.tool) keep_tool(*done.tool);
    if (result.status != cli::kSuccess) {
        if (!plays_.exchange(false)) result.message = "a step was stopped and taken back";
        result.message = "event " + std::to_string(event + 1) + " of " +
                         std::to_string(event_count_) + ", " + bench_->event_kind(event) + ": " +
                         result.message;
        succeeds(result);
        return let_go();
    }
    events_played_ = event + 1;
    if (event + 1 < event_count_) return;
    plays_ = false;
    let_go();
    if (!bench_->play_differs()) {
        tell(LineKind::result, "played " + std::to_string(event_count_) +
                                   " events, which come to the scene that was recorded");
    }
}

// A recording that ends early leaves no button down.
void Session::let_go() {
    if (!bench_ || !bench_->has_scene() || !bench_->is_held()) return;
    ToolInput cancel;
    cancel.kind = ToolInput::Kind::cancel;
    succeeds(bench_->take(cancel));
}

// Returns a recording's name of a file: its place beside or below the recording, else its whole
// path.
std::string Session::told_path(const std::string& path) const {
    if (options_.record.empty()) return path;
    std::error_code error;
    const auto folder_of = [&](const fs::path& file) {
        return fs::weakly_canonical(fs::absolute(file, error).parent_path(), error);
    };
    const fs::path from = folder_of(options_.record);
    const fs::path whole = folder_of(path) / fs::path(path).filename();
    const fs::path below = whole.lexically_relative(from);
    const bool is_below = !below.empty() && *below.begin() != "..";
    return (is_below ? below : whole).generic_string();
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

// A journal that was not asked for lies elsewhere: it calls files by their whole paths.
void Session::begin_records(const std::vector<std::string>& open) {
    std::vector<std::string> told, whole;
    std::error_code error;
    for (const std::string& path : open) {
        told.push_back(told_path(path));
        whole.push_back(fs::absolute(path, error).generic_string());
    }
    if (!options_.record.empty()) succeeds(bench_->record("record", told, options_.load));
    succeeds(
        bench_->record("keep_journal", options_.journal.empty() ? whole : open, options_.load));
}

// A scene is there that was not before: it is seen and recorded as `open`, and the tool works on
// it unless a recording brings its own.
void Session::settle_scene(const std::vector<std::string>& open, bool takes_tool) {
    ++scene_number_;
    if (bench_->has_scene()) {
        bench_->publish_scene();
        succeeds(bench_->take(look_));
        begin_records(open);
        // A recording begins with the scene that the script has made.
        const bool selects = options_.record.empty();
        if (!kept_.empty()) succeeds(bench_->restore(std::exchange(kept_, ""), selects));
        if (!options_.tool.empty() && takes_tool) settle_tool(options_.tool);
        if (pictures_ == 0) return show_scene(true);
    }
    ToolState state = bench_->state();
    state.scene = scene_number_;
    const std::lock_guard lock(mutex_);
    news_.tool_state = std::move(state);
}

bool Session::settle_tool(const std::string& word) {
    if (!bench_ || !bench_->has_scene()) {
        tell(LineKind::warning,
             "tools work on a scene: open meshes, or let the script return a scene or meshes");
        return false;
    }
    const bool done = succeeds(bench_->use(word, word.ends_with(".lua") ? told_path(word) : word));
    tell_whether_mended(word, done);
    const std::vector<fs::path> files = bench_->tool_files(word);
    const std::lock_guard lock(mutex_);
    news_.tool_files = files;
    return done;
}

// A recording has taken it in hand.
void Session::keep_tool(const std::string& word) {
    options_.tool = word;
    const std::vector<fs::path> files = bench_->tool_files(word);
    const std::lock_guard lock(mutex_);
    news_.tool_files = files;
}

void Session::take_inputs() {
    std::unique_lock lock(mutex_);
    if (news_.inputs.empty()) return;
    const std::vector<ToolInput> inputs = std::move(news_.inputs.front());
    news_.inputs.pop_front();
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
        const ToolBench::Looked looked = bench_->looked();
        state.camera = looked.camera;
        state.up = looked.up;
        if (state.camera) look_.camera = *state.camera;
        if (state.up) look_.up = *state.up;
        if (shows_hand_) state.hand = bench_->hand();
        // The last event shows it as well.
        shows_hand_ = plays_;
        const bool same = state == last_state_ && !state.camera;
        if (same && !always) return;
        Picture picture = bench_->picture();
        std::vector<std::string> names = bench_->names_of(picture);
        show(frozen_.freeze(std::move(picture)), std::move(names));
        last_state_ = state;
        const std::lock_guard lock(mutex_);
        // One that the window has not seen yet.
        if (news_.tool_state && !state.camera) {
            state.camera = news_.tool_state->camera;
            state.up = news_.tool_state->up;
        }
        news_.tool_state = std::move(state);
    } catch (const Error& error) {
        tell(LineKind::error, error.message());
    } catch (const std::bad_alloc&) {
        tell(LineKind::error, "there is no memory to show this");
    }
    if (always) save_records();
    wake_();
}

void Session::save_records() {
    save_record("recording", options_.record, recorded_);
    save_record("journal_text", options_.journal, told_);
}

// Writes the text of the host's method `what`, if it differs from the saved one.
void Session::save_record(const char* what, const std::string& path, std::string& saved) {
    if (path.empty() || bench_->is_held()) return;
    const std::optional<std::string> text = bench_->text_of(what);
    if (!text || *text == saved) return;
    if (write_whole(path, *text)) {
        saved = *text;
        record_fails_ = false;
        return;
    }
    // It is tried again at the next change.
    if (!std::exchange(record_fails_, true)) {
        tell(LineKind::error, "the recording cannot be written to " + path);
    }
}

// The state of the script, else one of its own, with the variable `lissom`.
lua_State* Session::console_state() {
    begin_work();
    if (!script_) open_script({});
    lua_State* L = script_->lua();
    lua_settop(L, 0);
    lua_pushcfunction(L, provide_library);
    if (lua_pcall(L, 0, 0, 0) != LUA_OK) lua_pop(L, 1);
    return L;
}

void Session::find_completions(const std::string& text) {
    Completion completion{text, cli::completions(console_state(), text)};
    lua_settop(script_->lua(), 0);
    {
        const std::lock_guard lock(mutex_);
        news_.completion = std::move(completion);
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
            const bool holds = bench_->holds(1, lua_gettop(L));
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
        next.number = ++news_.number;
        last_shown_ = next;
        news_.shown = std::move(next);
    }
    wake_();
}

void Session::tell(LineKind kind, const std::string& text) {
    {
        const std::lock_guard lock(mutex_);
        if (news_.lines.size() < kMostLines) news_.lines.push_back({kind, text});
    }
    wake_();
}

void Session::publish_parameters() {
    const auto& declared = script_->state().parameters;
    const std::lock_guard lock(mutex_);
    if (declared) news_.parameters = declared->list;
}

void Session::find_files(const std::string& script) {
    std::vector<fs::path> files;
    lua_State* L = script_->lua();
    lua_pushlightuserdata(L, &files);
    lua_pushcclosure(L, list_module_files, 1);
    if (lua_pcall(L, 0, 0, 0) != LUA_OK) lua_pop(L, 1);
    files.emplace_back(script);
    set_files(std::move(files));
}

// Files that the open document was read from.
void Session::set_files(std::vector<fs::path> files) {
    const std::lock_guard lock(mutex_);
    news_.files = std::move(files);
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
