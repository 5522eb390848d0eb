#include "bindings/lua/sandbox/stoppable.h"

#include "bindings/lua/sandbox/sandbox_state.h"

namespace lissom::lua {
namespace {

// Elements that Lua's table.move moves between two looks at the stop.
constexpr lua_Integer kMovedPiece = 1 << 20;

// Key of Lua's registry: Lua's own xpcall.
const char kXpcall = 0;

int return_message(lua_State* L) {
    lua_settop(L, 1);
    return 1;
}

// ---- Finalizers

// Upvalues: the script's finalizer and coroutine.resume. The argument is the object.
int finalize(lua_State* L) {
    lua_settop(L, 1);
    lua_pushvalue(L, lua_upvalueindex(2));
    lua_State* thread = lua_newthread(L);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_xmove(L, thread, 1);
    lua_pushvalue(L, 1);
    lua_call(L, 2, 2);
    if (lua_status(thread) == LUA_YIELD) {
        return luaL_error(L, "attempt to yield across a C-call boundary");
    }
    if (lua_toboolean(L, -2)) return 0;
    return lua_error(L);
}

// Upvalue 1: coroutine.resume.
int set_watched_metatable(lua_State* L) {
    const int type = lua_type(L, 2);
    luaL_checktype(L, 1, LUA_TTABLE);
    luaL_argexpected(L, type == LUA_TNIL || type == LUA_TTABLE, 2, "nil or table");
    if (luaL_getmetafield(L, 1, "__metatable") != LUA_TNIL) {
        return luaL_error(L, "cannot change a protected metatable");
    }
    lua_settop(L, 2);
    lua_pushliteral(L, "__gc");
    if (type == LUA_TTABLE && lua_rawget(L, 2) == LUA_TFUNCTION &&
        lua_tocfunction(L, -1) != finalize) {
        lua_pushliteral(L, "__gc");
        lua_insert(L, -2);
        lua_pushvalue(L, lua_upvalueindex(1));
        lua_pushcclosure(L, finalize, 2);
        lua_rawset(L, 2);
    }
    lua_settop(L, 2);
    lua_setmetatable(L, 1);
    return 1;
}

// ---- table.move

// The ranges of one call.
struct Moved {
    lua_Integer first, last, to;
};

Moved moved_at(lua_State* L) {
    return {luaL_checkinteger(L, 2), luaL_checkinteger(L, 3), luaL_checkinteger(L, 4)};
}

// Returns whether the later elements go first, as they would be overwritten.
bool goes_backwards(lua_State* L, const Moved& moved) {
    if (moved.to <= moved.first || moved.to > moved.last) return false;
    return lua_isnoneornil(L, 5) || lua_compare(L, 1, 5, LUA_OPEQ);
}

// Calls Lua's, upvalue 1, for `count` elements from `at` on.
void move_piece(lua_State* L, const Moved& moved, lua_Integer at, lua_Integer count) {
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushvalue(L, 1);
    lua_pushinteger(L, at);
    lua_pushinteger(L, at + count - 1);
    lua_pushinteger(L, moved.to + (at - moved.first));
    lua_pushvalue(L, 5);
    lua_call(L, 5, 0);
    charge(L, 0);
}

// Moves of more elements than memory holds end by a stop; others are Lua's own.
int move_in_pieces(lua_State* L) {
    const Moved moved = moved_at(L);
    const auto length =
        static_cast<lua_Unsigned>(moved.last) - static_cast<lua_Unsigned>(moved.first);
    const bool is_small = moved.last < moved.first || length < kMovedPiece;
    const bool overflows =
        !is_small && (moved.first <= 0 || moved.to > LUA_MAXINTEGER - (moved.last - moved.first));
    if (is_small || overflows) {
        lua_pushvalue(L, lua_upvalueindex(1));
        lua_insert(L, 1);
        lua_call(L, lua_gettop(L) - 1, 1);
        return 1;
    }
    lua_settop(L, 5);
    const bool backwards = goes_backwards(L, moved);
    lua_Integer left = moved.last - moved.first + 1;
    while (left > 0) {
        const lua_Integer count = left < kMovedPiece ? left : kMovedPiece;
        const lua_Integer at = backwards ? moved.first + left - count : moved.last - left + 1;
        move_piece(L, moved, at, count);
        left -= count;
    }
    lua_pushvalue(L, lua_isnoneornil(L, 5) ? 1 : 5);
    return 1;
}

// Returns whether the function of a frame is Lua's xpcall.
bool is_xpcall(lua_State* L, lua_Debug& frame) {
    lua_getinfo(L, "f", &frame);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &kXpcall);
    const bool is = lua_rawequal(L, -1, -2) != 0;
    lua_pop(L, 2);
    return is;
}

}  // namespace

struct Stoppable::Parts : Work {};

Stoppable::Stoppable() : parts_(std::make_unique<Parts>()) {}

Stoppable::~Stoppable() = default;

void Stoppable::open(lua_State* L, bool unsafe_debug) {
    set_work(L, *parts_);
    if (!unsafe_debug) make_debug_safe(L);
    make_patterns_stop(L);
    make_coroutines_stop(L);
    lua_getglobal(L, LUA_TABLIBNAME);
    lua_getfield(L, -1, "move");
    lua_pushcclosure(L, move_in_pieces, 1);
    lua_setfield(L, -2, "move");
    lua_pop(L, 1);
    lua_getglobal(L, "xpcall");
    lua_rawsetp(L, LUA_REGISTRYINDEX, &kXpcall);
}

void Stoppable::open_finalizers(lua_State* L) {
    lua_getglobal(L, LUA_COLIBNAME);
    lua_getfield(L, -1, "resume");
    lua_pushcclosure(L, set_watched_metatable, 1);
    lua_setglobal(L, "setmetatable");
    lua_pop(L, 1);
}

void Stoppable::follow(const Context& context) {
    parts_->stop.follow(context);
}

void drop_handlers(lua_State* L) {
    // The handler is the second value in the frame.
    constexpr int kHandler = 2;
    luaL_checkstack(L, LUA_MINSTACK, "no room to stop");
    lua_Debug frame;
    for (int level = 0; lua_getstack(L, level, &frame); ++level) {
        if (!is_xpcall(L, frame)) continue;
        lua_pushcfunction(L, return_message);
        if (!lua_setlocal(L, &frame, kHandler)) lua_pop(L, 1);
    }
}

}  // namespace lissom::lua
