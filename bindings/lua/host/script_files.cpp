#include "bindings/lua/host/script_files.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/failure.h"
#include "bindings/lua/core/state.h"
#include "kernel/io/stream/file.h"

namespace lissom::lua {
namespace {

// Throws Error.
FileContent content_of(const State& state, std::string_view name) {
    const std::filesystem::path path(std::u8string(name.begin(), name.end()));
    if (state.host.check_file) state.host.check_file(path, FileUse::read);
    return read_file(path, state.context);
}

// Pushes the function of the file.
void push_script(lua_State* L, const char* name) {
    Failure failure;
    int status = 0;
    const bool read = failure.guard([&] {
        const FileContent content = content_of(*find_state(L), name);
        const std::string_view text = lua_text_of(content.bytes);
        const std::string place = std::string("@") + name;
        status = luaL_loadbufferx(L, text.data(), text.size(), place.c_str(), "t");
    });
    if (!read) raise_failure(L, failure);
    if (status == 0) return;
    failure.set(ErrorCode::file_syntax, to_display_string(L, -1));
    raise_failure(L, failure);
}

}  // namespace

std::string_view lua_text_of(std::string_view bytes) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (bytes.starts_with(kMark)) bytes.remove_prefix(kMark.size());
    if (!bytes.starts_with('#')) return bytes;
    const std::size_t end = bytes.find('\n');
    return end == std::string_view::npos ? std::string_view() : bytes.substr(end);
}

int load_script_file(lua_State* L) {
    const char* name = luaL_checkstring(L, 1);
    lua_settop(L, 2);
    push_script(L, name);
    if (lua_isnil(L, 2)) return 1;
    lua_pushvalue(L, 2);
#if LUA_VERSION_NUM >= 502
    if (!lua_setupvalue(L, -2, 1)) lua_pop(L, 1);
#else
    lua_setfenv(L, -2);
#endif
    return 1;
}

int find_script_file(lua_State* L) {
    const char* name = luaL_checkstring(L, 1);
    Failure failure;
    if (failure.guard([&] { content_of(*find_state(L), name); })) {
        lua_pushboolean(L, 1);
        return 1;
    }
    lua_pushnil(L);
    lua_pushstring(L, failure.message);
    return 2;
}

}  // namespace lissom::lua
