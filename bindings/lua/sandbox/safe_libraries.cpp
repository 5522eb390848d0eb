// Lua's base library and require without the functions that reach out of the sandbox, and ended
// when the script has to.
#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

#include "bindings/lua/host/counted_state.h"
#include "bindings/lua/host/script_files.h"
#include "bindings/lua/sandbox/sandbox_state.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::lua {
namespace {

namespace fs = std::filesystem;

// Longest format of os.date.
constexpr std::size_t kMaxDate = 4096;

void end_in_time(lua_State* L) {
    if (stop_of(L).asked()) raise_stopped(L);
}

int return_all(lua_State* L, int, lua_KContext) {
    return lua_gettop(L);
}

// Upvalue 1: the function, which may yield.
int call_in_time(lua_State* L) {
    end_in_time(L);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_callk(L, lua_gettop(L) - 1, LUA_MULTRET, 0, return_all);
    return lua_gettop(L);
}

std::size_t string_bytes(lua_State* L, int first, int last) {
    std::size_t bytes = 0;
    for (int i = first; i <= last; ++i) {
        if (lua_type(L, i) == LUA_TSTRING) bytes += raw_length(L, i);
    }
    return bytes;
}

// Upvalue 1: the function.
int call_counted(lua_State* L) {
    const int given = lua_gettop(L);
    charge_bytes(L, string_bytes(L, 1, given));
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, given, LUA_MULTRET);
    charge_bytes(L, string_bytes(L, 1, lua_gettop(L)));
    return lua_gettop(L);
}

void remove_fields(lua_State* L, int table, std::initializer_list<const char*> names) {
    table = lua_absindex(L, table);
    for (const char* name : names) {
        lua_pushnil(L);
        lua_setfield(L, table, name);
    }
}

// Keeps these fields of the global table `name`, and no others.
void keep_fields(lua_State* L, const char* name, std::initializer_list<const char*> names) {
    lua_newtable(L);
    lua_getglobal(L, name);
    for (const char* field : names) {
        lua_getfield(L, -1, field);
        lua_setfield(L, -3, field);
    }
    lua_pop(L, 1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, name);
    lua_pop(L, 1);
    lua_setglobal(L, name);
}

// A text that the compiler reads in pieces, so that it ends with the script.
struct ReadText {
    std::string_view left;
};

const char* read_piece(lua_State* L, void* data, std::size_t* size) {
    constexpr std::size_t kPiece = 4096;
    std::string_view& left = static_cast<ReadText*>(data)->left;
    charge_bytes(L, kPiece);
    const std::string_view piece = left.substr(0, kPiece);
    left.remove_prefix(piece.size());
    *size = piece.size();
    return piece.data();
}

int load_string(lua_State* L, bool has_environment) {
    std::size_t size = 0;
    const char* text = lua_tolstring(L, 1, &size);
    ReadText source{{text, size}};
    const bool takes_text =
        std::string_view(luaL_optstring(L, 3, "t")).find('t') != std::string_view::npos;
    const char* name = luaL_optstring(L, 2, text);
    const int status = lua_load(L, read_piece, &source, name, takes_text ? "t" : "");
    end_in_time(L);
    if (status != LUA_OK) {
        lua_pushnil(L);
        lua_insert(L, -2);
        return 2;
    }
    if (has_environment) {
        lua_pushvalue(L, 4);
        if (lua_setupvalue(L, -2, 1) == nullptr) lua_pop(L, 1);
    }
    return 1;
}

// load(chunk, name, mode, env): of text only. Upvalue 1: Lua's.
int load_text(lua_State* L) {
    end_in_time(L);
    const int given = lua_gettop(L);
    lua_settop(L, given < 3 ? 3 : given > 4 ? 4 : given);
    if (lua_type(L, 1) == LUA_TSTRING) return load_string(L, given >= 4);
    lua_pushliteral(L, "t");
    lua_replace(L, 3);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
}

// Upvalue 1: Lua's.
int format_date(lua_State* L) {
    std::size_t size = 0;
    luaL_optlstring(L, 1, "%c", &size);
    if (size > kMaxDate) return luaL_error(L, "too long a format for a date in a sandbox");
    return call_in_time(L);
}

