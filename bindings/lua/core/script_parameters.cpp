#include "bindings/lua/core/script_parameters.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <tuple>
#include <utility>

#include "bindings/lua/core/file_path.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/core/state.h"
#include "kernel/core/error.h"
#include "kernel/core/nearest.h"
#include "kernel/io/stream/file.h"

namespace lissom::lua {
namespace {

std::string value_text(const ParameterValue& value) {
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&value)) return plain_number(*number);
    return std::get<std::string>(value);
}

std::string with_dashes(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

std::string with_underscores(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

bool is_numeric(ParameterType type) {
    return type == ParameterType::number || type == ParameterType::integer;
}

std::optional<bool> truth(const std::string& text) {
    for (const char* word : {"true", "yes", "on", "1"}) {
        if (text == word) return true;
    }
    for (const char* word : {"false", "no", "off", "0"}) {
        if (text == word) return false;
    }
    return std::nullopt;
}

// Beyond, a double does not tell an integer from the next, nor is each a long long.
constexpr double kLargestInteger = 9007199254740992.0;

bool is_exact_integer(double value) {
    return value == std::floor(value) && std::abs(value) <= kLargestInteger;
}

[[noreturn]] void refuse(const ScriptParameter& p, const std::string& given) {
    std::string hint;
    const bool is_too_long = p.type == ParameterType::integer &&
                             std::abs(std::strtod(given.c_str(), nullptr)) > kLargestInteger;
    const std::string limit = is_too_long ? " of at most 16 digits" : "";
    const std::vector<std::string_view> choices(p.choices.begin(), p.choices.end());
    const std::string_view nearest = nearest_name(given, choices);
    if (!nearest.empty()) hint = ", did you mean '" + std::string(nearest) + "'?";
    throw ParameterError("parameter '" + p.name + "': " + p.accepted() + limit +
                         " expected, got '" + given + "'" + hint);
}

// A flag of a command line: --name, --name=value.
struct Flag {
    std::string name;
    std::optional<std::string> value;

    explicit Flag(const std::string& word) {
        const std::size_t equals = word.find('=');
        const std::size_t dashes = std::min(word.find_first_not_of('-'), word.size());
        name = with_underscores(word.substr(0, equals).substr(dashes));
        if (equals != std::string::npos) value = word.substr(equals + 1);
    }
};

}  // namespace

std::string_view type_name(ParameterType type) {
    constexpr std::array<std::string_view, 12> names{"number", "integer",  "boolean", "string",
                                                     "choice", "file",     "folder",  "mesh",
                                                     "region", "boundary", "curve",   "head"};
    return names[static_cast<std::size_t>(type)];
}

bool lies_on_mesh(ParameterType type) {
    return type == ParameterType::region || type == ParameterType::boundary ||
           type == ParameterType::curve;
}

std::string ScriptParameter::accepted() const {
    if (type == ParameterType::boolean) return "true or false";
    if (type == ParameterType::choice) {
        std::string text;
        for (std::size_t i = 0; i < choices.size(); ++i) {
            if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
            text += choices[i];
        }
        return text;
    }
    std::string text(type_name(type));
    if (!is_numeric(type)) return text;
    if (std::isfinite(min) && std::isfinite(max)) {
        return text + " from " + plain_number(min) + " to " + plain_number(max);
    }
    if (std::isfinite(min)) return text + " of at least " + plain_number(min);
    if (std::isfinite(max)) return text + " of at most " + plain_number(max);
    return text;
}

ParameterValue ScriptParameter::from_text(const std::string& text) const {
    ParameterValue converted = text;
    if (is_numeric(type)) {
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        if (text.empty() || *end != '\0') refuse(*this, text);
        converted = number;
    } else if (type == ParameterType::boolean) {
        const std::optional<bool> flag = truth(text);
        if (!flag) refuse(*this, text);
        converted = *flag;
    }
    check(converted);
    return converted;
}

void ScriptParameter::check(const ParameterValue& given) const {
    bool fits = std::holds_alternative<std::string>(given);
    if (type == ParameterType::boolean) {
        fits = std::holds_alternative<bool>(given);
    } else if (is_numeric(type)) {
        const auto* number = std::get_if<double>(&given);
        fits = number && std::isfinite(*number) && *number >= min && *number <= max &&
               (type == ParameterType::number || is_exact_integer(*number));
    } else if (type == ParameterType::choice && fits) {
        fits = std::find(choices.begin(), choices.end(), std::get<std::string>(given)) !=
               choices.end();
    }
    if (!fits) refuse(*this, value_text(given));
}

void ScriptParameter::make_folder(const State& state) const {
    if (type != ParameterType::folder || !value) return;
    const std::string& name_of_folder = std::get<std::string>(*value);
    try {
        const std::filesystem::path path = file_path(name_of_folder);
        if (state.host.check_file) state.host.check_file(path, FileUse::write);
        lissom::make_folder(path);
    } catch (const Error& error) {
        throw ParameterError("parameter '" + name + "': " + error.message());
    }
}

bool is_flag(const std::string& word) {
    const std::size_t dashes = word.starts_with("--") ? 2 : 1;
    return word.size() > dashes && word[0] == '-' &&
           (dashes == 2 || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

std::string first_flag(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        if (word == "--") break;
        if (is_flag(word)) return word;
    }
    return "";
}

bool asks_for_help(const std::vector<std::string>& words) {
    const auto end = std::find(words.begin(), words.end(), "--");
    return std::any_of(words.begin(), end,
                       [](const std::string& word) { return word == "--help" || word == "-h"; });
}

namespace {

// Says to which verb an option belongs; "" for other names.
std::string verb_option_text(const std::string& name, const std::string& shown) {
    constexpr std::pair<std::string_view, std::string_view> kOptions[] = {
        {"size", "view"},   {"speed", "view"},     {"up", "view"},    {"unit", "view"},
        {"weld", "view"},   {"no_repair", "view"}, {"tell", "view"},  {"keep_unused", "view"},
        {"sandbox", "run"}, {"seconds", "run"},    {"memory", "run"}, {"output", "run"},
        {"read", "run"},    {"write", "run"}};
    for (const auto& [option, verb] : kOptions) {
        if (name != option) continue;
        return "; as an option of lissom " + std::string(verb) + " " + shown +
               " belongs before the script's name";
    }
    return "";
}

}  // namespace

std::string unknown_flag_text(const std::string& flag, const std::vector<std::string_view>& names) {
    const std::string name = Flag(flag).name, shown = flag.substr(0, flag.find('='));
    std::string text = "no parameter '" + shown + "'";
    for (const char* option : {"debug", "json", "threads"}) {
        if (name == option) return text + "; " + shown + " belongs before the script's name";
    }
    const std::string verb = verb_option_text(name, shown);
    if (names.empty()) return text + ": the script declares none" + verb;
    const std::string_view nearest = nearest_name(name, names);
    if (!nearest.empty()) {
        return text + ", did you mean '--" + with_dashes(std::string(nearest)) + "'?";
    }
    text += "; there is: ";
    for (const std::string_view& one : names) {
        text += (&one == names.data() ? "--" : ", --") + with_dashes(std::string(one));
    }
    return text + verb;
}

std::string stray_word_text(const std::string& word) {
    return "'" + word +
           "' is no flag and follows none that takes a value; the script looks at no "
           "other words";
}

namespace {
const char kReadsWords = 0;
}

void set_reads_words(lua_State* L, bool reads) {
    lua_pushboolean(L, reads ? 1 : 0);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kReadsWords);
}

bool reads_words(lua_State* L) {
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kReadsWords);
    const bool reads = lua_isnil(L, -1) || lua_toboolean(L, -1) != 0;
    lua_pop(L, 1);
    return reads;
}

