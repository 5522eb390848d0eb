#include "bindings/cli/script.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "bindings/cli/help_guard.h"
#include "bindings/cli/process/child_process.h"
#include "bindings/cli/terminal/interrupt.h"
#include "bindings/cli/terminal/script_place.h"
#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/script_parameters.h"
#include "bindings/lua/host/counted_state.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

bool is_within(const fs::path& path, const fs::path& folder) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(folder, error);
    const fs::path inside = fs::weakly_canonical(path, error).lexically_relative(real);
    return !inside.empty() && *inside.begin() != "..";
}

// Arguments of opening a state, reachable through a light userdata inside lua_pcall.
struct Opening {
    const lua::HostOptions* options;
    lua::Stoppable* stoppable;
    std::string path;
    bool unsafe_debug;
};

int open_lissom(lua_State* L) {
    const auto* options =
        static_cast<const lua::HostOptions*>(lua_touserdata(L, lua_upvalueindex(1)));
    lua::open(L, *options);
    return 1;
}

void set_search_path(lua_State* L, const char* path) {
    lua_getglobal(L, "package");
    lua_getfield(L, -1, "path");
    lua_pushstring(L, path);
    lua_insert(L, -2);
    lua_concat(L, 2);
    lua_setfield(L, -2, "path");
    lua_getfield(L, -1, "preload");
    lua_pushcfunction(L, luaopen_lissom);
    lua_setfield(L, -2, "lissom");
    lua_pop(L, 2);
}

void set_arguments(lua_State* L, const lua::ScriptArguments& arguments) {
    lua_newtable(L);
    lua_pushstring(L, arguments.script.c_str());
    lua_rawseti(L, -2, 0);
    for (std::size_t i = 0; i < arguments.words.size(); ++i) {
        lua_pushstring(L, arguments.words[i].c_str());
        lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
    }
    lua_setglobal(L, "arg");
}

// Runs inside lua_pcall.
int prepare(lua_State* L) {
    const auto* opening = static_cast<const Opening*>(lua_touserdata(L, 1));
    luaL_openlibs(L);
    // Many short-lived tables beside few long-lived native objects suit the generational collector.
    lua_gc(L, LUA_GCGEN, 0, 0);
    lua_pushlightuserdata(L, const_cast<lua::HostOptions*>(opening->options));
    lua_pushcclosure(L, open_lissom, 1);
    lua_call(L, 0, 0);
    set_search_path(L, opening->path.c_str());
    set_arguments(L, opening->options->arguments);
    opening->stoppable->open(L, opening->unsafe_debug);
    Interrupt::watch(L);
    opening->stoppable->open_finalizers(L);
    if (lua::find_state(L)->only_help) guard_for_help(L);
    return 0;
}

std::vector<fs::path> module_folders(const std::string& script) {
    std::vector<fs::path> folders;
    if (!script.empty()) {
        const fs::path folder = fs::path(script).parent_path();
        folders.push_back(folder.empty() ? "." : folder);
    }
    const std::string shipped = Script::shipped_scripts();
    if (!shipped.empty()) folders.push_back(shipped);
    return folders;
}

std::string search_path(const std::string& script) {
    std::string path;
    for (const fs::path& folder : module_folders(script)) {
        path += folder.string() + "/?.lua;" + folder.string() + "/?/init.lua;";
    }
    return path;
}

// A list of the files of all modules loaded.
int push_module_files(lua_State* L) {
    constexpr const char* kText =
        "local files = {}\n"
        "for name in pairs(package.loaded) do\n"
        "    local file = type(name) == 'string' and package.searchpath(name, package.path)\n"
        "    if file then files[#files + 1] = file end\n"
        "end\n"
        "return files";
    if (luaL_loadstring(L, kText) != LUA_OK) return lua_error(L);
    lua_call(L, 0, 1);
    return 1;
}

// ---- Messages

bool starts_with(const char* text, const char* start) {
    return std::strncmp(text, start, std::strlen(start)) == 0;
}

// Whether the message begins with the name of a chunk on the stack, so that file and line are
// there.
bool names_a_chunk(lua_State* L, const char* message) {
    lua_Debug frame;
    for (int level = 0; lua_getstack(L, level, &frame); ++level) {
        lua_getinfo(L, "S", &frame);
        if (starts_with(message, frame.short_src)) return true;
    }
    return false;
}

// A list of name, shown name and line for each line of a script on the stack.
void push_calls(lua_State* L) {
    lua_newtable(L);
    lua_Integer count = 0;
    lua_Debug frame;
    for (int level = 1; level < 100 && lua_getstack(L, level, &frame); ++level) {
        lua_getinfo(L, "Sl", &frame);
        if (frame.source[0] != '@' || frame.currentline < 1) continue;
        lua_pushstring(L, frame.source + 1);
        lua_rawseti(L, -2, ++count);
        lua_pushstring(L, frame.short_src);
        lua_rawseti(L, -2, ++count);
        lua_pushinteger(L, frame.currentline);
        lua_rawseti(L, -2, ++count);
    }
}