// Finalizers run outside of all limits. Upvalue 1: Lua's.
int set_metatable(lua_State* L) {
    if (lua_istable(L, 2)) {
        lua_pushliteral(L, "__gc");
        if (lua_rawget(L, 2) != LUA_TNIL) {
            return luaL_error(L, "a metatable with __gc is not for scripts in a sandbox");
        }
        lua_pop(L, 1);
    }
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, 1);
    return 1;
}

// Key of Lua's registry: the weak table from values to their numbers.
const char kNumbers = 0;

// Pushes the number of the value at `index`, counted from 1 in the order in which they are shown.
void push_number_of(lua_State* L, int index) {
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kNumbers) == LUA_TNIL) {
        lua_pop(L, 1);
        lua_newtable(L);
        lua_createtable(L, 0, 1);
        lua_pushliteral(L, "k");
        lua_setfield(L, -2, "__mode");
        lua_setmetatable(L, -2);
        lua_pushvalue(L, -1);
        lua_rawsetp(L, LUA_REGISTRYINDEX, &kNumbers);
    }
    lua_pushvalue(L, index);
    if (lua_rawget(L, -2) == LUA_TNIL) {
        lua_pop(L, 1);
        lua_rawgetp(L, -1, &kNumbers);
        lua_pushinteger(L, lua_tointeger(L, -1) + 1);
        lua_replace(L, -2);
        lua_pushvalue(L, -1);
        lua_rawsetp(L, -3, &kNumbers);
        lua_pushvalue(L, index);
        lua_pushvalue(L, -2);
        lua_rawset(L, -4);
    }
    lua_remove(L, -2);
}

int show(lua_State* L) {
    luaL_checkany(L, 1);
    push_shown(L, 1);
    return 1;
}

// Upvalue 1: Lua's.
int collect_garbage(lua_State* L) {
    end_in_time(L);
    static const char* const kOptions[] = {"collect", "count", "step", nullptr};
    luaL_checkoption(L, 1, "collect", kOptions);
    lua_settop(L, 1);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, 1, LUA_MULTRET);
    return lua_gettop(L);
}

// A handler of messages. An error that a hook raises is handled while hooks are off: a handler
// would then run without limits, and there is nothing left to handle. Upvalue 1: the script's.
int handle_message(lua_State* L) {
    lua_settop(L, 1);
    if (stop_of(L).asked()) return 1;
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, 1, 1);
    return 1;
}

// Upvalue 1: Lua's.
int call_with_handler(lua_State* L) {
    luaL_checktype(L, 2, LUA_TFUNCTION);
    lua_pushvalue(L, 2);
    lua_pushcclosure(L, handle_message, 1);
    lua_replace(L, 2);
    return call_in_time(L);
}

void replace_global(lua_State* L, const char* name, lua_CFunction with) {
    lua_getglobal(L, name);
    lua_pushcclosure(L, with, 1);
    lua_setglobal(L, name);
}

// ---- Coroutines. One that a hook's error has ended keeps its hooks off: its variables to close
// must not be called then.

// Raises the error on top of the stack with the place of the call, as Lua's wrap does.
int raise_at_call(lua_State* L, int status) {
    if (status != LUA_ERRMEM && lua_type(L, -1) == LUA_TSTRING) {
        luaL_where(L, 1);
        lua_insert(L, -2);
        lua_concat(L, 2);
    }
    return lua_error(L);
}

// Closes a coroutine that an error has ended, and leaves its error on top of `L`. One that cannot
// be resumed, for it runs or has ended, is not touched.
int close_failed(lua_State* L, lua_State* thread) {
    const int status = lua_status(thread);
    if (status == LUA_OK || status == LUA_YIELD) {
        lua_xmove(thread, L, 1);
        return status;
    }
    end_in_time(L);
    const int closed = lua_resetthread(thread);
    lua_xmove(thread, L, 1);
    return closed;
}

