// Functions of strings that end when the script has to.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string_view>

#include "bindings/lua/sandbox/pattern.h"
#include "bindings/lua/sandbox/sandbox_state.h"

namespace lissom::lua {
namespace {

// Characters of a replacement that are added between two looks at the limits.
constexpr std::size_t kPiece = 4096;
// Longest text that %q may have.
constexpr std::size_t kMaxQuoted = std::size_t{1} << 20;

std::string_view text_at(lua_State* L, int index) {
    std::size_t size = 0;
    const char* text = luaL_checklstring(L, index, &size);
    return {text, size};
}

// The work is C++ without Lua, and its exceptions become errors of Lua's.
template <typename Work>
void guard(lua_State* L, const Work& work) {
    char message[128];
    message[0] = '\0';
    bool stopped = false;
    try {
        work();
        return;
    } catch (const PatternError& error) {
        std::snprintf(message, sizeof message, "%s", error.what());
    } catch (const Stopped&) {
        stopped = true;
    }
    if (stopped) raise_stopped(L);
    luaL_error(L, "%s", message);
}

// A match in the text: from `begin` to `end`, which is kNone if there is none.
struct Match {
    std::size_t begin, end;
};

Match match_from(lua_State* L, Matcher& matcher, std::string_view text, std::size_t begin,
                 bool anchored) {
    Match found{begin, Matcher::kNone};
    guard(L, [&] {
        for (; found.begin <= text.size(); ++found.begin) {
            found.end = matcher.match_at(found.begin);
            if (found.end != Matcher::kNone || anchored) return;
        }
    });
    return found;
}

void push_part(lua_State* L, std::string_view text) {
    lua_pushlstring(L, text.data(), text.size());
}

// Capture i, counted from 0; the whole match if the pattern has none.
void push_capture(lua_State* L, const Matcher& matcher, std::string_view text, const Match& match,
                  int i) {
    if (i >= matcher.capture_count()) {
        if (i > 0) luaL_error(L, "invalid capture index %%%d", i + 1);
        return push_part(L, text.substr(match.begin, match.end - match.begin));
    }
    Capture capture;
    guard(L, [&] { capture = matcher.capture(i); });
    if (capture.length == Capture::kPosition) {
        lua_pushinteger(L, static_cast<lua_Integer>(capture.begin) + 1);
    } else {
        push_part(L, text.substr(capture.begin, capture.length));
    }
}

int push_captures(lua_State* L, const Matcher& matcher, std::string_view text, const Match& match,
                  bool whole) {
    const int count = matcher.capture_count() == 0 && whole ? 1 : matcher.capture_count();
    luaL_checkstack(L, count, "too many captures");
    for (int i = 0; i < count; ++i) push_capture(L, matcher, text, match, i);
    return count;
}

// 0-based place of a 1-based one that counts from the end if it is negative; kNone beyond it.
std::size_t begin_at(lua_State* L, int index, std::size_t size) {
    const lua_Integer given = luaL_optinteger(L, index, 1);
    const auto length = static_cast<lua_Integer>(size);
    if (given > length + 1) return Matcher::kNone;
    if (given > 0) return static_cast<std::size_t>(given - 1);
    return given == 0 || given < -length ? 0 : static_cast<std::size_t>(length + given);
}

int push_found(lua_State* L, std::size_t begin, std::size_t end) {
    lua_pushinteger(L, static_cast<lua_Integer>(begin) + 1);
    lua_pushinteger(L, static_cast<lua_Integer>(end));
    return 2;
}

int find_or_match(lua_State* L, bool finds) {
    const std::string_view text = text_at(L, 1);
    std::string_view pattern = text_at(L, 2);
    const std::size_t begin = begin_at(L, 3, text.size());
    const Stop& stop = stop_of(L);
    if (begin == Matcher::kNone) {
        lua_pushnil(L);
        return 1;
    }
    if (finds && (lua_toboolean(L, 4) || is_plain(pattern))) {
        std::size_t at = Matcher::kNone;
        guard(L, [&] { at = find_plain(text, pattern, begin, stop); });
        if (at != Matcher::kNone) return push_found(L, at, at + pattern.size());
        lua_pushnil(L);
        return 1;
    }
    const bool anchored = pattern.starts_with('^');
    if (anchored) pattern.remove_prefix(1);
    Matcher matcher(text, pattern, stop);
    const Match match = match_from(L, matcher, text, begin, anchored);
    if (match.end == Matcher::kNone) {
        lua_pushnil(L);
        return 1;
    }
    if (!finds) return push_captures(L, matcher, text, match, true);
    push_found(L, match.begin, match.end);
    return 2 + push_captures(L, matcher, text, match, false);
}

int find(lua_State* L) {
    return find_or_match(L, true);
}
int match(lua_State* L) {
    return find_or_match(L, false);
}

// Upvalues: text, pattern, place of the next search, and end of the last match or -1.
int next_match(lua_State* L) {
    const std::string_view text = text_at(L, lua_upvalueindex(1));
    Matcher matcher(text, text_at(L, lua_upvalueindex(2)), stop_of(L));
    auto begin = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(3)));
    const lua_Integer last = lua_tointeger(L, lua_upvalueindex(4));
    while (begin <= text.size()) {
        const Match match = match_from(L, matcher, text, begin, false);
        if (match.end == Matcher::kNone) break;
        if (static_cast<lua_Integer>(match.end) == last) {
            // An empty match right behind the last one is the end of that.
            begin = match.begin + 1;
            continue;
        }
        lua_pushinteger(L, static_cast<lua_Integer>(match.end));
        lua_copy(L, -1, lua_upvalueindex(3));
        lua_replace(L, lua_upvalueindex(4));
        return push_captures(L, matcher, text, match, true);
    }
    return 0;
}

