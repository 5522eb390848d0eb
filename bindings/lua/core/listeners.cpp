#include "bindings/lua/core/listeners.h"

#include "bindings/lua/core/call.h"

namespace lissom::lua {
namespace {

// Key of Lua's registry: its address.
const char kCollected = 0;

struct Report {
    const Listeners* listeners;
    std::string_view label;
    double fraction;
};

// Runs inside lua_pcall: (Report*) -> whether to go on.
int call_progress(lua_State* L) {
    const auto* report = static_cast<const Report*>(lua_touserdata(L, 1));
    lua_rawgeti(L, LUA_REGISTRYINDEX, report->listeners->progress);
    lua_pushlstring(L, report->label.data(), report->label.size());
    lua_pushnumber(L, report->fraction);
    lua_call(L, 2, 1);
    const bool stop = lua_isboolean(L, -1) && !lua_toboolean(L, -1);
    lua_pushboolean(L, stop ? 0 : 1);
    return 1;
}

const char* level_name(LogLevel level) {
    switch (level) {
        case LogLevel::debug:
            return "debug";
        case LogLevel::info:
            return "info";
        case LogLevel::warning:
            return "warning";
    }
    return "";
}

void take_messages(Listeners& listeners) {
    const std::lock_guard lock(listeners.mutex);
    listeners.delivered.swap(listeners.messages);
    listeners.messages.clear();
}

void deliver_messages(lua_State* L, Listeners& listeners) {
    take_messages(listeners);
    for (const Listeners::Message& message : listeners.delivered) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, listeners.log);
        lua_pushstring(L, level_name(message.level));
        lua_pushlstring(L, message.text.data(), message.text.size());
        lua_call(L, 2, 0);
    }
    listeners.delivered.clear();
}

void set_reference(lua_State* L, int& reference, int index) {
    luaL_unref(L, LUA_REGISTRYINDEX, reference);
    reference = LUA_NOREF;
    if (index == 0) return;
    lua_pushvalue(L, index);
    reference = luaL_ref(L, LUA_REGISTRYINDEX);
}

int listen(Call& call) {
    Listeners& listeners = *call.state().listeners;
    const int progress = call.has("progress") ? call.stack_index("progress") : 0;
    const int log = call.has("log") ? call.stack_index("log") : 0;
    set_reference(call.lua(), listeners.progress, progress);
    set_reference(call.lua(), listeners.log, log);
    return 0;
}

}  // namespace

void open_listeners(lua_State* L, Listeners& listeners) {
    lua_pushcfunction(L, call_progress);
    listeners.caller = luaL_ref(L, LUA_REGISTRYINDEX);
    lua_pushboolean(L, 0);
    listeners.error = luaL_ref(L, LUA_REGISTRYINDEX);
}

void report_progress(Listeners& listeners, std::string_view label, double fraction) {
    lua_State* L = listeners.running;
    if (!L || listeners.progress == LUA_NOREF || listeners.failed || listeners.stopped) return;
    Report report{&listeners, label, fraction};
    lua_rawgeti(L, LUA_REGISTRYINDEX, listeners.caller);
    lua_pushlightuserdata(L, &report);
    if (lua_pcall(L, 1, 1, 0) != 0) {
        lua_rawseti(L, LUA_REGISTRYINDEX, listeners.error);
        listeners.failed = true;
    } else {
        listeners.stopped = !lua_toboolean(L, -1);
        lua_pop(L, 1);
    }
    if (listeners.failed || listeners.stopped) listeners.context->cancel();
}

void keep_message(Listeners& listeners, LogLevel level, std::string_view text) {
    if (listeners.log == LUA_NOREF) return;
    const std::lock_guard lock(listeners.mutex);
    listeners.messages.push_back({level, std::string(text)});
}

void keep_collected(lua_State* L, Listeners& listeners) {
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kCollected);
    if (!lua_istable(L, -1)) {
        lua_newtable(L);
        lua_pushvalue(L, -1);
        raw_set_pointer(L, LUA_REGISTRYINDEX, &kCollected);
    }
    lua_pushvalue(L, 1);
    lua_rawseti(L, -2, ++listeners.collected);
    lua_pop(L, 1);
}

void release_collected(lua_State* L, Listeners& listeners) {
    if (listeners.collected == 0) return;
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kCollected);
    for (; listeners.collected > 0; --listeners.collected) {
        lua_rawgeti(L, -1, listeners.collected);
        if (Holder* holder = find_holder(L, -1, nullptr)) holder->object.end();
        lua_pop(L, 1);
        lua_pushnil(L);
        lua_rawseti(L, -2, listeners.collected);
    }
    lua_pop(L, 1);
}

void end_listening(lua_State* L, Listeners& listeners) {
    const bool failed = listeners.failed;
    if (failed || listeners.stopped) listeners.context->clear_cancel();
    listeners.failed = listeners.stopped = false;
    if (!failed) return deliver_messages(L, listeners);
    lua_rawgeti(L, LUA_REGISTRYINDEX, listeners.error);
    lua_error(L);
}

Function listen_function() {
    return {
        .name = "listen",
        .body = listen,
        .summary =
            "Sets the functions that hear of long operations, in place of those before. "
            "They cannot call lissom themselves.",
        .options = {function("progress", "fun(label: string, fraction: number): boolean?",
                             "Called during an operation with the name of the step and the "
                             "fraction done, 0 to 1. If it returns false the operation is "
                             "cancelled.")
                        .optional("none"),
                    function("log", "fun(level: string, message: string)",
                             "Called after an operation with each of its messages; the level is "
                             "debug, info or warning.")
                        .optional("none")},
        .example = R"(lissom.listen{ progress = function(label, fraction) return true end }
lissom.shapes.cactus{ vertices = 2000 }
lissom.listen{})"};
}

}  // namespace lissom::lua