// Results of push_calls on top of the stack.
std::vector<ScriptLine> calls_at_top(lua_State* L) {
    std::vector<ScriptLine> calls;
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, -1));
    for (lua_Integer i = 1; i < count; i += 3) {
        lua_rawgeti(L, -1, i);
        lua_rawgeti(L, -2, i + 1);
        lua_rawgeti(L, -3, i + 2);
        calls.push_back(
            {lua_tostring(L, -3), lua_tostring(L, -2), static_cast<int>(lua_tointeger(L, -1))});
        lua_pop(L, 3);
    }
    return calls;
}

// Whether the error at `index` knows the line of a script.
bool has_place(lua_State* L, int index) {
    if (!lua::is_error_object(L, index)) return false;
    lua_getfield(L, index, "place");
    const bool has = lua_type(L, -1) == LUA_TSTRING;
    lua_pop(L, 1);
    return has;
}

// Shortens the text on top of the stack: a script may raise one of any length.
void shorten_text(lua_State* L) {
    constexpr std::size_t kMostBytes = 65536;
    std::size_t bytes = 0;
    const char* const text = lua_tolstring(L, -1, &bytes);
    if (bytes <= kMostBytes) return;
    std::size_t end = kMostBytes;
    // A character of UTF-8 stays whole.
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
    lua_pushlstring(L, text, end);
    lua_pushfstring(L, "... (%d KB)", static_cast<int>(bytes >> 10));
    lua_concat(L, 2);
    lua_remove(L, -2);
}

// The handler of lua_pcall: error -> "file:line: message", the traceback of the place, its calls,
// and its code.
int explain_error(lua_State* L) {
    lua::push_error_text(L, 1);
    shorten_text(L);
    if (!has_place(L, 1) && !names_a_chunk(L, lua_tostring(L, -1))) {
        push_script_place(L, 1);
        lua_insert(L, -2);
        lua_concat(L, 2);
    }
    lua_createtable(L, 4, 0);
    if (lua::is_error_object(L, 1)) {
        lua_getfield(L, 1, "code");
        lua_rawseti(L, -2, 4);
    }
    lua_pushvalue(L, -2);
    lua_rawseti(L, -2, 1);
    luaL_traceback(L, L, nullptr, 1);
    lua_rawseti(L, -2, 2);
    push_calls(L);
    lua_rawseti(L, -2, 3);
    return 1;
}

// Whether a message tells that a nil was used as something else.
bool blames_nil(const std::string& message) {
    return message.find("nil value") != std::string::npos ||
           message.find("got nil") != std::string::npos;
}

// Whether a script used the library without loading it.
bool lacks_require(const std::string& message) {
    return blames_nil(message) && message.find("(global 'lissom')") != std::string::npos;
}

// Whether a script is one of tests, which another verb runs.
bool lacks_tests(const std::string& message) {
    return blames_nil(message) && (message.find("(global 'test')") != std::string::npos ||
                                   message.find("(global 'expect')") != std::string::npos);
}

// Splits "file:line: message".
void find_place(ScriptResult& result) {
    for (std::size_t at = 0; (at = result.message.find(':', at + 1)) != std::string::npos;) {
        std::size_t end = at + 1;
        while (end < result.message.size() &&
               std::isdigit(static_cast<unsigned char>(result.message[end]))) {
            ++end;
        }
        if (end == at + 1 || end >= result.message.size() || result.message[end] != ':') continue;
        result.file = result.message.substr(0, at);
        result.line = std::atoi(result.message.c_str() + at + 1);
        return;
    }
}

// The code in brackets at the end of a message.
std::string code_in(const std::string& message) {
    const std::size_t open = message.rfind('[');
    if (message.empty() || message.back() != ']' || open == std::string::npos) return "";
    return message.substr(open + 1, message.size() - open - 2);
}

}  // namespace

std::string Script::shipped_scripts() {
    std::error_code error;
    const fs::path folder = program_file().parent_path();
    const fs::path installed = folder / ".." / "share" / "lissom" / "scripts";
    if (fs::is_directory(installed, error)) return fs::weakly_canonical(installed, error).string();
    // A folder that is handed on with the program and its scripts in it.
    const fs::path beside = folder / "scripts";
    if (fs::is_regular_file(beside / "hairdo.lua", error)) {
        return fs::weakly_canonical(beside, error).string();
    }
    // A program in its build folder uses the source's modules; an installed or copied one never
    // looks at folders of another machine.
    if (is_within(folder, LISSOM_BUILD_FOLDER) && fs::is_directory(LISSOM_SCRIPTS_FOLDER, error)) {
        return LISSOM_SCRIPTS_FOLDER;
    }
    return "";
}

Script::Script(Program& program, lua::ScriptArguments arguments,
               const std::optional<lua::SandboxLimits>& limits)
    : program_(program), options_(program.host_options()) {
    options_.arguments = std::move(arguments);
    if (limits) {
        open_in_sandbox(*limits);
    } else {
        open_trusted();
    }
    program.listen(state().context);
}

