#include "bindings/lua/sandbox/pattern.h"

#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include "bindings/lua/sandbox/sandbox.h"

namespace lissom::lua {
namespace {

// What a piece of Lua returns, by Lua's own string library or by that of a sandbox; errors too.
const char* const kTell = R"(
    local s, p, r = ...
    local out = {}
    local function tell(...)
        for i = 1, select("#", ...) do out[#out + 1] = tostring((select(i, ...))) end
        out[#out + 1] = ";"
    end
    for init = -3, 4 do
        tell(pcall(string.find, s, p, init))
        tell(pcall(string.match, s, p, init))
    end
    tell(pcall(string.find, s, p, 1, true))
    tell(pcall(string.gsub, s, p, r))
    tell(pcall(string.gsub, s, p, r, 2))
    tell(pcall(string.gsub, s, p, { a = 1, b = false }))
    tell(pcall(string.gsub, s, p, function(...) return table.concat({ ... }, "|") end))
    tell(pcall(function() for a, b in string.gmatch(s, p) do tell(a, b) end end))
    return table.concat(out, " ")
)";

std::string told(lua_State* L, const std::string& text, const std::string& pattern,
                 const std::string& replacement) {
    lua_settop(L, 0);
    REQUIRE(luaL_loadbufferx(L, kTell, std::char_traits<char>::length(kTell), "=tell", "t") ==
            LUA_OK);
    for (const std::string* word : {&text, &pattern, &replacement}) {
        lua_pushlstring(L, word->data(), word->size());
    }
    REQUIRE(lua_pcall(L, 3, 1, 0) == LUA_OK);
    std::size_t size = 0;
    const char* out = lua_tolstring(L, -1, &size);
    return {out, size};
}

class Words {
  public:
    explicit Words(unsigned seed) : random_(seed) {}

    std::string text() { return some({"a", "b", "ab", " ", "(", ")", "1", "_", "\n", "", "A"}, 8); }
    std::string pattern() {
        return (below(4) == 0 ? "^" : "") +
               some({"a",   "b",    ".",   "%a", "%s", "[ab]", "[^a]", "[%w_]", "[a-z]",  "(",
                     ")",   "()",   "*",   "+",  "-",  "?",    "%1",   "%b()",  "%f[%w]", "%(",
                     "[]]", "[^]]", "[a-", "%",  "x",  "%D",   "$",    "(a*)",  "(.-)",   "[%a-]"},
                    6) +
               (below(4) == 0 ? "$" : "");
    }
    std::string replacement() { return some({"x", "%0", "%1", "%%", "%2", "%", "-"}, 3); }

  private:
    int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
    std::string some(const std::vector<std::string>& pieces, int most) {
        std::string word;
        for (int i = below(most + 1); i > 0; --i) {
            word += pieces[static_cast<std::size_t>(below(static_cast<int>(pieces.size())))];
        }
        return word;
    }

    std::mt19937 random_;
};

// Messages name the function, and those of malformed patterns differ in their words.
std::string without_messages(std::string text) {
    for (std::size_t at = 0; (at = text.find("false ", at)) != std::string::npos;) {
        const std::size_t end = text.find(';', at);
        if (end == std::string::npos) break;
        text.replace(at, end - at, "false");
        at += 5;
    }
    return text;
}

TEST_CASE("patterns: the same as by Lua's own library") {
    lua_State* own = luaL_newstate();
    luaL_openlibs(own);
    Sandbox sandbox({}, {});
    Words words(7);
    int matched = 0;
    for (int i = 0; i < 4'000; ++i) {
        const std::string text = words.text(), pattern = words.pattern(),
                          replacement = words.replacement();
        CAPTURE(text);
        CAPTURE(pattern);
        CAPTURE(replacement);
        const std::string expected = without_messages(told(own, text, pattern, replacement));
        CHECK(without_messages(told(sandbox.lua(), text, pattern, replacement)) == expected);
        matched += expected.find("true 1") != std::string::npos;
    }
    CHECK(matched > 600);
    lua_close(own);
}

TEST_CASE("patterns: a matcher stops when it is asked to") {
    Stop stop;
    stop.ask();
    const std::string text(5000, 'a');
    Matcher matcher(text, ".-.-.-b", stop);
    CHECK_THROWS_AS(matcher.match_at(0), Stopped);
    CHECK_THROWS_AS(find_plain(text, std::string(2000, 'a') + "b", 0, stop), Stopped);
}

}  // namespace
}  // namespace lissom::lua