ScriptParameter* ParameterSet::find(std::string_view name) {
    for (ScriptParameter& p : list) {
        if (p.name == name) return &p;
    }
    return nullptr;
}

std::vector<std::string_view> ParameterSet::names() const {
    std::vector<std::string_view> all;
    for (const ScriptParameter& p : list) all.push_back(p.name);
    return all;
}

std::size_t ParameterSet::memory_bytes() const {
    std::size_t bytes = 0;
    const auto add = [&](const std::optional<ParameterValue>& value) {
        const auto* text = value ? std::get_if<std::string>(&*value) : nullptr;
        if (text) bytes += text->size();
    };
    for (const ScriptParameter& p : list) {
        bytes +=
            sizeof p + p.name.size() + p.unit.size() + p.group.size() + p.help.size() + p.of.size();
        for (const std::string& choice : p.choices) bytes += sizeof choice + choice.size();
        add(p.default_value);
        add(p.value);
    }
    return bytes;
}

void ParameterSet::sort() {
    std::sort(list.begin(), list.end(), [](const ScriptParameter& a, const ScriptParameter& b) {
        return std::tie(a.group, a.name) < std::tie(b.group, b.name);
    });
}

std::vector<std::string> ParameterSet::take(const std::vector<std::string>& words) {
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--") {
            rest.insert(rest.end(), words.begin() + i + 1, words.end());
            break;
        }
        if (!is_flag(words[i])) {
            rest.push_back(words[i]);
            continue;
        }
        Flag flag(words[i]);
        ScriptParameter* p = words[i].starts_with("--") ? find(flag.name) : nullptr;
        if (!p && flag.name.compare(0, 3, "no_") == 0 && !flag.value) {
            p = find(flag.name.substr(3));
            if (p && p->type == ParameterType::boolean) flag.value = "false";
        }
        if (!p) throw ParameterError(unknown_flag_text(words[i], names()));
        if (!flag.value && p->type == ParameterType::boolean) {
            const bool value_follows = i + 1 < words.size() && truth(words[i + 1]);
            flag.value = value_follows ? words[++i] : "true";
        }
        if (!flag.value) {
            if (i + 1 == words.size()) throw ParameterError("a value must follow " + words[i]);
            flag.value = words[++i];
        }
        p->value = p->from_text(*flag.value);
    }
    return rest;
}

