#include "bindings/cli/repl/completion.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>

namespace lissom::cli {
namespace {

using lua::Entry;
using lua::Type;

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) {
        text.remove_suffix(1);
    }
    return text;
}

// Begin of the word that `text` ends with.
std::size_t word_begin(std::string_view text) {
    std::size_t at = text.size();
    while (at > 0 && is_word(text[at - 1])) --at;
    return at;
}

// The brackets that are open at the end of a text, and whether it ends in a string.
struct Open {
    std::vector<std::size_t> brackets;
    bool in_string = false;
};

Open open_at_end(std::string_view text) {
    Open open;
    char quote = '\0';
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != '\0') {
            if (c == '\\') ++i;
            if (c == quote || c == '\n') quote = '\0';
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '-' && text.substr(i, 2) == "--") {
            i = std::min(text.find('\n', i), text.size());
        } else if (std::strchr("({[", c)) {
            open.brackets.push_back(i);
        } else if (std::strchr(")}]", c) && !open.brackets.empty()) {
            open.brackets.pop_back();
        }
    }
    open.in_string = quote != '\0';
    return open;
}

// Returns the position of the opening bracket of the one that closes at the end of `text`.
std::optional<std::size_t> opening(std::string_view text) {
    const Open open = open_at_end(text.substr(0, text.size() - 1));
    if (open.in_string || open.brackets.empty()) return std::nullopt;
    return open.brackets.back();
}

// Looks names up without running anything.
class Lookup {
  public:
    explicit Lookup(lua_State* L) : L_(L), state_(*lua::find_state(L)) {}

    // Pushes the value of the path "a.b.c" at the end of `text`; false if it has none.
    bool push_path(std::string_view text) {
        text = trimmed(text);
        const std::size_t begin = word_begin(text);
        const std::string name(text.substr(begin));
        if (name.empty()) return false;
        const std::string_view before = trimmed(text.substr(0, begin));
        if (before.empty() || before.back() != '.') {
            lua_pushglobaltable(L_);
        } else if (!push_path(trimmed(before.substr(0, before.size() - 1)))) {
            return false;
        }
        if (!lua_istable(L_, -1)) {
            lua_pop(L_, 1);
            return false;
        }
        lua_pushlstring(L_, name.data(), name.size());
        lua_rawget(L_, -2);
        lua_remove(L_, -2);
        return true;
    }

    // The function that `text` ends with: "lissom.load", "mesh:save".
    const Entry* function_at_end(std::string_view text) {
        text = trimmed(text);
        const std::size_t begin = word_begin(text);
        const std::string_view before = trimmed(text.substr(0, begin));
        if (!before.empty() && before.back() == ':') {
            const Type* type = type_at_end(before.substr(0, before.size() - 1));
            return type ? method(*type, std::string(text.substr(begin))) : nullptr;
        }
        if (!push_path(text)) return nullptr;
        const Entry* entry = lua::find_entry(L_, -1);
        lua_pop(L_, 1);
        return entry;
    }

    // The type of the expression that `text` ends with: a variable, or the result of a call.
    const Type* type_at_end(std::string_view text) {
        text = trimmed(text);
        if (text.empty()) return nullptr;
        if (text.back() == ')' || text.back() == '}') {
            const auto begin = opening(text);
            const Entry* entry = begin ? function_at_end(text.substr(0, *begin)) : nullptr;
            return entry ? result_type(*entry) : nullptr;
        }
        if (!push_path(text)) return nullptr;
        const Type* type = lua::find_type(L_, -1);
        lua_pop(L_, 1);
        return type;
    }

  private:
    const Entry* method(const Type& type, const std::string& name) const {
        for (const auto& entry : state_.registry->entries()) {
            if (entry->type == &type && entry->function->name == name) return entry.get();
        }
        return nullptr;
    }

    const Type* result_type(const Entry& entry) const {
        const auto& results = entry.function->results;
        return results.empty() ? nullptr : state_.registry->find_type(results[0].type);
    }