int gmatch(lua_State* L) {
    const std::string_view text = text_at(L, 1);
    text_at(L, 2);
    const std::size_t begin = begin_at(L, 3, text.size());
    lua_settop(L, 2);
    lua_pushinteger(L, static_cast<lua_Integer>(begin == Matcher::kNone ? text.size() + 1 : begin));
    lua_pushinteger(L, -1);
    lua_pushcclosure(L, next_match, 4);
    return 1;
}

// Adds the replacement string with its captures.
void add_text(lua_State* L, luaL_Buffer* buffer, const Matcher& matcher, std::string_view text,
              const Match& match) {
    const std::string_view with = text_at(L, 3);
    charge_bytes(L, with.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
        if (i % kPiece == kPiece - 1) charge_bytes(L, 0);
        if (with[i] != '%') {
            luaL_addchar(buffer, with[i]);
            continue;
        }
        const char c = ++i < with.size() ? with[i] : '\0';
        if (c == '%') {
            luaL_addchar(buffer, '%');
        } else if (c == '0') {
            luaL_addlstring(buffer, text.data() + match.begin, match.end - match.begin);
        } else if (c >= '1' && c <= '9') {
            push_capture(L, matcher, text, match, c - '1');
            luaL_tolstring(L, -1, nullptr);
            lua_remove(L, -2);
            luaL_addvalue(buffer);
        } else {
            luaL_error(L, "invalid use of '%%' in replacement string");
        }
    }
}

void add_replacement(lua_State* L, luaL_Buffer* buffer, const Matcher& matcher,
                     std::string_view text, const Match& match) {
    const int type = lua_type(L, 3);
    if (type == LUA_TFUNCTION) {
        lua_pushvalue(L, 3);
        lua_call(L, push_captures(L, matcher, text, match, true), 1);
    } else if (type == LUA_TTABLE) {
        push_capture(L, matcher, text, match, 0);
        lua_gettable(L, 3);
    } else {
        return add_text(L, buffer, matcher, text, match);
    }
    if (!lua_toboolean(L, -1)) {
        lua_pop(L, 1);
        push_part(L, text.substr(match.begin, match.end - match.begin));
    } else if (!lua_isstring(L, -1)) {
        luaL_error(L, "invalid replacement value (a %s)", luaL_typename(L, -1));
    }
    luaL_addvalue(buffer);
}

