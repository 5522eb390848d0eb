/// The Lua state of a context, and objects that C and Lua share; private to bindings/c.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/c/context.h"
#include "bindings/c/script/json.h"
#include "bindings/lua/core/state.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/sandbox/sandbox.h"
#include "bindings/lua/sandbox/stoppable.h"

namespace lissom::c {

/// A value that Lua's registry keeps for a handle of the host.
struct LuaReference {
    std::weak_ptr<ScriptHost> host;
    int reference = LUA_NOREF;

    ~LuaReference();
};

/// A script that was loaded.
struct Script {
    std::string text, name;
    std::shared_ptr<lua::ParameterSet> parameters;
    /// The set parameters, as the words of a command line.
    std::map<std::string, std::string> values;
};

/// An object as Lua knows it.
struct ScriptObject {
    /// The name of its type; a constant of the program.
    const char* type_name;
    std::shared_ptr<void> object;
};

class ScriptHost : public std::enable_shared_from_this<ScriptHost>, public MessageCounter {
  public:
    explicit ScriptHost(lissom_context& context) : context_(context), working_(context.kernel) {}
    ~ScriptHost() override;
    ScriptHost(const ScriptHost&) = delete;
    ScriptHost& operator=(const ScriptHost&) = delete;

    lissom_context& context() { return context_; }
    /// Returns the state; opened when it is first asked for. Errors: memory_limit.
    lua_State* lua();
    lua::State& binding() { return *lua::find_state(lua()); }
    /// Opens the state as a sandbox. Errors: invalid_argument if it is open already, or for
    /// limits below 0; memory_limit.
    void open_sandbox(lua::SandboxLimits limits);
    /// Works in another context from now on: that of a job, or the host's own again.
    void work_in(const Context& context);
    /// The context that scripts run in now.
    const Context& working() const { return working_; }
    /// Refuses scripts and calls while a job runs one.
    void set_busy(bool busy) { busy_ = busy; }
    bool busy() const { return busy_; }
    /// Returns all objects that scripts know.
    std::vector<Held> known_objects();
    /// Counts warnings as output of the sandbox.
    bool count(LogLevel level, std::size_t bytes) noexcept override;
    /// Runs lua_pcall without a handler, within the limits of the sandbox.
    int call(int arguments, int results);

    /// Returns the hooks of scripts; see Sharing.
    Sharing sharing();
    /// Returns the Lua object that shares a handle's content. Content new to Lua gets a
    /// new object if that is possible without a copy. Errors: StatusError for invalid
    /// handles.
    ScriptObject holder_of(std::uint64_t id);
    /// Returns a handle for the object of a userdata at `index`: its own if it has one.
    std::uint64_t handle_of(int index);
    /// Returns a handle for an object that is new to Lua, of a type that has no handles of its own.
    std::uint64_t add_object(const char* type, const std::shared_ptr<void>& object);
    /// Returns the object of a handle of scripts, or null if it is of another type.
    std::shared_ptr<void> object_of_type(std::uint64_t id, const char* type);
    /// Releases the handles that were made since the last call of either of these: the host gets no
    /// results.
    void drop_new_handles() noexcept;
    /// Keeps them.
    void keep_new_handles() noexcept { new_handles_.clear(); }

    /// Finds the objects of values to be pushed. Errors: INVALID_HANDLE.
    void check_values(const List& values);
    /// Pushes values, in protected mode, once they are checked.
    void push_values(const List& values);
    /// Returns the value at `index`, objects as handles. Errors: invalid_argument for values
    /// without JSON: functions, numbers that are not finite, tables that are list and record at
    /// once.
    Value value_at(int index, int depth = 0);
    /// Returns the values from `first` to the top; at most `kMaxValues` with all they hold.
    List values_from(int first);

    static constexpr std::size_t kMaxValues = 4'000'000;

  private:
    void push_value(const Value& value);
    void push_object(std::uint64_t id);
    Value table_at(int index, int depth);
    Fields fields_at(int index, int depth);
    List list_at(int index, int depth);
    // Lua's object around the content of a handle, or null.
    template <typename T>
    std::shared_ptr<T> known(const void* content);
    std::shared_ptr<lua::MeshObject> mesh_of_region(const Region& region);
    std::shared_ptr<lua::MeshObject> mesh_of_object(const void* content);
    std::shared_ptr<void> object_of(Kind kind, const std::shared_ptr<void>& content);
    std::uint64_t add_handle(Kind kind, std::shared_ptr<void> content);
    std::uint64_t known_handle(Kind kind, const void* content);
    void keep(const void* content, const std::shared_ptr<void>& object);

    lissom_context& context_;
    Context working_;
    bool busy_ = false;
    lua_State* L_ = nullptr;
    std::vector<std::uint64_t> new_handles_;
    // Null if scripts are trusted.
    std::unique_ptr<lua::Sandbox> sandbox_;
    lua::Stoppable stoppable_;
    // Depth of the results that are being converted.
    std::size_t values_left_ = kMaxValues;
    // The Lua object around the content of a handle, by that content.
    std::map<const void*, std::weak_ptr<void>> around_;
    // The mesh that an object was made for, by the object.
    std::map<const void*, std::weak_ptr<lua::MeshObject>> owners_;
    // Objects for the values that are being pushed, by handle.
    std::map<std::uint64_t, ScriptObject> holders_;
    // Their places in Lua's registry, for objects of scripts alone.
    std::map<std::uint64_t, int> references_;
};

/// Returns the host of a context that can run scripts. Errors: BUSY while a job runs one.
ScriptHost& scripts_of(lissom_context& context);

/// Throws the Lua error on top of the stack: with the code of an error object, or that in brackets
/// at the end of a message, else with `status`. Of scripts (SCRIPT_ERROR) only cancelled and
/// memory_limit keep their code.
[[noreturn]] void throw_lua_error(lua_State* L, lissom_status status);

}  // namespace lissom::c
