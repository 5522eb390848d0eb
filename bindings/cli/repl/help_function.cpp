#include "bindings/cli/repl/help_function.h"

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/failure.h"
#include "bindings/lua/core/state.h"
#include "bindings/lua/reference/reference.h"
#include "kernel/core/nearest.h"

namespace lissom::cli {
namespace {

// Pushes the help that was asked for, with no C++ object alive afterwards.
template <typename Compose>
int push_help(lua_State* L, const Compose& compose) {
    lua::Failure failure;
    const bool composed = failure.guard([&] {
        const std::string text = compose();
        lua_pushlstring(L, text.data(), text.size());
    });
    if (!composed) lua_pushstring(L, failure.message);
    return 1;
}

std::string general_help(const lua::Registry& registry) {
    return lua::help_overview(registry) +
           "\nhelp(mesh.save), help(\"save\") or help(\"Mesh\") tells more. Tab completes names "
           "and options.";
}

std::string named_help(const lua::Registry& registry, const std::string& name) {
    const std::string text = lua::help_for(registry, name);
    if (!text.empty()) return text;
    const std::vector<std::string> names = lua::help_names(registry);
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string_view nearest = nearest_name(name, views);
    return "there is no help for '" + name + "'" +
           (nearest.empty() ? "; help() lists everything"
                            : ", did you mean '" + std::string(nearest) + "'?");
}

// help(), help(function), help(object), help(name)
int help(lua_State* L) {
    const lua::Registry& registry = *lua::find_state(L)->registry;
    const lua::Entry* entry = lua_isnone(L, 1) ? nullptr : lua::find_entry(L, 1);
    const lua::Type* type = lua_isnone(L, 1) ? nullptr : lua::find_type(L, 1);
    const char* name = lua_type(L, 1) == LUA_TSTRING ? lua_tostring(L, 1) : nullptr;
    return push_help(L, [&] {
        if (entry) return lua::help_text(*entry);
        if (type) return lua::help_text(*type);
        if (name) return named_help(registry, name);
        return general_help(registry);
    });
}

}  // namespace

void provide_help(lua_State* L) {
    lua_pushcfunction(L, help);
    lua_setglobal(L, "help");
}

}  // namespace lissom::cli