    lua_State* L_;
    const lua::State& state_;
};

// Options that a key may name at the end of `text`, whose last open bracket is a brace: the
// function they belong to, and the prefix of their names ("sphere.").
struct OptionPlace {
    const Entry* entry = nullptr;
    std::string prefix;
};

OptionPlace option_place(Lookup& lookup, std::string_view text, std::vector<std::size_t> open) {
    std::string prefix;
    while (!open.empty() && text[open.back()] == '{') {
        std::string_view before = trimmed(text.substr(0, open.back()));
        open.pop_back();
        if (before.empty()) return {};
        if (before.back() == '=') {
            before = trimmed(before.substr(0, before.size() - 1));
            prefix = std::string(before.substr(word_begin(before))) + "." + prefix;
        } else if (before.back() == ',' || before.back() == '(') {
            if (open.empty() || text[open.back()] != '(') return {};
            return {lookup.function_at_end(text.substr(0, open.back())), prefix};
        } else {
            return {lookup.function_at_end(before), prefix};
        }
    }
    return {};
}

void add_options(const OptionPlace& place, std::vector<std::string>& words) {
    for (const Entry::Slot& slot : place.entry->slots) {
        const int index = index_of(&slot - place.entry->slots.data());
        if (index < place.entry->arguments) continue;
        const std::string& path = slot.path;
        if (path.compare(0, place.prefix.size(), place.prefix) != 0) continue;
        const std::string name = path.substr(place.prefix.size());
        if (name.find('.') == std::string::npos) words.push_back(name + " = ");
    }
}

// The string keys of the table on top of the stack.
void add_keys(lua_State* L, std::vector<std::string>& words) {
    for (lua_pushnil(L); lua_next(L, -2); lua_pop(L, 1)) {
        if (lua_type(L, -2) == LUA_TSTRING) words.emplace_back(lua_tostring(L, -2));
    }
}

void add_variables(lua_State* L, std::vector<std::string>& words) {
    lua_pushglobaltable(L);
    add_keys(L, words);
    lua_pop(L, 1);
    for (const char* word : {"and", "break",    "do",     "else", "elseif", "end",   "false",
                             "for", "function", "if",     "in",   "local",  "nil",   "not",
                             "or",  "repeat",   "return", "then", "true",   "until", "while"}) {
        words.emplace_back(word);
    }
}

void add_fields(lua_State* L, Lookup& lookup, std::string_view owner,
                std::vector<std::string>& words) {
    if (!lookup.push_path(owner)) return;
    if (lua_istable(L, -1)) add_keys(L, words);
    lua_pop(L, 1);
}

void add_methods(const Type& type, std::vector<std::string>& words) {
    words.emplace_back("close");
    for (const lua::Function& method : type.methods) words.push_back(method.name);
}

void keep_matching(std::string_view word, std::vector<std::string>& words) {
    std::erase_if(words, [&](const std::string& w) {
        return w.compare(0, word.size(), word.data(), word.size()) != 0;
    });
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
}

}  // namespace

Completions completions(lua_State* L, std::string_view text) {
    Completions result;
    result.begin = word_begin(text);
    const Open open = open_at_end(text);
    result.in_string = open.in_string;
    if (open.in_string || !lua_checkstack(L, LUA_MINSTACK)) return result;
    Lookup lookup(L);
    const std::string_view before = trimmed(text.substr(0, result.begin));
    const char last = before.empty() ? '\0' : before.back();
    if (last == ':') {
        const Type* type = lookup.type_at_end(before.substr(0, before.size() - 1));
        if (type) add_methods(*type, result.words);
    } else if (last == '.') {
        add_fields(L, lookup, before.substr(0, before.size() - 1), result.words);
    } else {
        OptionPlace place;
        if (last == '{' || last == ',') place = option_place(lookup, text, open.brackets);
        if (place.entry) add_options(place, result.words);
        if (result.words.empty()) add_variables(L, result.words);
    }
    keep_matching(text.substr(result.begin), result.words);
    return result;
}

}  // namespace lissom::cli
