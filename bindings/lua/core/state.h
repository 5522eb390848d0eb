/// State of the binding in one Lua state. Nothing is shared between states.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/failure.h"
#include "bindings/lua/core/listeners.h"
#include "bindings/lua/core/object.h"
#include "bindings/lua/core/registry.h"
#include "kernel/core/context.h"

namespace lissom::lua {

/// The command line of the script that runs, for lissom.params.
struct ScriptArguments {
    /// Name of the script, as messages and help texts show it; empty if no script runs.
    std::string script;
    /// Words after it on the command line.
    std::vector<std::string> words;
};

/// Use of a file by a script.
enum class FileUse { read, write };

/// Options of a host when it opens the binding. Every field is optional.
struct HostOptions {
    ContextOptions context = {};
    /// Functions and types for scripts; the kernel's library alone if it is null.
    std::shared_ptr<const Registry> registry = {};
    ScriptArguments arguments = {};
    /// Called after every operation of the kernel, on the thread of the state.
    std::function<void()> operation_ended = {};
    /// Asked about each path that a script gives, before the file is opened: throws Error if the
    /// script may not use it. Null allows all. Called on the thread of the state.
    std::function<void(const std::filesystem::path& path, FileUse use)> check_file = {};
    /// Scripts may ask for addresses of the kernel's memory, and have it write to those they name.
    bool addresses = true;
};

struct ParameterSet;

/// Reason for a script's end: its help was asked for, or its command line is wrong. The text is the
/// message of the Lua error that was raised.
enum class ScriptEnd { none, help, usage };

struct State {
    explicit State(const HostOptions& options);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// After an operation, with no C++ object alive: tells the host, delivers log messages, and
    /// raises the error of a listener as a Lua error.
    void end_operation(lua_State* L);
    /// Returns the key of the weak table from objects to their userdata, in Lua's registry.
    static const void* object_table_key();
    /// Returns the key of the metatable of values held by a call.
    static const void* held_metatable_key();

    /// C++ of userdata: objects, and values held by calls.
    CellList cells;
    std::shared_ptr<Listeners> listeners = std::make_shared<Listeners>();
    std::shared_ptr<const Registry> registry;
    Context context;
    HostOptions host;
    /// Parameters of the last call of lissom.params; null before.
    std::shared_ptr<ParameterSet> parameters;
    /// The command line asks for the script's help: it runs up to lissom.params, and every other
    /// call ends it.
    bool only_help = false;
    ScriptEnd script_end = ScriptEnd::none;
    std::string script_end_text;

    /// A listener hears calls; see hear_calls.
    bool is_heard = false;

    /// Native bytes that the collector has not been told of yet.
    std::size_t uncharged_bytes = 0;
    /// Bytes on the context's account after the last whole collection for want of room.
    std::size_t used_after_collection = 0;
};

/// Opens the binding in `L`, or finds it opened, and pushes the table of the module. May raise a
/// Lua error; `options` must outlive the call.
void open(lua_State* L, const HostOptions& options);

/// Raises a Lua error that ends the script, which has begun to work although only its help was
/// asked for (State::only_help).
int end_for_help(lua_State* L, State& state);

/// A C function for Lua: its argument, a table with the methods before(type, name, effect,
/// arguments...) and after(type, name, effect, results...), hears each call of the library from now
/// on, but for its own, those of types that are not heard, and methods whose Effect is `unheard`;
/// nil: nobody does. `type` is nil for a function of the module. Failed calls have no after.
int hear_calls(lua_State* L);

/// The function of the registration table that the value at `index` is, or null.
const Entry* find_entry(lua_State* L, int index);

/// The type of the object at `index`, or null.
const Type* find_type(lua_State* L, int index);

/// Returns the binding's state, or null if it was not opened in `L`.
State* find_state(lua_State* L);

}  // namespace lissom::lua

/// Opens the module with a context of its own: silent, serial, without limits.
extern "C" int luaopen_lissom(lua_State* L);
