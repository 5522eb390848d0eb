// nil, message, code that nobody looked at: told at once, and kept for lissom.failures.
#include <cstdio>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/kernel_library.h"

namespace lissom::lua {
namespace {

void keep_dropped(State& state) {
    constexpr std::size_t kMostKept = 100;
    ++state.dropped_count;
    if (state.dropped.size() >= kMostKept) return;
    state.dropped.push_back({state.last_failure_place, state.last_failure.message,
                             std::string(code_name(state.last_failure.code))});
}

int failures(Call& call) {
    const std::vector<DroppedFailure>& list = call.state().dropped;
    lua_createtable(call.lua(), count_of(list), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        lua_createtable(call.lua(), 0, 3);
        call.set_field("place", call.push(std::string_view(list[i].place)));
        call.set_field("message", call.push(std::string_view(list[i].message)));
        call.set_field("code", call.push(std::string_view(list[i].code)));
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

}  // namespace

// A cancel is told by who asked for it.
void State::tell_if_dropped(lua_State* L) {
    if (last_failure.code == ErrorCode::cancelled) return;
    if (!call_codes) call_codes = find_call_codes(L);
    if (!drops_results(L, *call_codes)) return;
    char text[sizeof last_failure.message + 512];
    std::snprintf(
        text, sizeof text,
        "%s%s [%s]; nobody looked at this failure: test the result, write assert(...), or "
        "`local _ =` before the call to ignore it",
        last_failure_place, last_failure.message, code_name(last_failure.code).data());
    Failure no_memory;
    no_memory.guard([&] {
        keep_dropped(*this);
        context.log(LogLevel::warning, text);
    });
#if LUA_VERSION_NUM >= 504
    if (!host.context.log && listeners->log == LUA_NOREF) lua_warning(L, text, 0);
#endif
    end_listening(L, *listeners);
}

Function failures_function() {
    return {
        .name = "failures",
        .body = failures,
        .summary =
            "The failures that nobody can have looked at: a function was called as a statement, "
            "and what it returned was nil, message, code. Each was told when it came: `lissom "
            "run` writes it and ends with status 1; elsewhere it is a warning for the log "
            "function of lissom.listen, or without one for Lua 5.4's own warnings (lua -W).",
        .results = {{"lissom.DroppedFailure[]", "failures", "The first hundred, in order."}},
        .example = R"(lissom.load("missing.obj")
local failures = lissom.failures()
assert(#failures == 1 and failures[1].code == "file_not_found")
local mesh, message = lissom.load("missing.obj")                     -- taken, so looked at
local _ = lissom.load("missing.obj")                                 -- ignored on purpose
assert(#lissom.failures() == 1))"};
}

}  // namespace lissom::lua
