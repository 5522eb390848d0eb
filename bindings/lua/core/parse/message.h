/// Texts of messages about arguments; private to bindings/lua/core/parse.
#pragma once

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "bindings/lua/core/compat.h"

namespace lissom::lua {

inline constexpr int kTextSize = 1024;

/// Runs `compose`, which returns a std::string, and copies the result: no C++ object is left alive
/// when a Lua error follows.
template <typename Compose>
void compose_text(char (&text)[kTextSize], const Compose& compose) noexcept {
    try {
        std::snprintf(text, sizeof text, "%s", std::string(compose()).c_str());
    } catch (const std::exception&) {
        std::snprintf(text, sizeof text, "bad argument");
    }
}

/// Returns "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// Pushes a description of the value at `index`, and returns it. `expected_type` is the type of
/// object wanted.
const char* push_description(lua_State* L, int index, const char* expected_type);

}  // namespace lissom::lua
