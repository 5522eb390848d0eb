/// Lists of a function's results.
#pragma once

#include "bindings/lua/core/call.h"

namespace lissom::lua {

/// Pushes a list: push_item(item) for each of `items`, which pushes one value. Returns 1.
template <typename Items, typename PushItem>
int push_list(const Call& call, const Items& items, const PushItem& push_item) {
    lua_createtable(call.lua(), static_cast<int>(items.size()), 0);
    int place = 0;
    for (const auto& item : items) {
        push_item(item);
        lua_rawseti(call.lua(), -2, ++place);
    }
    return 1;
}

}  // namespace lissom::lua
