/// Shared state of the parts of a sandbox; private to bindings/lua/sandbox.
#pragma once

#include <cstddef>
#include <initializer_list>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/sandbox/sandbox.h"
#include "bindings/lua/sandbox/stop.h"

namespace lissom::lua {

/// The sandbox of a state.
Sandbox& sandbox_of(lua_State* L);
const Stop& stop_of(lua_State* L);
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

/// Each replaces functions in the globals.
void make_base_safe(lua_State* L);
void make_tables_safe(lua_State* L);
void make_strings_safe(lua_State* L);

/// Adds require, and a table `package` with the loaded modules.
void make_require_safe(lua_State* L);

}  // namespace lissom::lua
