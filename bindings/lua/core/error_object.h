/// Error objects: tables with the fields `message`, `code`, `elements`, `file`, `line` and `place`,
/// raised by everything that fails. `tostring` returns the message.
#pragma once

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/failure.h"

namespace lissom::lua {

/// Makes the metatable of error objects in `L`.
void open_errors(lua_State* L);

/// Pushes an error object with the failure's fields and the place of the script's line at `level`
/// (1: that runs now; 2: its caller). Calls Lua: no C++ object with a destructor may be alive.
void push_error(lua_State* L, const Failure& failure, int level = 1);

/// Raises an error object.
[[noreturn]] void raise_failure(lua_State* L, const Failure& failure);
/// Raises an error object with the code `invalid_argument`.
[[noreturn]] void raise_misuse(lua_State* L, const char* text);

/// Returns whether the value at `index` is an error object.
bool is_error_object(lua_State* L, int index);

/// Fills `failure` with message, code and elements of the error object at `index`; the code is
/// `internal` if a script has spoilt it. Calls no metamethod.
void read_error(lua_State* L, int index, Failure& failure);

/// Pushes the text of an uncaught error, of any type: "script.lua:3: message [code]" for an error
/// object, else as tostring. May raise the error of a script's own __tostring.
const char* push_error_text(lua_State* L, int index);

}  // namespace lissom::lua