// Upvalue 1: the coroutine. Its results, or its error with the place of the call.
int resume_wrapped(lua_State* L) {
    lua_State* thread = lua_tothread(L, lua_upvalueindex(1));
    const int given = lua_gettop(L);
    if (!lua_checkstack(thread, given)) return luaL_error(L, "too many arguments to resume");
    lua_xmove(L, thread, given);
    int count = 0;
    const int status = lua_resume(thread, L, given, &count);
    if (status != LUA_OK && status != LUA_YIELD) {
        return raise_at_call(L, close_failed(L, thread));
    }
    if (!lua_checkstack(L, count + 1)) {
        lua_pop(thread, count);
        return luaL_error(L, "too many results to resume");
    }
    lua_xmove(thread, L, count);
    return count;
}

// Instructions that a coroutine may run before its own count is looked at.
constexpr std::size_t kUncounted = 20;

// Upvalue 1: Lua's.
int create_coroutine(lua_State* L) {
    charge(L, kUncounted);
    return call_in_time(L);
}

int wrap_coroutine(lua_State* L) {
    luaL_checktype(L, 1, LUA_TFUNCTION);
    charge(L, kUncounted);
    lua_State* thread = lua_newthread(L);
    lua_pushvalue(L, 1);
    lua_xmove(L, thread, 1);
    lua_pushcclosure(L, resume_wrapped, 1);
    return 1;
}

void replace_field(lua_State* L, const char* name, lua_CFunction with) {
    lua_getfield(L, -1, name);
    lua_pushcclosure(L, with, 1);
    lua_setfield(L, -2, name);
}

// Letters, digits, '_' and dots between them: no way out of a folder.
bool is_module_name(std::string_view name) {
    bool after_dot = true;
    for (const char c : name) {
        if (c == '.' && after_dot) return false;
        after_dot = c == '.';
        if (!after_dot && c != '_' && !std::isalnum(static_cast<unsigned char>(c))) return false;
    }
    return !after_dot;
}

std::string module_path(std::string_view name) {
    std::string path(name);
    for (char& c : path) c = c == '.' ? '/' : c;
    return path + ".lua";
}

// A module that was found; without a path if there is none.
struct Module {
    fs::path path;
    std::string text;
};

Module find_module(const Sandbox& sandbox, std::string_view name) {
    const Context context = sandbox.state().context;
    for (const fs::path& folder : module_folders_of(sandbox)) {
        const fs::path path = folder / module_path(name);
        std::error_code failed;
        const bool by_host = static_cast<bool>(context.files().read);
        if (!by_host && !fs::is_regular_file(path, failed)) continue;
        try {
            return {path, read_file(path, context).bytes};
        } catch (const Error& error) {
            if (error.code() != ErrorCode::file_not_found) throw;
        }
    }
    return {};
}

// Pushes the function of the module, or false.
void push_module(lua_State* L, const char* name) {
    char message[256];
    message[0] = '\0';
    bool found = false;
    try {
        const Module module = find_module(sandbox_of(L), name);
        found = !module.path.empty();
        if (found) {
            const std::string place = "@" + display_name(module.path);
            // Pushes a function or a message, and raises nothing.
            const std::string_view text = lua_text_of(module.text);
            luaL_loadbufferx(L, text.data(), text.size(), place.c_str(), "t");
        }
    } catch (const std::exception& error) {
        std::snprintf(message, sizeof message, "%s", error.what());
        found = false;
    }
    if (message[0] != '\0') luaL_error(L, "module '%s': %s", name, message);
    if (!found) lua_pushboolean(L, 0);
}

// package.searchpath(name): the file of a module, as require finds it, or nil and a message.
int search_module(lua_State* L) {
    const char* name = luaL_checkstring(L, 1);
    if (!is_module_name(name)) return luaL_error(L, "'%s' is no name of a module", name);
    char place[1024] = "";
    try {
        std::snprintf(place, sizeof place, "%s",
                      display_name(find_module(sandbox_of(L), name).path).c_str());
    } catch (const std::exception&) {
        place[0] = '\0';
    }
    if (place[0] != '\0') {
        lua_pushstring(L, place);
        return 1;
    }
    lua_pushnil(L);
    lua_pushfstring(L, "there is no module '%s'", name);
    return 2;
}

