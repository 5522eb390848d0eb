#include "bindings/cli/migrate/script_types.h"

#include <cctype>
#include <iterator>
#include <utility>

namespace lissom::cli {
namespace {

struct Made {
    std::string_view by, type;
};

constexpr std::string_view kDeformer = "lissom.Deformer", kHairstyle = "lissom.Hairstyle",
                           kScalp = "lissom.Scalp", kMerger = "lissom.Merger";

// Functions of the module and the types that they make, in version 0.1 and since.
constexpr Made kFunctions[] = {{"deform", kDeformer},     {"deformer", kDeformer},
                               {"hairstyle", kHairstyle}, {"load_style", kHairstyle},
                               {"scalp", kScalp},         {"merging", kMerger},
                               {"merger", kMerger}};

// Methods that return an object of one type.
constexpr Made kMethods[] = {{"scalp", kScalp}, {"hairstyle", kHairstyle}};

// Methods that return the object that they are called on.
constexpr std::string_view kSelves[] = {"constrain",    "stiffness", "reset",      "apply",
                                        "rebase",       "pin",       "save_basis", "avoid_scalp",
                                        "forget_scalp", "mask",      "clear_masks"};

// Names that scripts and documents use for objects of a type.
constexpr Made kCustoms[] = {
    {"edit", kDeformer},   {"deformation", kDeformer}, {"deformer", kDeformer},
    {"style", kHairstyle}, {"hairstyle", kHairstyle},  {"scalp", kScalp},
    {"merging", kMerger},  {"merger", kMerger},        {"view", "lissom.ToolView"}};

template <std::size_t N>
std::string made(const Made (&list)[N], std::string_view by) {
    for (const Made& one : list) {
        if (one.by == by) return std::string(one.type);
    }
    return "";
}

// "style" of "head_style2".
std::string_view custom_part(std::string_view name) {
    while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back())) != 0) {
        name.remove_suffix(1);
    }
    const std::size_t line = name.rfind('_');
    return line == std::string_view::npos ? name : name.substr(line + 1);
}

}  // namespace

ScriptTypes::ScriptTypes(const LuaTokens& tokens) : tokens_(tokens) {
    find_module_names();
    find_definitions();
    find_assignments();
}

// Names that hold the module: NAME = require "lissom".
void ScriptTypes::find_module_names() {
    for (std::size_t i = 2; i < tokens_.size(); ++i) {
        if (!tokens_.is(i, "require") || !tokens_.is(i - 1, "=")) continue;
        const std::size_t name = tokens_.is(i + 1, "(") ? i + 2 : i + 1;
        const std::string_view word = tokens_.text(name);
        if (word == "\"lissom\"" || word == "'lissom'") {
            modules_.emplace(tokens_.text(i - 2));
        }
    }
}

// function a.b:NAME(...), a.NAME = function, NAME = function in a table.
void ScriptTypes::find_definitions() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        if (!tokens_.is(i, "function")) continue;
        if (i >= 2 && tokens_.is(i - 1, "=")) defined_.emplace(tokens_.text(i - 2));
        std::size_t last = i + 1;
        while (tokens_.is(last + 1, ".") || tokens_.is(last + 1, ":")) last += 2;
        if (tokens_.is_name(last)) defined_.emplace(tokens_.text(last));
    }
}

void ScriptTypes::find_assignments() {
    for (std::size_t i = 1; i < tokens_.size(); ++i) {
        if (!tokens_.is(i, "=") || !tokens_.is_name(i - 1)) continue;
        // In a list of names the first value is the first name's.
        std::size_t name = i - 1;
        while (name >= 2 && tokens_.is(name - 1, ",") && tokens_.is_name(name - 2)) name -= 2;
        const std::string type = starting_at(i + 1);
        if (!type.empty()) types_[std::string(tokens_.text(name))].insert(type);
    }
}

bool ScriptTypes::is_function(std::size_t i) const {
    if (!tokens_.is(i + 1, ".") || !tokens_.is_name(i + 2)) return false;
    const bool whole = i == 0 || !(tokens_.is(i - 1, ".") || tokens_.is(i - 1, ":"));
    return whole && modules_.count(std::string(tokens_.text(i))) != 0;
}

// The type of the expression that begins with token `first`.
std::string ScriptTypes::starting_at(std::size_t first) const {
    if (tokens_.is(first, "assert") && tokens_.is(first + 1, "(")) first += 2;
    if (!tokens_.is_name(first)) return "";
    std::size_t last = first;
    for (std::size_t i = first + 1; i < tokens_.size();) {
        if ((tokens_.is(i, ".") || tokens_.is(i, ":")) && tokens_.is_name(i + 1)) {
            last = i + 1;
        } else if ((tokens_.is(i, "(") || tokens_.is(i, "{")) &&
                   tokens_.match(i) < tokens_.size()) {
            last = tokens_.match(i);
        } else if (tokens_.is_string(i)) {
            last = i;
        } else {
            break;
        }
        i = last + 1;
    }
    return tokens_.is_name(last) ? "" : ending_at(last);
}

std::string ScriptTypes::ending_at(std::size_t last) const {
    if (tokens_.is_name(last)) return of_name(tokens_.text(last));
    const bool is_call = tokens_.is(last, ")") || tokens_.is(last, "}");
    const std::size_t open = is_call ? tokens_.match(last) : last;
    const bool has_callee =
        (is_call || tokens_.is_string(last)) && open > 0 && open < tokens_.size();
    return has_callee && tokens_.is_name(open - 1) ? of_call(open - 1, open) : "";
}

std::string ScriptTypes::of_call(std::size_t callee, std::size_t open) const {
    if (callee >= 2 && is_function(callee - 2)) return made(kFunctions, tokens_.text(callee));
    if (callee < 2 || !tokens_.is(callee - 1, ":")) return "";
    const std::string_view method = tokens_.text(callee);
    const std::string type = made(kMethods, method);
    if (!type.empty()) return type;
    // scene:add(name, object) returns the object.
    if (method == "add" && tokens_.is(open, "(") && tokens_.is(open + 2, ",")) {
        return starting_at(open + 3);
    }
    for (const std::string_view self : kSelves) {
        if (method == self) return ending_at(callee - 2);
    }
    return "";
}

std::string ScriptTypes::of_name(std::string_view name) const {
    const auto found = types_.find(std::string(name));
    if (found == types_.end()) return made(kCustoms, custom_part(name));
    return found->second.size() == 1 ? *found->second.begin() : "";
}

std::size_t ScriptTypes::start_of(std::size_t last) const {
    std::size_t i = last;
    for (;;) {
        const bool closes = tokens_.is(i, ")") || tokens_.is(i, "}") || tokens_.is(i, "]");
        if (closes) {
            const std::size_t open = tokens_.match(i);
            if (open >= tokens_.size() || open == 0) return i;
            const bool follows = tokens_.is_name(open - 1) || tokens_.is_string(open - 1) ||
                                 tokens_.is(open - 1, ")") || tokens_.is(open - 1, "]") ||
                                 tokens_.is(open - 1, "}");
            if (!follows) return open;
            i = open - 1;
        } else if (tokens_.is_string(i) && i > 0 && tokens_.is_name(i - 1)) {
            i -= 1;
        } else if (i >= 2 && (tokens_.is(i - 1, ".") || tokens_.is(i - 1, ":"))) {
            i -= 2;
        } else {
            return i;
        }
    }
}

}  // namespace lissom::cli
