#include "viewer/window/document/console.h"

#include <utility>

#include "bindings/cli/repl/display.h"
#include "bindings/cli/repl/session_text.h"
#include "viewer/window/session/script_setup.h"

namespace lissom::window {

// The state of the script, else one of its own, with the variable `lissom`.
lua_State* Console::state() {
    parts_.control.begin();
    if (!scene_.has_script()) scene_.open({});
    lua_State* L = scene_.script().lua();
    lua_settop(L, 0);
    provide_library(L);
    return L;
}

void Console::complete(const std::string& text) {
    lua_State* L = state();
    Completion completion{text, cli::completions(L, text)};
    lua_settop(L, 0);
    parts_.news.change([&](SessionNews& news) { news.completion = std::move(completion); });
    parts_.news.wake();
}

void Console::evaluate(const std::string& line) {
    lua_State* L = state();
    const std::string statement = cli::with_session_variables(line);
    if (load(L, line, statement)) {
        run(L, statement);
    } else {
        parts_.news.tell(LineKind::error, lua_tostring(L, -1));
    }
    lua_settop(L, 0);
    parts_.news.wake();
}

// Pushes the line as a function: an expression, or else a statement.
bool Console::load(lua_State* L, const std::string& line, const std::string& statement) {
    const auto loads = [&](const std::string& text) {
        lua_settop(L, 0);
        return luaL_loadbufferx(L, text.data(), text.size(), "=console", "t") == LUA_OK;
    };
    return loads("return " + line) || loads(statement);
}

void Console::run(lua_State* L, const std::string& statement) {
    scene_.bench().begin_outside();
    const cli::ScriptResult result = scene_.script().call_function();
    const bool failed = result.status != cli::kSuccess;
    parts_.control.begin();
    if (scene_.bench().changed_outside(statement, failed)) {
        parts_.news.tell(LineKind::warning,
                         "the recording does not hold lines of the console: it cannot be repeated");
    }
    if (!failed) return show_results(L);
    parts_.news.tell(LineKind::error, result.message);
    scene_.show(true);
}

void Console::show_results(lua_State* L) {
    for (int i = 1; i <= lua_gettop(L); ++i) {
        parts_.news.tell(LineKind::result, cli::display(L, i));
    }
    const bool holds = scene_.bench().holds({1, lua_gettop(L)});
    if (holds || !scene_.show_values()) scene_.show(true);
}

}  // namespace lissom::window
