#include "bindings/lua/core/call_site.h"

#include <cstring>
#include <string>
#include <vector>

#include "bindings/lua/core/call_rest.h"
#include "kernel/core/index.h"

namespace lissom::lua {
namespace {

// What becomes of the results at one place of a function.
enum class Fate : int { unknown, taken, dropped, passed_on };

struct Instruction {
    std::uint32_t code = 0;
    int base = 0;
    /// Results that the function takes; negative for as many as there are.
    int wanted = -1;
    int line = 0;
};

// Together: what is true of all instructions that it may have been.
Fate joined(Fate before, Fate now) {
    return before == Fate::unknown || before == now ? now : Fate::taken;
}

// Results after the first `kept` count.
Fate fate_of(const Instruction& one, const CallCodes& codes, int kept) {
    if (one.code == codes.tail || one.code == codes.open_tail) return Fate::passed_on;
    return one.wanted >= 0 && one.wanted <= kept ? Fate::dropped : Fate::taken;
}

bool calls(const Instruction& one, const CallCodes& codes) {
    return one.code == codes.call || one.code == codes.tail || one.code == codes.open_call ||
           one.code == codes.open_tail;
}

#if LUA_VERSION_NUM >= 504

// Reads the instructions and lines of a function that lua_dump has written (Lua 5.4's format).
class DumpReader {
  public:
    explicit DumpReader(const std::string& bytes) : bytes_(bytes) {}

    /// Empty where the format is another.
    std::vector<Instruction> instructions() {
        constexpr char kHeader[] = "\x1bLua\x54\x00\x19\x93\r\n\x1a\n\x04\x08\x08";
        constexpr std::size_t kHeaderSize = sizeof kHeader - 1;
        if (bytes_.compare(0, kHeaderSize, kHeader, kHeaderSize) != 0) return {};
        skip(kHeaderSize + sizeof(lua_Integer) + sizeof(lua_Number) + 1);
        std::vector<Instruction> list;
        read_function(&list, 0);
        return valid_ ? list : std::vector<Instruction>();
    }

  private:
    unsigned byte() {
        if (at_ >= bytes_.size()) valid_ = false;
        return valid_ ? static_cast<unsigned char>(bytes_[at_++]) : 0;
    }
    void skip(std::size_t count) {
        if (count > bytes_.size() - at_) valid_ = false;
        if (valid_) at_ += count;
    }
    std::size_t number() {
        constexpr int kMostBytes = 10;
        std::size_t value = 0;
        for (int i = 0; i < kMostBytes; ++i) {
            const unsigned next = byte();
            value = value << 7 | (next & 0x7f);
            if (next & 0x80) return value;
        }
        valid_ = false;
        return 0;
    }
    void skip_string() {
        const std::size_t size = number();
        if (size > 1) skip(size - 1);
    }

    void read_function(std::vector<Instruction>* list, int depth) {
        constexpr int kDeepest = 200;
        if (depth > kDeepest) valid_ = false;
        skip_string();
        const int first_line = index_of(number());
        number();
        skip(3);
        read_code(list);
        skip_constants();
        const std::size_t upvalues = number();
        skip(valid_ ? 3 * upvalues : 0);
        const std::size_t functions = number();
        for (std::size_t i = 0; valid_ && i < functions; ++i) read_function(nullptr, depth + 1);
        read_lines(list, first_line);
        const std::size_t locals = number();
        for (std::size_t i = 0; valid_ && i < locals; ++i) {
            skip_string();
            number();
            number();
        }
        const std::size_t names = number();
        for (std::size_t i = 0; valid_ && i < names; ++i) skip_string();
    }

    void read_code(std::vector<Instruction>* list) {
        const std::size_t count = number();
        if (count > bytes_.size() / 4) valid_ = false;
        for (std::size_t i = 0; valid_ && i < count; ++i) {
            std::uint32_t word = 0;
            skip(sizeof word);
            if (!valid_ || !list) continue;
            std::memcpy(&word, bytes_.data() + at_ - sizeof word, sizeof word);
            list->push_back({word & 0x7f, static_cast<int>(word >> 7 & 0xff),
                             static_cast<int>(word >> 24) - 1, 0});
        }
    }

    void skip_constants() {
        constexpr unsigned kFloat = 0x13, kInteger = 0x03, kShort = 0x04, kLong = 0x14;
        const std::size_t count = number();
        for (std::size_t i = 0; valid_ && i < count; ++i) {
            const unsigned kind = byte();
            if (kind == kFloat || kind == kInteger) skip(8);
            if (kind == kShort || kind == kLong) skip_string();
        }
    }

