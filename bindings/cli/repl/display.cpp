#include "bindings/cli/repl/display.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <vector>

#include "bindings/lua/core/state.h"

namespace lissom::cli {
namespace {

constexpr std::size_t kWidth = 88;
constexpr int kDeepest = 4;
constexpr lua_Integer kMaxItems = 12;
constexpr std::size_t kMaxFields = 40;

// Runs inside lua_pcall: value -> text.
int to_text(lua_State* L) {
    lua::to_display_string(L, 1);
    return 1;
}

// Runs inside lua_pcall: object -> its bounds.
int bounds_of(lua_State* L) {
    lua_getfield(L, 1, "bounds");
    lua_pushvalue(L, 1);
    lua_call(L, 1, 1);
    return 1;
}

// Calls `function` with the value at `index`; its result is on top of the stack, or false returned.
bool call(lua_State* L, lua_CFunction function, int index) {
    index = lua_absindex(L, index);
    lua_pushcfunction(L, function);
    lua_pushvalue(L, index);
    if (lua_pcall(L, 1, 1, 0) == LUA_OK) return true;
    lua_pop(L, 1);
    return false;
}

std::string text_of(lua_State* L, int index) {
    if (!call(L, to_text, index)) return std::string("a ") + luaL_typename(L, index);
    std::size_t size = 0;
    const char* text = lua_tolstring(L, -1, &size);
    const std::string result(text ? text : "", text ? size : 0);
    lua_pop(L, 1);
    return result;
}

std::string quoted(const std::string& text) {
    constexpr std::size_t kLongest = 60;
    std::string result = "\"";
    for (const char c : text.substr(0, kLongest)) {
        if (c == '"' || c == '\\') result += '\\';
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result + (text.size() > kLongest ? "...\"" : "\"");
}

bool is_name(const std::string& text) {
    return !text.empty() && !std::isdigit(static_cast<unsigned char>(text[0])) &&
           std::all_of(text.begin(), text.end(),
                       [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

bool has_bounds(const lua::Type& type) {
    return std::any_of(type.methods.begin(), type.methods.end(), [](const lua::Function& method) {
        return method.name == "bounds" && method.arguments.empty();
    });
}

class Display {
  public:
    explicit Display(lua_State* L) : L_(L) {}

    std::string value(int index, int depth) {
        index = lua_absindex(L_, index);
        switch (lua_type(L_, index)) {
            case LUA_TSTRING:
                return depth == 0 ? text_of(L_, index) : quoted(text_of(L_, index));
            case LUA_TTABLE:
                return has_text(index) ? text_of(L_, index) : table(index, depth);
            case LUA_TUSERDATA:
                return depth == 0 ? object(index) : text_of(L_, index);
            case LUA_TFUNCTION:
                return function(index);
            default:
                return text_of(L_, index);
        }
    }

  private:
    bool has_text(int index) {
        if (!luaL_getmetafield(L_, index, "__tostring")) return false;
        lua_pop(L_, 1);
        return true;
    }

    std::string function(int index) {
        const lua::Entry* entry = lua::find_entry(L_, index);
        if (!entry) return text_of(L_, index);
        const std::string name = entry->function->name;
        return "function " + (entry->type ? entry->type->name + ":" + name : "lissom." + name);
    }

    std::string object(int index) {
        std::string text = text_of(L_, index);
        const lua::Type* type = lua::find_type(L_, index);
        if (!type || text.find(" from (") != std::string::npos || !has_bounds(*type)) return text;
        if (!call(L_, bounds_of, index)) return text;
        if (lua_istable(L_, -1)) text += "\n  bounds: " + table(lua_absindex(L_, -1), 1);
        lua_pop(L_, 1);
        return text;
    }

    std::string table(int index, int depth) {
        const void* address = lua_topointer(L_, index);
        const bool inside = std::find(open_.begin(), open_.end(), address) != open_.end();
        if (inside || depth >= kDeepest || !lua_checkstack(L_, LUA_MINSTACK)) return "{...}";
        open_.push_back(address);
        std::vector<std::string> parts = items(index, depth);
        for (std::string& field : fields(index, depth)) parts.push_back(std::move(field));
        open_.pop_back();
        return joined(parts, depth);
    }

    // The list part.
    std::vector<std::string> items(int index, int depth) {
        std::vector<std::string> parts;
        const auto size = static_cast<lua_Integer>(lua_rawlen(L_, index));
        for (lua_Integer i = 1; i <= std::min(size, kMaxItems); ++i) {
            lua_rawgeti(L_, index, i);
            parts.push_back(value(-1, depth + 1));
            lua_pop(L_, 1);
        }
        if (size > kMaxItems) parts.push_back("... (# = " + std::to_string(size) + ")");
        return parts;
    }

    // Everything else, ordered by key.
    std::vector<std::string> fields(int index, int depth) {
        std::vector<std::string> parts;
        const auto size = static_cast<lua_Integer>(lua_rawlen(L_, index));
        for (lua_pushnil(L_); lua_next(L_, index); lua_pop(L_, 1)) {
            const bool listed = lua_isinteger(L_, -2) && lua_tointeger(L_, -2) >= 1 &&
                                lua_tointeger(L_, -2) <= size;
            if (!listed) parts.push_back(key(-2) + " = " + value(-1, depth + 1));
        }
        std::sort(parts.begin(), parts.end());
        if (parts.size() > kMaxFields) {
            const std::size_t more = parts.size() - kMaxFields;
            parts.resize(kMaxFields);
            parts.push_back("... and " + std::to_string(more) + " more");
        }
        return parts;
    }

    std::string key(int index) {
        index = lua_absindex(L_, index);
        const bool is_text = lua_type(L_, index) == LUA_TSTRING;
        const std::string text = text_of(L_, index);
        if (is_text && is_name(text)) return text;
        return "[" + (is_text ? quoted(text) : text) + "]";
    }

    static std::string joined(const std::vector<std::string>& parts, int depth) {
        std::size_t width = 4;
        bool broken = false;
        for (const std::string& part : parts) {
            width += part.size() + 2;
            broken = broken || part.find('\n') != std::string::npos;
        }
        if (parts.empty()) return "{}";
        const std::string step = "\n" + std::string(at(depth + 1) * 2, ' ');
        const bool one_line = width <= kWidth && !broken;
        std::string text = "{";
        for (std::size_t i = 0; i < parts.size(); ++i) {
            text += (i > 0 ? "," : "") + (one_line ? std::string(" ") : step) + parts[i];
        }
        return text + (one_line ? " }" : step.substr(0, step.size() - 2) + "}");
    }

    lua_State* L_;
    // Tables that are being shown: one inside itself is not shown again.
    std::vector<const void*> open_;
};

}  // namespace

std::string display(lua_State* L, int index) {
    if (!lua_checkstack(L, LUA_MINSTACK)) return luaL_typename(L, index);
    return Display(L).value(index, 0);
}

}  // namespace lissom::cli