int require_module(lua_State* L) {
    const char* name = luaL_checkstring(L, 1);
    lua_settop(L, 1);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_getfield(L, 2, name);
    if (lua_toboolean(L, -1)) return 1;
    lua_pop(L, 1);
    if (!is_module_name(name)) {
        return luaL_error(L, "module '%s': a sandbox looks for names like 'parts.wheel' only",
                          name);
    }
    push_module(L, name);
    if (lua_isstring(L, -1)) return lua_error(L);
    if (!lua_isfunction(L, -1)) return luaL_error(L, "module '%s' not found", name);
    lua_pushvalue(L, 1);
    lua_call(L, 1, 1);
    if (lua_isnil(L, -1)) {
        lua_pop(L, 1);
        lua_pushboolean(L, 1);
    }
    lua_pushvalue(L, -1);
    lua_setfield(L, 2, name);
    return 1;
}

}  // namespace

void wrap_costly(lua_State* L, const char* library, std::initializer_list<const char*> names) {
    lua_getglobal(L, library);
    for (const char* name : names) {
        lua_getfield(L, -1, name);
        lua_pushcclosure(L, call_counted, 1);
        lua_setfield(L, -2, name);
    }
    lua_pop(L, 1);
}

void make_coroutines_stop(lua_State* L) {
    lua_getglobal(L, LUA_COLIBNAME);
    lua_pushcfunction(L, wrap_coroutine);
    lua_setfield(L, -2, "wrap");
    replace_field(L, "close", call_in_time);
    lua_pop(L, 1);
}

void push_shown(lua_State* L, int index) {
    index = lua_absindex(L, index);
    const int type = lua_type(L, index);
    const bool is_plain =
        type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING;
    if (is_plain || luaL_getmetafield(L, index, "__tostring") != LUA_TNIL) {
        if (!is_plain) lua_pop(L, 1);
        luaL_tolstring(L, index, nullptr);
        return;
    }
    const int named = luaL_getmetafield(L, index, "__name");
    if (named != LUA_TNIL && named != LUA_TSTRING) lua_pop(L, 1);
    if (named != LUA_TSTRING) lua_pushstring(L, luaL_typename(L, index));
    push_number_of(L, index);
    lua_pushfstring(L, "%s: %I", lua_tostring(L, -2), lua_tointeger(L, -1));
    lua_replace(L, -3);
    lua_pop(L, 1);
}

void make_base_safe(lua_State* L) {
    lua_pushglobaltable(L);
    remove_fields(L, -1, {"dofile", "loadfile", "warn"});
    lua_pop(L, 1);
    lua_pushcfunction(L, show);
    lua_setglobal(L, "tostring");
    replace_global(L, "load", load_text);
    replace_global(L, "setmetatable", set_metatable);
    replace_global(L, "collectgarbage", collect_garbage);
    keep_fields(L, LUA_OSLIBNAME, {"clock", "date", "difftime", "time"});
    lua_getglobal(L, LUA_OSLIBNAME);
    lua_pushcfunction(L, refuse_exit);
    lua_setfield(L, -2, "exit");
    replace_field(L, "date", format_date);
    lua_pop(L, 1);
    keep_fields(L, LUA_DBLIBNAME, {"traceback"});
    replace_global(L, "xpcall", call_with_handler);
    make_coroutines_stop(L);
    lua_getglobal(L, LUA_COLIBNAME);
    replace_field(L, "create", create_coroutine);
    lua_pop(L, 1);
    wrap_costly(L, LUA_UTF8LIBNAME, {"len", "offset", "codepoint"});
}

void make_require_safe(lua_State* L) {
    lua_pushcfunction(L, require_module);
    lua_setglobal(L, "require");
    lua_newtable(L);
    luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_setfield(L, -2, "loaded");
    lua_pushcfunction(L, search_module);
    lua_setfield(L, -2, "searchpath");
    // Scripts add to it; require looks elsewhere.
    lua_pushliteral(L, "");
    lua_setfield(L, -2, "path");
    lua_setglobal(L, "package");
}

}  // namespace lissom::lua