void Script::open_in_sandbox(const lua::SandboxLimits& given) {
    lua::SandboxLimits limits = given;
    limits.module_folders = module_folders(options_.arguments.script);
    sandbox_ =
        std::make_unique<lua::Sandbox>(std::move(limits), options_, [this](std::string_view text) {
            program_.clear_progress();
            std::fwrite(text.data(), 1, text.size(), stdout);
        });
    L_ = sandbox_->lua();
    set_arguments(L_, options_.arguments);
}

void Script::open_trusted() {
    const Opening opening{&options_, &stoppable_, search_path(options_.arguments.script),
                          program_.unsafe_debug};
    lua::OwnedState made(luaL_newstate());
    lua_State* L = made.get();
    if (!L) throw std::bad_alloc();
    lua_pushcfunction(L, prepare);
    lua_pushlightuserdata(L, const_cast<Opening*>(&opening));
    if (lua_pcall(L, 1, 0, 0) != LUA_OK) {
        const char* text = lua_tostring(L, -1);
        throw std::runtime_error(text ? text : "the Lua state cannot be opened");
    }
    stoppable_.follow(lua::find_state(L)->context);
    L_ = made.release();
}

Script::~Script() {
    Interrupt::forget();
    if (!sandbox_) lua_close(L_);
}

// Works as lua_pcall of the function on top of the stack.
int Script::call_protected(int handler) {
    if (sandbox_) return sandbox_->call(0, LUA_MULTRET, handler);
    return lua_pcall(L_, 0, LUA_MULTRET, handler);
}

ScriptResult Script::run_file(const std::string& path) {
    std::error_code error;
    if (!fs::exists(path, error)) {
        ScriptResult result;
        result.status = kFailure;
        result.code = std::string(code_name(ErrorCode::file_not_found));
        result.message = path + ": " + missing_file_text(path) + " [" + result.code + "]";
        return result;
    }
    return run_loaded(luaL_loadfilex(L_, path.c_str(), "t"));
}

ScriptResult Script::run_text(std::string text) {
    // A first line for the shell is no Lua; its place is kept for the numbers of the others.
    if (text.starts_with('#')) text.erase(0, std::min(text.find('\n'), text.size()));
    return run_loaded(luaL_loadbufferx(L_, text.data(), text.size(), "=stdin", "t"));
}

// The chunk or a message is on top of the stack.
ScriptResult Script::run_loaded(int status) {
    if (status != LUA_OK) {
        lua_createtable(L_, 1, 0);
        lua_insert(L_, -2);
        lua_rawseti(L_, -2, 1);
        return failure();
    }
    return call_function();
}

ScriptResult Script::call_function() {
    const int function = lua_gettop(L_);
    lua_pushcfunction(L_, explain_error);
    lua_insert(L_, function);
    const int status = call_protected(function);
    lua_remove(L_, function);
    program_.clear_progress();
    return status == LUA_OK ? ScriptResult{} : failure();
}

std::vector<std::string> Script::module_files() {
    std::vector<std::string> files;
    lua_pushcfunction(L_, push_module_files);
    if (lua_pcall(L_, 0, 1, 0) == LUA_OK) {
        const auto count = static_cast<lua_Integer>(lua_rawlen(L_, -1));
        for (lua_Integer i = 1; i <= count; ++i) {
            lua_rawgeti(L_, -1, i);
            files.emplace_back(lua_tostring(L_, -1));
            lua_pop(L_, 1);
        }
    }
    lua_pop(L_, 1);
    return files;
}

// Takes the table of explain_error from the stack.
ScriptResult Script::failure() {
    ScriptResult result;
    result.status = kFailure;
    const lua::State& opened = state();
    if (opened.script_end != lua::ScriptEnd::none) {
        const bool is_help = opened.script_end == lua::ScriptEnd::help;
        result.status = is_help ? kSuccess : kUsage;
        result.message = opened.script_end_text;
        if (!is_help) {
            result.message = options_.arguments.script + ": " + result.message +
                             " (see lissom run " + options_.arguments.script + " --help)";
        }
        lua_pop(L_, 1);
        return result;
    }
    // A memory error reaches us without the handler's table, a mistake of syntax without calls.
    if (lua_type(L_, -1) == LUA_TTABLE) {
        if (lua_rawgeti(L_, -1, 3) == LUA_TTABLE) result.calls = calls_at_top(L_);
        lua_pop(L_, 1);
        if (lua_rawgeti(L_, -1, 4) == LUA_TSTRING) result.code = lua_tostring(L_, -1);
        lua_pop(L_, 1);
        lua_rawgeti(L_, -1, 1);
    }
    const char* text = lua_tostring(L_, -1);
    result.message = text ? text : "an error without a message";
    find_place(result);
    if (result.code.empty()) result.code = code_in(result.message);
    if (lacks_require(result.message)) {
        result.message += "\na script loads the library first: local lissom = require \"lissom\"";
    } else if (lacks_tests(result.message)) {
        result.message += "\ntests are run by: lissom test " + options_.arguments.script;
    }
    if (program_.debug && lua_type(L_, -2) == LUA_TTABLE) {
        lua_rawgeti(L_, -2, 2);
        if (const char* trace = lua_tostring(L_, -1)) result.message += std::string("\n") + trace;
    }
    lua_settop(L_, 0);
    return result;
}

}  // namespace lissom::cli