    // Lines are differences, but for those marked, which a second list has in full.
    void read_lines(std::vector<Instruction>* list, int line) {
        constexpr int kMark = -0x80;
        const std::size_t count = number();
        const std::size_t differences = at_;
        skip(count);
        const std::size_t marks = number();
        std::vector<int> full;
        for (std::size_t i = 0; valid_ && i < marks; ++i) {
            number();
            full.push_back(index_of(number()));
        }
        if (!valid_ || !list) return;
        std::size_t next = 0;
        for (std::size_t i = 0; i < count && i < list->size(); ++i) {
            // A byte with a sign.
            const int byte = static_cast<unsigned char>(bytes_[differences + i]);
            const int step = byte < 128 ? byte : byte - 256;
            if (step != kMark) {
                line += step;
            } else if (next < full.size()) {
                line = full[next++];
            }
            (*list)[i].line = line;
        }
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
    bool valid_ = true;
};

int append(lua_State*, const void* piece, std::size_t size, void* text) {
    try {
        static_cast<std::string*>(text)->append(static_cast<const char*>(piece), size);
        return 0;
    } catch (const std::exception&) {
        return 1;
    }
}

// Of the Lua function on top of the stack.
std::vector<Instruction> instructions_of(lua_State* L) {
    std::string bytes;
    if (lua_dump(L, append, &bytes, 0) != 0) return {};
    return DumpReader(bytes).instructions();
}

Fate find_fate(lua_State* L, int line, int base, const CallCodes& codes, int kept) noexcept {
    try {
        Fate fate = Fate::unknown;
        for (const Instruction& one : instructions_of(L)) {
            if (one.line != line || one.base != base || !calls(one, codes)) continue;
            fate = joined(fate, fate_of(one, codes, kept));
        }
        return fate;
    } catch (const std::exception&) {
        return Fate::unknown;
    }
}

// The instruction `from_end` places before the end of a chunk; code 0 where there is none.
Instruction instruction_in(lua_State* L, const char* chunk, std::size_t from_end) {
    Instruction found;
    if (luaL_loadstring(L, chunk) != 0) return found;
    try {
        const std::vector<Instruction> list = instructions_of(L);
        if (list.size() > from_end) found = list[list.size() - 1 - from_end];
    } catch (const std::exception&) {
        found.wanted = -1;
    }
    lua_pop(L, 1);
    return found;
}

#else

// LuaJIT: the word of instruction `place` of the function below the top of the stack, where
// jit.util.funcbc is on top; false behind the last.
bool word_at(lua_State* L, int place, std::uint32_t& word) {
    lua_pushvalue(L, -1);
    lua_pushvalue(L, -3);
    lua_pushinteger(L, place);
    const bool found = lua_pcall(L, 2, 1, 0) == 0 && lua_isnumber(L, -1);
    if (found) word = static_cast<std::uint32_t>(static_cast<std::int64_t>(lua_tonumber(L, -1)));
    lua_pop(L, 1);
    return found;
}

Instruction decoded(std::uint32_t word) {
    return {word & 0xff, static_cast<int>(word >> 8 & 0xff), static_cast<int>(word >> 24) - 1, 0};
}

// Pushes a function of jit.util, or nothing.
bool push_inspector(lua_State* L, const char* name) {
    lua_getfield(L, LUA_REGISTRYINDEX, "_LOADED");
    lua_getfield(L, -1, "jit.util");
    lua_remove(L, -2);
    if (lua_istable(L, -1)) {
        lua_getfield(L, -1, name);
        lua_remove(L, -2);
        if (lua_isfunction(L, -1)) return true;
    }
    lua_pop(L, 1);
    return false;
}

// Loads jit.util where the program has not.
void require_inspectors(lua_State* L) {
    lua_getglobal(L, "require");
    lua_pushliteral(L, "jit.util");
    if (lua_pcall(L, 1, 0, 0) != 0) lua_pop(L, 1);
}

// The line of instruction `place` of the function at `function`.
int line_at(lua_State* L, int function, int place) {
    if (!push_inspector(L, "funcinfo")) return 0;
    lua_pushvalue(L, function);
    lua_pushinteger(L, place);
    int line = 0;
    if (lua_pcall(L, 2, 1, 0) == 0 && lua_istable(L, -1)) {
        lua_getfield(L, -1, "currentline");
        line = index_of(lua_tointeger(L, -1));
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return line;
}

Fate find_fate(lua_State* L, int line, int base, const CallCodes& codes, int kept) {
    const int function = lua_gettop(L);
    if (!push_inspector(L, "funcbc")) return Fate::unknown;
    Fate fate = Fate::unknown;
    std::uint32_t word = 0;
    for (int place = 0; word_at(L, place, word); ++place) {
        const Instruction one = decoded(word);
        if (one.base != base || !calls(one, codes) || line_at(L, function, place) != line) continue;
        fate = joined(fate, fate_of(one, codes, kept));
    }
    lua_pop(L, 1);
    return fate;
}

Instruction instruction_in(lua_State* L, const char* chunk, std::size_t from_end) {
    Instruction found;
    if (luaL_loadstring(L, chunk) != 0 || !push_inspector(L, "funcbc")) {
        lua_pop(L, 1);
        return found;
    }
    int count = 0;
    std::uint32_t word = 0;
    while (word_at(L, count, word)) ++count;
    if (word_at(L, count - 1 - index_of(from_end), word)) found = decoded(word);
    lua_pop(L, 2);
    return found;
}

#endif

// The register that the function at `level` - 1 stands in, in the function at `level`.
int called_register(lua_State* L, lua_Debug& frame) {
    int count = 0;
    while (lua_getlocal(L, &frame, count + 1)) {
        lua_pop(L, 1);
        ++count;
    }
    return count;
}

// Registry key of a table from functions, held weakly, to tables of fates by place.
const char kFates = 0;

void push_fates(lua_State* L) {
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kFates);
    if (lua_istable(L, -1)) return;
    lua_pop(L, 1);
    lua_newtable(L);
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
    lua_pushvalue(L, -1);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kFates);
}

// Of the function on top of the stack, kept: a loop that fails often asks for one place.
Fate kept_fate(lua_State* L, int line, int base, const CallCodes& codes, int kept) {
    const int function = lua_gettop(L);
    push_fates(L);
    lua_pushvalue(L, function);
    lua_rawget(L, -2);
    if (!lua_istable(L, -1)) {
        lua_pop(L, 1);
        lua_newtable(L);
        lua_pushvalue(L, function);
        lua_pushvalue(L, -2);
        lua_rawset(L, -4);
    }
    const int place = (line * 256 + base) * 2 + kept;
    lua_rawgeti(L, -1, place);
    Fate fate = static_cast<Fate>(lua_tointeger(L, -1));
    if (lua_isnil(L, -1)) {
        lua_pushvalue(L, function);
        fate = find_fate(L, line, base, codes, kept);
        lua_pop(L, 1);
        lua_pushinteger(L, static_cast<lua_Integer>(fate));
        lua_rawseti(L, function + 2, place);
    }
    lua_settop(L, function);
    return fate;
}

}  // namespace

CallCodes find_call_codes(lua_State* L) {
    luaL_checkstack(L, LUA_MINSTACK, "cannot open lissom");
    CallCodes codes;
#if LUA_VERSION_NUM >= 504
    const Instruction plain = instruction_in(L, "local f f()", 1);
    const Instruction one = instruction_in(L, "local f local a = f()", 1);
    codes.tail = instruction_in(L, "local f return f()", 2).code;
    codes.call = codes.open_call = plain.code;
    codes.open_tail = codes.tail;
#else
    require_inspectors(L);
    const Instruction plain = instruction_in(L, "local f f()", 1);
    const Instruction one = instruction_in(L, "local f local a = f()", 1);
    codes.call = plain.code;
    codes.tail = instruction_in(L, "local f return f()", 0).code;
    codes.open_call = instruction_in(L, "local f f(f())", 1).code;
    codes.open_tail = instruction_in(L, "local f return f(f())", 0).code;
#endif
    codes.known = plain.code != 0 && plain.code == one.code && plain.base == 1 &&
                  plain.wanted == 0 && one.wanted == 1 && codes.tail != 0 &&
                  codes.tail != codes.call;
    return codes;
}

bool drops_results(lua_State* L, const CallCodes& codes) {
    return drops_results_after(0, L, codes);
}

bool drops_results_after(int kept, lua_State* L, const CallCodes& codes) {
    if (!codes.known) return false;
    luaL_checkstack(L, LUA_MINSTACK, "no room to find the caller");
    constexpr int kDeepest = 100;
    for (int level = 1; level < kDeepest; ++level) {
        lua_Debug frame;
        if (!lua_getstack(L, level, &frame)) return false;
        const int base = called_register(L, frame);
        lua_getinfo(L, "Slf", &frame);
        const bool is_lua = frame.what[0] != 'C' && frame.currentline > 0 && base < 256;
        const Fate fate =
            is_lua ? kept_fate(L, frame.currentline, base, codes, kept) : Fate::unknown;
        lua_pop(L, 1);
        if (fate != Fate::passed_on) return fate == Fate::dropped;
    }
    return false;
}

}  // namespace lissom::lua
