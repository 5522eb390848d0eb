/// Listeners: Lua functions that hear of progress and log messages (lissom.listen).
#pragma once

#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/registry.h"
#include "kernel/core/context.h"

namespace lissom::lua {

/// The functions of one Lua state, and messages on the way to them.
struct Listeners {
    struct Message {
        LogLevel level;
        std::string text;
    };

    /// The Lua thread whose call runs an operation now, and the context it runs under; null between
    /// operations.
    lua_State* running = nullptr;
    const Context* context = nullptr;
    /// References into Lua's registry: the functions, an error that one raised, and the C function
    /// that calls the progress function.
    int progress = LUA_NOREF, log = LUA_NOREF, error = LUA_NOREF, caller = LUA_NOREF;
    /// The progress function raised an error, or returned false: the operation was cancelled for
    /// it.
    bool failed = false, stopped = false;
    /// Messages of the operation that runs, from any thread; delivered when it has ended.
    std::mutex mutex;
    std::vector<Message> messages, delivered;
    /// Number of objects collected while the operation ran.
    int collected = 0;
};

/// Prepares the references.
void open_listeners(lua_State* L, Listeners& listeners);

/// Calls the progress function in protected mode, in the middle of an operation. An error or
/// `false` cancels the operation; the error is raised when it has unwound.
void report_progress(Listeners& listeners, std::string_view label, double fraction);

/// Keeps a message until the operation has ended. Any thread.
void keep_message(Listeners& listeners, LogLevel level, std::string_view text);

/// Keeps the object at stack index 1, which is collected in the middle of an operation, until its
/// end: a script can call __gc of an object in use.
void keep_collected(lua_State* L, Listeners& listeners);

/// Releases the objects of keep_collected.
void release_collected(lua_State* L, Listeners& listeners);

/// After an operation, with no C++ object alive: delivers messages and raises the error of a
/// function.
void end_listening(lua_State* L, Listeners& listeners);

/// lissom.listen
Function listen_function();

}  // namespace lissom::lua
