#include "viewer/window/session/script_setup.h"

#include "bindings/cli/repl/help_function.h"
#include "bindings/lua/core/failure.h"

namespace lissom::window {
namespace {

namespace fs = std::filesystem;

// Refuses os.exit, which would end the window and its contents.
int refuse_exit(lua_State* L) {
    return luaL_error(L, "os.exit does not end the window: return, or raise an error");
}

// Puts `refuse_exit` into the library `os`. Runs inside lua_pcall.
int put_guard(lua_State* L) {
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
int put_library(lua_State* L) {
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

// Calls the C function on top of the stack; what fails is left out.
void run(lua_State* L) {
    if (lua_pcall(L, 0, 0, 0) != LUA_OK) lua_pop(L, 1);
}

}  // namespace

void guard_exit(lua_State* L) {
    lua_pushcfunction(L, put_guard);
    run(L);
}

std::vector<fs::path> module_files(lua_State* L) {
    std::vector<fs::path> files;
    lua_pushlightuserdata(L, &files);
    lua_pushcclosure(L, list_module_files, 1);
    run(L);
    return files;
}

void provide_library(lua_State* L) {
    lua_pushcfunction(L, put_library);
    run(L);
}

}  // namespace lissom::window
