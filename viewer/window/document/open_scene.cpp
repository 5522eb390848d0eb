#include "viewer/window/document/open_scene.h"

#include <utility>

#include "bindings/cli/terminal/interrupt.h"
#include "bindings/lua/core/failure.h"
#include "viewer/lua/shown_values.h"
#include "viewer/lua/viewer_library.h"
#include "viewer/window/session/script_setup.h"

namespace lissom::window {

OpenScene::OpenScene(SessionParts parts, SessionOptions options)
    : parts_(parts),
      options_(std::move(options)),
      records_(options_.record, options_.journal),
      pictures_(parts.news) {
    look_.kind = ToolInput::Kind::look;
    look_.size = {1280, 960};
    listener_ = [this](const Picture& picture) {
        ++pictures_shown_;
        pictures_.show(picture);
    };
}

// ---- States of Lua

void OpenScene::open(const lua::ScriptArguments& arguments) {
    close();
    script_ = std::make_unique<cli::Script>(parts_.program, arguments);
    bench_ = std::make_unique<ToolBench>(*script_);
    lua_State* L = script_->lua();
    lua_pushlightuserdata(L, &parts_.news);
    lua_pushcclosure(L, print, 1);
    lua_setglobal(L, "print");
    guard_exit(L);
    lua::set_picture_listener(L, &listener_);
    pictures_shown_ = 0;
}

void OpenScene::close() {
    bench_.reset();
    script_.reset();
}

OpenScene::State OpenScene::put_aside() {
    return {std::move(script_), std::move(bench_), pictures_shown_, pictures_.last()};
}

void OpenScene::put_back(State state) {
    bench_ = std::move(state.bench);
    script_ = std::move(state.script);
    pictures_shown_ = state.pictures;
    if (script_) cli::Interrupt::attend(script_->lua());
}

// print, with the board of news as upvalue 1.
int OpenScene::print(lua_State* L) {
    auto* news = static_cast<NewsBoard*>(lua_touserdata(L, lua_upvalueindex(1)));
    const int count = lua_gettop(L);
    for (int i = 1; i <= count; ++i) luaL_tolstring(L, i, nullptr);
    lua::Failure failure;
    failure.guard([&] {
        std::string text;
        for (int i = 1; i <= count; ++i) {
            text += (i > 1 ? "\t" : "");
            text += lua_tostring(L, count + i);
        }
        news->tell(LineKind::message, text);
    });
    return 0;
}

// ---- Results

bool OpenScene::succeeds(const cli::ScriptResult& result) {
    if (result.status == cli::kSuccess) return true;
    if (!parts_.control.is_given_up()) parts_.news.tell(LineKind::error, result.message);
    recover();
    return false;
}

void OpenScene::recover() {
    // Somebody may go on pressing Escape.
    constexpr int kMaxTimes = 20;
    for (int i = 0; bench_ && i < kMaxTimes; ++i) {
        parts_.program.forget_interrupt();
        if (bench_->recover()) break;
    }
}

void OpenScene::tell_whether_mended(const std::string& file, bool works) {
    if (works && broken_ == file) parts_.news.tell(LineKind::result, file + " works again");
    if (!works) broken_ = file;
    if (works) broken_.clear();
}

bool OpenScene::has_values() {
    lua_State* L = script_->lua();
    try {
        return !lua::is_empty(lua::picture_of_values(L, 1, lua_gettop(L)));
    } catch (const std::exception&) {
        return true;
    }
}

bool OpenScene::show_values() {
    lua_State* L = script_->lua();
    try {
        Picture picture = lua::picture_of_values(L, 1, lua_gettop(L));
        if (lua::is_empty(picture)) return false;
        pictures_.show(std::move(picture));
    } catch (const Error& error) {
        parts_.news.tell(LineKind::error, error.message());
    } catch (const std::bad_alloc&) {
        parts_.news.tell(LineKind::error, "there is no memory to show this");
    }
    return true;
}

// An error that comes again with every event is told once.
void OpenScene::draw_marks() {
    const cli::ScriptResult drawn = bench_->draw();
    const bool fails = drawn.status != cli::kSuccess;
    if (fails && drawn.message == draw_error_) return recover();
    succeeds(drawn);
    draw_error_ = fails ? drawn.message : "";
}

void OpenScene::show(bool always) {
    if (!has_scene()) return;
    draw_marks();
    try {
        if (!show_changes(always)) return;
    } catch (const Error& error) {
        parts_.news.tell(LineKind::error, error.message());
    } catch (const std::bad_alloc&) {
        parts_.news.tell(LineKind::error, "there is no memory to show this");
    }
    const std::string problem = always ? records_.save(*bench_) : "";
    if (!problem.empty()) parts_.news.tell(LineKind::error, problem);
    parts_.news.wake();
}

// Returns false if the scene is as it was shown last, and is not shown `always`.
bool OpenScene::show_changes(bool always) {
    ToolState state = bench_->state();
    state.scene = number_;
    if (state.camera) look_.camera = *state.camera;
    if (state.up) look_.up = *state.up;
    if (!shows_hand_) state.hand.reset();
    // The last event shows it as well.
    shows_hand_ = parts_.playing.goes_on;
    if (state == last_state_ && !state.camera && !always) return false;
    ToolPicture seen = bench_->picture();
    pictures_.show(std::move(seen.picture), std::move(seen.names));
    last_state_ = state;
    publish(std::move(state));
    return true;
}

// A camera that the window has not seen yet stays.
void OpenScene::publish(ToolState state) {
    parts_.news.change([&](SessionNews& news) {
        if (news.tool_state && !state.camera) {
            state.camera = news.tool_state->camera;
            state.up = news.tool_state->up;
        }
        news.tool_state = std::move(state);
    });
}

// ---- Scene and tool

void OpenScene::settle(const std::vector<std::string>& open, bool takes_tool) {
    ++number_;
    if (bench_->has_scene()) {
        bench_->publish_scene();
        succeeds(bench_->take(look_));
        for (const auto& begun : records_.begin(*bench_, open, options_.load)) succeeds(begun);
        // A recording begins with the scene that the script has made.
        const bool selects = !records_.has_recording();
        if (!kept_.empty()) succeeds(bench_->restore(std::exchange(kept_, ""), selects));
        if (!options_.tool.empty() && takes_tool) settle_tool(options_.tool);
        if (pictures_shown_ == 0) return show(true);
    }
    ToolState state = bench_->state();
    state.hand.reset();
    state.scene = number_;
    parts_.news.change([&](SessionNews& news) { news.tool_state = std::move(state); });
}

void OpenScene::keep_selection() {
    if (bench_) kept_ = bench_->kept().value_or(kept_);
}

bool OpenScene::use_tool(const std::string& word) {
    const bool done = settle_tool(word);
    if (done) options_.tool = word;
    return done;
}

bool OpenScene::settle_tool(const std::string& word) {
    if (!has_scene()) {
        parts_.news.tell(LineKind::warning,
                         "tools work on a scene: open meshes, or let the script return a scene or "
                         "meshes");
        return false;
    }
    const bool done =
        succeeds(bench_->use(word, word.ends_with(".lua") ? records_.told_path(word) : word));
    tell_whether_mended(word, done);
    parts_.names.set_tool_files(bench_->tool_files(word));
    return done;
}

void OpenScene::keep_tool(const std::string& word) {
    options_.tool = word;
    parts_.names.set_tool_files(bench_->tool_files(word));
}

void OpenScene::let_go() {
    if (!has_scene() || !bench_->is_held()) return;
    ToolInput cancel;
    cancel.kind = ToolInput::Kind::cancel;
    succeeds(bench_->take(cancel));
}

}  // namespace lissom::window
