/// A Lua state with lissom for the tests of the binding.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/state.h"

namespace lissom::test {

class LuaState {
  public:
    explicit LuaState(const lua::HostOptions& options = {}) : L_(luaL_newstate()) {
        luaL_openlibs(L_);
        lua::open(L_, options);
        lua_setglobal(L_, "lissom");
    }
    ~LuaState() { lua_close(L_); }
    LuaState(const LuaState&) = delete;
    LuaState& operator=(const LuaState&) = delete;

    lua_State* get() const { return L_; }
    lua::State& binding() const { return *lua::find_state(L_); }

    /// Runs a chunk named "test" and returns the text of its error, with place and code; empty
    /// without one.
    std::string run(const std::string& code) {
        std::string message;
        if (load(code) != 0 || lua_pcall(L_, 0, 0, 0) != 0) message = text_at(-1);
        lua_settop(L_, 0);
        return message;
    }

    /// The first result of `return <expression>` as text; its error where it has one.
    std::string eval(const std::string& expression) {
        if (load("return " + expression) == 0) lua_pcall(L_, 0, 1, 0);
        const std::string text = text_at(-1);
        lua_settop(L_, 0);
        return text;
    }

    /// Bytes that Lua itself has in use.
    double kilobytes() const { return lua_gc(L_, LUA_GCCOUNT, 0); }
    void collect() const { lua_gc(L_, LUA_GCCOLLECT, 0); }

  private:
    int load(const std::string& code) {
        return luaL_loadbuffer(L_, code.data(), code.size(), "=test");
    }
    std::string text_at(int index) {
        const char* text = lua::push_error_text(L_, index);
        return text ? text : "";
    }

    lua_State* L_;
};

}  // namespace lissom::test