int gsub(lua_State* L) {
    const std::string_view text = text_at(L, 1);
    std::string_view pattern = text_at(L, 2);
    const int type = lua_type(L, 3);
    const lua_Integer most = luaL_optinteger(L, 4, static_cast<lua_Integer>(text.size()) + 1);
    luaL_argexpected(
        L,
        type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TTABLE || type == LUA_TFUNCTION,
        3, "string/function/table");
    const bool anchored = pattern.starts_with('^');
    if (anchored) pattern.remove_prefix(1);
    Matcher matcher(text, pattern, stop_of(L));
    luaL_Buffer buffer;
    luaL_buffinit(L, &buffer);
    std::size_t at = 0, last = Matcher::kNone;
    lua_Integer count = 0;
    while (count < most) {
        const Match match = match_from(L, matcher, text, at, true);
        if (match.end != Matcher::kNone && match.end != last) {
            ++count;
            add_replacement(L, &buffer, matcher, text, match);
            at = last = match.end;
        } else if (at < text.size()) {
            luaL_addchar(&buffer, text[at]);
            ++at;
        } else {
            break;
        }
        if (anchored) break;
    }
    luaL_addlstring(&buffer, text.data() + at, text.size() - at);
    luaL_pushresult(&buffer);
    lua_pushinteger(L, count);
    return 2;
}

// Upvalue 1: Lua's, which counts to n even if it repeats nothing.
int repeat(lua_State* L) {
    const std::size_t size = text_at(L, 1).size();
    const lua_Integer times = luaL_checkinteger(L, 2);
    const std::size_t between = lua_isnoneornil(L, 3) ? 0 : text_at(L, 3).size();
    if (size + between == 0 || times <= 0) {
        lua_pushliteral(L, "");
        return 1;
    }
    constexpr std::uint64_t kMost = std::min<std::uint64_t>(
        std::numeric_limits<lua_Integer>::max(), std::numeric_limits<std::size_t>::max());
    if (size + between > kMost / static_cast<std::uint64_t>(times)) {
        return luaL_error(L, "resulting string too large");
    }
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, 1);
    charge_bytes(L, text_at(L, -1).size());
    return 1;
}

// Shows the arguments of %s as tostring does: Lua's own shows addresses, as %p does.
void show_arguments(lua_State* L) {
    const std::string_view format = text_at(L, 1);
    int argument = 1;
    for (std::size_t at = format.find('%'); at < format.size(); at = format.find('%', at)) {
        at = format.find_first_not_of("-+ #0123456789.", at + 1);
        if (at >= format.size()) return;
        const char kind = format[at++];
        if (kind == '%') continue;
        ++argument;
        if (argument > lua_gettop(L)) return;
        if (kind == 'p') luaL_error(L, "'%%p' shows addresses, which a sandbox does not give");
        if (kind != 's') continue;
        push_shown(L, argument);
        lua_replace(L, argument);
    }
}

// Upvalue 1: Lua's. One text alone may keep %q busy for seconds.
int format(lua_State* L) {
    show_arguments(L);
    const bool quotes = text_at(L, 1).find("%q") != std::string_view::npos;
    const int given = lua_gettop(L);
    std::size_t bytes = text_at(L, 1).size();
    for (int i = 2; i <= given; ++i) {
        if (lua_type(L, i) != LUA_TSTRING) continue;
        bytes += raw_length(L, i);
        if (quotes && raw_length(L, i) > kMaxQuoted) {
            return luaL_error(L, "too long a string for '%%q' in a sandbox");
        }
    }
    charge_bytes(L, bytes);
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, given, 1);
    charge_bytes(L, raw_length(L, -1));
    return 1;
}

void wrap(lua_State* L, const char* name, lua_CFunction with) {
    lua_getfield(L, -1, name);
    lua_pushcclosure(L, with, 1);
    lua_setfield(L, -2, name);
}

}  // namespace

void make_patterns_stop(lua_State* L) {
    lua_getglobal(L, LUA_STRLIBNAME);
    const luaL_Reg functions[] = {
        {"find", find}, {"match", match}, {"gmatch", gmatch}, {"gsub", gsub}, {nullptr, nullptr}};
    luaL_setfuncs(L, functions, 0);
    wrap(L, "rep", repeat);
    lua_pop(L, 1);
}

void make_strings_safe(lua_State* L) {
    make_patterns_stop(L);
    lua_getglobal(L, LUA_STRLIBNAME);
    wrap(L, "format", format);
    lua_pushnil(L);
    lua_setfield(L, -2, "dump");
    lua_pop(L, 1);
    wrap_costly(L, LUA_STRLIBNAME,
                {"upper", "lower", "reverse", "sub", "byte", "pack", "unpack", "packsize"});
}

}  // namespace lissom::lua
