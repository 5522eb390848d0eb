#include "bindings/cli/terminal/script_place.h"

#include <string_view>

#include "bindings/lua/core/call.h"

namespace lissom::cli {

void push_script_place(lua_State* L, int level) {
    // Deeper, a script calls itself.
    constexpr int kMaxLevels = 100;
    lua_Debug frame;
    for (int i = level; i < kMaxLevels && lua_getstack(L, i, &frame); ++i) {
        luaL_where(L, i);
        const std::string_view place = lua_tostring(L, -1);
        if (!place.empty() && !place.starts_with(lua::kOwnLuaText)) return;
        lua_pop(L, 1);
    }
    lua_pushliteral(L, "");
}

}  // namespace lissom::cli
