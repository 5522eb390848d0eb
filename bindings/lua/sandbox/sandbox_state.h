/// Shared state of the parts of a sandbox; private to bindings/lua/sandbox.
#pragma once

#include <cstddef>
#include <initializer_list>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/sandbox/sandbox.h"
#include "bindings/lua/sandbox/stop.h"

namespace lissom::lua {

/// Work of a script as functions of Lua's libraries see it: its stop, and the count of what they
/// do.
class Work {
  public:
    Work() = default;
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    virtual ~Work() = default;

    /// Counts instructions, and asks for the stop if they are too many.
    virtual void count(std::size_t) {}
    /// Returns the message of the error that ends the script.
    virtual const char* end_text() { return "cancelled [cancelled]"; }

    Stop stop;
};

/// Lets functions of `L` and of its coroutines find `work`, which outlives the state.
void set_work(lua_State* L, Work& work);
Work& work_of(lua_State* L);
inline const Stop& stop_of(lua_State* L) {
    return work_of(L).stop;
}

/// The sandbox of a state.
Sandbox& sandbox_of(lua_State* L);
const std::vector<std::filesystem::path>& module_folders_of(const Sandbox& sandbox);

/// Raises the error that ends the script.
[[noreturn]] void raise_stopped(lua_State* L);

/// Counts the work of a C function as this many instructions, and ends the script if a limit is
/// reached.
void charge(lua_State* L, std::size_t instructions);
/// Counts bytes that a C function has passed over.
void charge_bytes(lua_State* L, std::size_t bytes);

/// Replaces functions of a library by ones that count the strings they take and return.
void wrap_costly(lua_State* L, const char* library, std::initializer_list<const char*> names);

/// Replaces the functions of patterns and string.rep, which may work for hours, by ones that stop.
void make_patterns_stop(lua_State* L);
/// Replaces coroutine.wrap and coroutine.close by ones that close nothing after a stop: hooks are
/// off in a coroutine that the error of a hook has ended.
void make_coroutines_stop(lua_State* L);

/// Takes functions of the debug library out of reach that can crash the host.
void make_debug_safe(lua_State* L);

/// Pushes a value as tostring shows it, with a number in place of its address.
void push_shown(lua_State* L, int index);

/// Each replaces functions in the globals.
void make_base_safe(lua_State* L);
void make_tables_safe(lua_State* L);
void make_strings_safe(lua_State* L);

/// Adds require, and a table `package` with the loaded modules.
void make_require_safe(lua_State* L);

}  // namespace lissom::lua