void ParameterSet::require_values() const {
    for (const ScriptParameter& p : list) {
        if (p.value) continue;
        throw ParameterError("parameter '" + p.name + "' needs a value: --" + with_dashes(p.name) +
                             " (" + p.accepted() + ")");
    }
}

namespace {

std::string flag_text(const ScriptParameter& p) {
    const std::string flag = "--" + with_dashes(p.name);
    return p.type == ParameterType::boolean ? flag : flag + " " + std::string(type_name(p.type));
}

std::string help_line(const ScriptParameter& p) {
    std::string text = p.help;
    const std::string accepted = p.accepted();
    if (accepted != type_name(p.type)) text += (text.empty() ? "" : "; ") + accepted;
    if (!p.unit.empty()) text += (text.empty() ? "in " : ", in ") + p.unit;
    if (!text.empty()) text += " ";
    if (!p.default_value) return text + "(required)";
    const std::string standard = value_text(*p.default_value);
    return text + "(default: " + (standard.empty() ? "empty" : standard) + ")";
}

}  // namespace

std::string ParameterSet::help_text(const std::string& script) const {
    std::string text = "Usage: lissom run " + script + " [--name value ...]\n";
    std::size_t width = 0;
    for (const ScriptParameter& p : list) width = std::max(width, flag_text(p).size());
    const std::string* group = nullptr;
    for (const ScriptParameter& p : list) {
        if (!group || *group != p.group) {
            text += "\n" + (p.group.empty() ? std::string("Parameters") : p.group) + ":\n";
        }
        group = &p.group;
        const std::string flag = flag_text(p);
        text += "  " + flag + std::string(width - flag.size() + 2, ' ') + help_line(p) + "\n";
    }
    return text;
}

}  // namespace lissom::lua
