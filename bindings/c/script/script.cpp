// Scripts of a host, and calls by name.
#include <algorithm>
#include <cmath>

#include "bindings/c/data.h"
#include "bindings/c/script/host.h"
#include "bindings/lua/core/script_parameters.h"
#include "bindings/lua/host/script_files.h"
#include "kernel/core/nearest.h"

namespace lissom::c {
namespace {

// Leaves the stack as it was found.
class StackGuard {
  public:
    explicit StackGuard(lua_State* L) : L_(L), top_(lua_gettop(L)) {}
    ~StackGuard() { lua_settop(L_, top_); }
    StackGuard(const StackGuard&) = delete;
    StackGuard& operator=(const StackGuard&) = delete;

    int top() const { return top_; }

  private:
    lua_State* L_;
    int top_;
};

// Arguments of a call or script. Lua's stack has room for more, and no function takes as many.
List list_of(const char* text, const lissom_context& context) {
    constexpr std::size_t kMaxArguments = 250;
    List list = text ? list_of_json(text, context.kernel) : List();
    require(list.size() <= kMaxArguments,
            "arguments: there are more than 250; put many values into a list among them");
    return list;
}

void give(lissom_context& context, const List& list, lissom_bytes* bytes) {
    context.bytes = json_of(list);
    *bytes = {context.bytes.data(), context.bytes.size()};
}

// Gives the values from `first` to the top of the stack. After an error no handle of them is left.
void give_results(lissom_context& context, ScriptHost& host, int first, lissom_bytes* bytes) {
    if (!bytes) return;
    try {
        give(context, host.values_from(first), bytes);
    } catch (...) {
        host.drop_new_handles();
        throw;
    }
    host.keep_new_handles();
}

// ---- Scripts

struct Running {
    ScriptHost* host;
    const Script* script;
    const List* arguments;
};

// Protected: loads the script and runs it, with its values on the stack.
int run_protected(lua_State* L) {
    const auto* running = static_cast<const Running*>(lua_touserdata(L, 1));
    const Script& script = *running->script;
    const std::string_view text = lua::lua_text_of(script.text);
    if (luaL_loadbufferx(L, text.data(), text.size(), script.name.c_str(), "t")) {
        return lua_error(L);
    }
    const int function = lua_gettop(L);
    running->host->push_values(*running->arguments);
    lua_call(L, lua_gettop(L) - function, LUA_MULTRET);
    return lua_gettop(L) - function + 1;
}

std::vector<std::string> words_of(const Script& script) {
    std::vector<std::string> words;
    for (const auto& [name, value] : script.values) words.push_back("--" + name + "=" + value);
    return words;
}

// Whether a script may declare parameters: else nothing of it runs before it is asked to.
bool may_declare(const Script& script) {
    return script.text.find("params") != std::string::npos;
}

// Throws if the text is no Lua.
void check_syntax(ScriptHost& host, const Script& script) {
    lua_State* L = host.lua();
    const std::string_view text = lua::lua_text_of(script.text);
    if (luaL_loadbufferx(L, text.data(), text.size(), script.name.c_str(), "t")) {
        throw_lua_error(L, LISSOM_SCRIPT_ERROR);
    }
}

// Runs a script, or only up to its parameters; its results are on the stack. Its arguments were
// checked.
void run_checked(ScriptHost& host, Script& script, const List& arguments, bool only_parameters) {
    lua_State* L = host.lua();
    lua::State& state = host.binding();
    state.host.arguments = {script.name.substr(1), words_of(script)};
    state.parameters = nullptr;
    state.script_end = lua::ScriptEnd::none;
    state.only_help = only_parameters;
    Running running{&host, &script, &arguments};
    lua_pushcfunction(L, run_protected);
    lua_pushlightuserdata(L, &running);
    const int status = host.call(1, LUA_MULTRET);
    const bool ended = state.script_end != lua::ScriptEnd::none;
    state.only_help = false;
    state.host.arguments = {};
    if (only_parameters) script.parameters = state.parameters;
    if (status == LUA_OK || (only_parameters && ended)) return;
    if (ended) throw Error(ErrorCode::invalid_argument, state.script_end_text);
    throw_lua_error(L, LISSOM_SCRIPT_ERROR);
}

void run_script(ScriptHost& host, Script& script, const List& arguments, bool only_parameters) {
    host.check_values(arguments);
    run_checked(host, script, arguments, only_parameters);
}

Value value_of(const std::optional<lua::ParameterValue>& value) {
    if (!value) return {};
    return std::visit([](const auto& one) { return Value(one); }, *value);
}

Fields described(const lua::ScriptParameter& parameter) {
    Fields fields;
    fields.add("name", parameter.name);
    fields.add("type", std::string(lua::type_name(parameter.type)));
    if (parameter.default_value) fields.add("default", value_of(parameter.default_value));
    fields.add("value", value_of(parameter.value ? parameter.value : parameter.default_value));
    if (std::isfinite(parameter.min)) fields.add("min", parameter.min);
    if (std::isfinite(parameter.max)) fields.add("max", parameter.max);
    if (parameter.step) fields.add("step", *parameter.step);
    if (!parameter.choices.empty()) {
        fields.add("choices", List(parameter.choices.begin(), parameter.choices.end()));
    }
    const std::pair<const char*, const std::string*> texts[] = {{"unit", &parameter.unit},
                                                                {"group", &parameter.group},
                                                                {"help", &parameter.help},
                                                                {"of", &parameter.of}};
    for (const auto& [name, text] : texts) {
        if (!text->empty()) fields.add(name, *text);
    }
    return fields;
}

void set_parameter(Script& script, const std::string& name, const std::string& value) {
    lua::ScriptParameter* found = script.parameters ? script.parameters->find(name) : nullptr;
    if (!found) {
        std::vector<std::string_view> names;
        if (script.parameters) names = script.parameters->names();
        throw Error(ErrorCode::invalid_argument,
                    "the script has no parameter '" + name + "'" + name_hint(name, names));
    }
    std::optional<lua::ParameterValue> taken;
    try {
        taken = found->from_text(value);
    } catch (const lua::ParameterError& error) {
        throw Error(ErrorCode::invalid_argument, error.message);
    }
    std::string text = value;
    script.values[name] = std::move(text);
    found->value = std::move(taken);
}

// ---- Limits

std::vector<std::filesystem::path> folders_of(const char* const* names, std::int32_t count,
                                              const char* name) {
    std::vector<std::filesystem::path> folders;
    require(count >= 0, std::string(name) + ": the number of folders is negative");
    if (count > 0) require_given(names, name);
    for (std::int32_t i = 0; i < count; ++i) folders.push_back(path_of(given_text(names[i], name)));
    return folders;
}

lua::SandboxLimits limits_of(const lissom_sandbox_options& given) {
    require(std::isfinite(given.seconds), "the seconds of a sandbox are not finite");
    lua::SandboxLimits limits;
    limits.seconds = given.seconds;
    limits.instructions = given.instructions;
    limits.memory_bytes = given.memory;
    limits.output_bytes = given.output;
    limits.read_folders = folders_of(given.read_folders, given.read_folder_count, "read_folders");
    limits.write_folders =
        folders_of(given.write_folders, given.write_folder_count, "write_folders");
    limits.module_folders =
        folders_of(given.module_folders, given.module_folder_count, "module_folders");
    return limits;
}

// ---- Calls by name

// The entry of "shapes.box" or "Mesh.smooth".
const lua::Entry& entry_of(const lua::Registry& registry, const std::string& name) {
    std::vector<std::string> names;
    for (const auto& entry : registry.entries()) {
        const std::string prefix =
            entry->type ? entry->type->name.substr(sizeof("lissom.") - 1) + "." : "";
        names.push_back(prefix + entry->function->name);
        if (names.back() == name) return *entry;
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string_view near = nearest_name(name, views);
    throw Error(ErrorCode::out_of_range,
                "there is no function '" + name + "'" +
                    (near.empty() ? std::string("; the Lua reference lists all")
                                  : ", did you mean '" + std::string(near) + "'?"));
}

struct Calling {
    ScriptHost* host;
    const lua::Entry* entry;
    const List* arguments;
};

// The function of the module under a name with dots.
void push_module_function(lua_State* L, const char* name) {
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_getfield(L, -1, "lissom");
    lua_remove(L, -2);
    while (*name) {
        const char* end = name;
        while (*end && *end != '.') ++end;
        lua_pushlstring(L, name, static_cast<std::size_t>(end - name));
        lua_gettable(L, -2);
        lua_remove(L, -2);
        name = *end ? end + 1 : end;
    }
}

// Protected: calls the function with its arguments.
int call_protected(lua_State* L) {
    const auto* calling = static_cast<const Calling*>(lua_touserdata(L, 1));
    const lua::Entry& entry = *calling->entry;
    if (entry.type) {
        luaL_getmetatable(L, entry.type->name.c_str());
        calling->host->push_values(*calling->arguments);
        if (lua_gettop(L) < 3 || lua_type(L, 3) != LUA_TUSERDATA) {
            return luaL_error(L, "the first argument of a method is its object");
        }
        lua_getfield(L, 3, entry.function->name.c_str());
        lua_insert(L, 3);
        lua_remove(L, 2);
    } else {
        push_module_function(L, entry.function->name.c_str());
        calling->host->push_values(*calling->arguments);
    }
    lua_call(L, lua_gettop(L) - 2, LUA_MULTRET);
    return lua_gettop(L) - 1;
}

// Leaves the results on the stack; the arguments were checked.
void call_checked(ScriptHost& host, const lua::Entry& entry, const List& arguments) {
    lua_State* L = host.lua();
    Calling calling{&host, &entry, &arguments};
    lua_pushcfunction(L, call_protected);
    lua_pushlightuserdata(L, &calling);
    if (host.call(1, LUA_MULTRET) != LUA_OK) {
        throw_lua_error(L, LISSOM_INVALID_ARGUMENT);
    }
}

void call_by_name(ScriptHost& host, const lua::Entry& entry, const List& arguments) {
    host.check_values(arguments);
    call_checked(host, entry, arguments);
}

// Begins a job that runs `work`, which leaves its results on the stack of Lua.
void begin_script(lissom_context& context, ScriptHost& host, std::vector<Held> held,
                  std::function<void()> work, lissom_job* job) {
    require_given(job, "job");
    for (const Held& one : host.known_objects()) {
        if (std::find(held.begin(), held.end(), one) == held.end()) held.push_back(one);
    }
    const int top = lua_gettop(host.lua());
    JobPlan plan;
    plan.held = std::move(held);
    plan.work = [&host, work = std::move(work)](const Context& inner) {
        host.work_in(inner);
        work();
    };
    plan.take = [&context, &host, top](JobResult& result) {
        if (result.wants_json) give_results(context, host, top + 1, &result.json);
    };
    plan.end = [&context, &host, top] {
        host.work_in(context.kernel);
        lua_settop(host.lua(), top);
        host.set_busy(false);
    };
    host.set_busy(true);
    try {
        begin_job(context, std::move(plan), job);
    } catch (...) {
        host.set_busy(false);
        throw;
    }
}

Script& script_of(lissom_context& context, lissom_script script) {
    return context.content<Script>(script.id, Kind::script);
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_sandbox_options lissom_default_sandbox_options(void) {
    const lua::SandboxLimits limits;
    lissom_sandbox_options options{};
    options.struct_size = sizeof options;
    options.seconds = limits.seconds;
    options.instructions = limits.instructions;
    options.memory = limits.memory_bytes;
    options.output = limits.output_bytes;
    return options;
}

lissom_status lissom_sandbox_scripts(lissom_context* context,
                                     const lissom_sandbox_options* options) {
    return run(context, [&] {
        scripts_of(*context).open_sandbox(
            limits_of(take_options(options, lissom_default_sandbox_options())));
    });
}

lissom_status lissom_script_load(lissom_context* context, const char* text, size_t size,
                                 const char* name, lissom_script* script) {
    return run(context, [&] {
        require_given(text, "text");
        require_given(script, "script");
        auto made = std::make_shared<Script>();
        made->text.assign(text, size);
        made->name = "@" + given_name(name, "name");
        ScriptHost& host = scripts_of(*context);
        const StackGuard guard(host.lua());
        check_syntax(host, *made);
        if (may_declare(*made)) run_script(host, *made, List(), true);
        script->id = context->add(Kind::script, std::move(made), size);
    });
}

lissom_status lissom_script_parameters(lissom_context* context, lissom_script script,
                                       lissom_bytes* json) {
    return run(context, [&] {
        require_given(json, "json");
        List list;
        const Script& own = script_of(*context, script);
        if (own.parameters) {
            for (const auto& parameter : own.parameters->list)
                list.emplace_back(described(parameter));
        }
        give(*context, list, json);
    });
}

lissom_status lissom_script_set(lissom_context* context, lissom_script script,
                                const char* parameter, const char* value) {
    return run(context, [&] {
        set_parameter(script_of(*context, script), given_name(parameter, "parameter"),
                      given_name(value, "value"));
    });
}

lissom_status lissom_script_run(lissom_context* context, lissom_script script,
                                const char* arguments, lissom_bytes* json) {
    return run(context, [&] {
        ScriptHost& host = scripts_of(*context);
        const StackGuard guard(host.lua());
        const List values = list_of(arguments, *context);
        Script& own = script_of(*context, script);
        run_script(host, own, values, false);
        give_results(*context, host, guard.top() + 1, json);
    });
}

lissom_status lissom_call(lissom_context* context, const char* name, const char* arguments,
                          lissom_bytes* json) {
    return run(context, [&] {
        ScriptHost& host = scripts_of(*context);
        const std::string text = given_text(name, "name");
        const StackGuard guard(host.lua());
        call_by_name(host, entry_of(*host.binding().registry, text), list_of(arguments, *context));
        give_results(*context, host, guard.top() + 1, json);
    });
}

lissom_status lissom_script_begin_run(lissom_context* context, lissom_script script,
                                      const char* arguments, lissom_job* job) {
    return run(context, [&] {
        ScriptHost& host = scripts_of(*context);
        host.lua();
        const auto own = context->share<Script>(script.id, Kind::script);
        const auto values = std::make_shared<List>(list_of(arguments, *context));
        host.check_values(*values);
        begin_script(
            *context, host, {{script.id, Kind::script}},
            [&host, own, values] { run_checked(host, *own, *values, false); }, job);
    });
}

lissom_status lissom_begin_call(lissom_context* context, const char* name, const char* arguments,
                                lissom_job* job) {
    return run(context, [&] {
        ScriptHost& host = scripts_of(*context);
        host.lua();
        const lua::Entry* entry = &entry_of(*host.binding().registry, given_text(name, "name"));
        const auto values = std::make_shared<List>(list_of(arguments, *context));
        host.check_values(*values);
        begin_script(
            *context, host, {}, [&host, entry, values] { call_checked(host, *entry, *values); },
            job);
    });
}

}  // extern "C"
