// lissom.params: the parameters of a script as an object.
#include <algorithm>
#include <cctype>
#include <cstring>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/core/script_parameters.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

// ---- lissom.params

// The keys of the table of declarations in alphabetical order.
std::span<const char*> declared_names(Call& call, int table) {
    lua_State* L = call.lua();
    std::size_t count = 0;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        if (lua_type(L, -1) != LUA_TSTRING) call.reject("declarations", "names as keys expected");
        ++count;
    }
    const char** names = call.scratch<const char*>(count);
    std::size_t i = 0;
    lua_pushnil(L);
    while (lua_next(L, table)) {
        lua_pop(L, 1);
        names[i++] = lua_tostring(L, -1);
    }
    std::sort(names, names + count,
              [](const char* a, const char* b) { return std::strcmp(a, b) < 0; });
    return {names, count};
}

[[noreturn]] void misdeclared(const std::string& name, const std::string& what) {
    throw Error(ErrorCode::invalid_argument, "parameter '" + name + "' " + what);
}

void check_name(const std::string& name, const std::vector<std::string_view>& reserved) {
    const auto is_word = [](char c) {
        return std::islower(static_cast<unsigned char>(c)) ||
               std::isdigit(static_cast<unsigned char>(c)) || c == '_';
    };
    if (name.empty() || !std::islower(static_cast<unsigned char>(name[0])) ||
        !std::all_of(name.begin(), name.end(), is_word)) {
        misdeclared(name, "needs a name of small letters, digits and _");
    }
    if (std::find(reserved.begin(), reserved.end(), name) != reserved.end()) {
        misdeclared(name, "has a name that is taken; choose another");
    }
}

std::optional<ParameterValue> given_default(const Call& call) {
    if (!call.has("declarations.default")) return std::nullopt;
    switch (call.kind("declarations.default")) {
        case Kind::boolean:
            return call.boolean("declarations.default");
        case Kind::number:
            return call.number("declarations.default");
        default:
            return std::string(call.string("declarations.default"));
    }
}

void take_text(const Call& call, const char* path, std::string& target) {
    if (call.has(path)) target = call.string(path);
}

void check_applicable(const Call& call, const ScriptParameter& p) {
    const bool numeric = p.type == ParameterType::number || p.type == ParameterType::integer;
    const bool limits = call.has("declarations.min") || call.has("declarations.max") ||
                        call.has("declarations.step");
    const std::string type(type_name(p.type));
    if (limits && !numeric) misdeclared(p.name, "of type " + type + " takes no min, max or step");
    if (p.choices.empty() == (p.type == ParameterType::choice)) {
        misdeclared(p.name, p.choices.empty() ? "of type choice needs choices"
                                              : "of type " + type + " takes no choices");
    }
    if (p.min > p.max) misdeclared(p.name, "has a min above its max");
    if (!p.of.empty() && !lies_on_mesh(p.type)) {
        misdeclared(p.name, "of type " + type + " takes no 'of'");
    }
}

// Whether each region, boundary and curve lies on a parameter that names a mesh.
void check_places(const std::vector<ScriptParameter>& list) {
    for (const ScriptParameter& p : list) {
        if (p.of.empty()) continue;
        const bool found = std::any_of(list.begin(), list.end(), [&](const ScriptParameter& other) {
            return other.name == p.of &&
                   (other.type == ParameterType::mesh || other.type == ParameterType::head ||
                    other.type == ParameterType::file);
        });
        if (!found) misdeclared(p.name, "is of '" + p.of + "', which names no mesh, head or file");
    }
}

// One declaration, whose fields the call has at hand.
ScriptParameter declared(const Call& call, const char* name) {
    ScriptParameter p;
    p.name = name;
    check_name(p.name, {"close", "schema", "help", "json"});
    p.type = call.choice<ParameterType>("declarations.type");
    p.default_value = given_default(call);
    if (call.has("declarations.min")) p.min = call.number("declarations.min");
    if (call.has("declarations.max")) p.max = call.number("declarations.max");
    if (call.has("declarations.step")) p.step = call.number("declarations.step");
    if (call.has("declarations.choices")) {
        const auto choices = call.strings("declarations.choices");
        p.choices.assign(choices.begin(), choices.end());
    }
    take_text(call, "declarations.unit", p.unit);
    take_text(call, "declarations.group", p.group);
    take_text(call, "declarations.help", p.help);
    take_text(call, "declarations.of", p.of);
    check_applicable(call, p);
    try {
        if (p.default_value) p.check(*p.default_value);
    } catch (const ParameterError& error) {
        throw Error(ErrorCode::invalid_argument, "the default of " + error.message);
    }
    p.value = p.default_value;
    return p;
}

// Takes values from the command line. A mistake there, or --help, ends the script (see ScriptEnd).
void take_arguments(State& state, ParameterSet& set, std::vector<std::string>& rest,
                    bool drops_rest) {
    const ScriptArguments& arguments = state.host.arguments;
    if (arguments.script.empty()) {
        set.require_values();
        for (const ScriptParameter& p : set.list) p.make_folder(state);
        return;
    }
    const auto& words = arguments.words;
    if (state.only_help) {
        state.script_end = ScriptEnd::help;
        throw ParameterError(set.help_text(arguments.script));
    }
    state.script_end = ScriptEnd::usage;
    rest = set.take(words);
    if (!rest.empty() && drops_rest) {
        throw ParameterError(stray_word_text(rest.front()));
    }
    set.require_values();
    for (const ScriptParameter& p : set.list) p.make_folder(state);
    state.script_end = ScriptEnd::none;
}

void take_command_line(State& state, ParameterSet& set, std::vector<std::string>& rest,
                       bool drops_rest) {
    try {
        take_arguments(state, set, rest, drops_rest);
    } catch (const ParameterError& error) {
        state.script_end_text = error.message;
        throw Error(ErrorCode::invalid_argument, error.message);
    }
}

int declare(Call& call) {
    State& state = call.state();
    const bool of_script = call.boolean("command_line");
    if (of_script && state.parameters && !state.host.arguments.script.empty()) {
        call.raise("the script's parameters are declared already: once, in one table");
    }
    const int table = call.stack_index("declarations");
    const bool drops_rest = !call.boolean("words") && !reads_words(call.lua());
    const auto names = declared_names(call, table);
    auto& list = call.hold<std::vector<ScriptParameter>>();
    for (const char* name : names) {
        call.select_item("declarations", name);
        const bool done = call.attempt_quick([&] { list.push_back(declared(call, name)); });
        if (!done) return call.fail();
    }
    auto& rest = call.hold<std::vector<std::string>>();
    const auto result = call.create<ParameterSet>();
    const bool done = call.attempt_quick([&] {
        check_places(list);
        auto set = std::make_shared<ParameterSet>();
        set->list = std::move(list);
        set->sort();
        result.set(set);
        if (!of_script) return set->require_values();
        state.parameters = set;
        take_command_line(state, *set, rest, drops_rest);
    });
    if (!done) return call.fail();
    call.charge(result);
    push_list(call, rest, [&](const std::string& name) { call.push(std::string_view(name)); });
    return 2;
}

// ---- The object

int push_value(const Call& call, const std::optional<ParameterValue>& value) {
    if (!value) {
        lua_pushnil(call.lua());
        return 1;
    }
    if (const auto* flag = std::get_if<bool>(&*value)) return call.push(*flag);
    if (const auto* text = std::get_if<std::string>(&*value))
        return call.push(std::string_view(*text));
    const double number = std::get<double>(*value);
    return call.push(number);
}

int push_typed_value(const Call& call, const ScriptParameter& p,
                     const std::optional<ParameterValue>& value) {
    if (p.type != ParameterType::integer || !value) return push_value(call, value);
    push_integer(call.lua(), static_cast<long long>(std::get<double>(*value)));
    return 1;
}

const char* key(Call& call) {
    return lua_type(call.lua(), 2) == LUA_TSTRING ? lua_tostring(call.lua(), 2) : "";
}

int get_value(Call& call) {
    const auto self = call.self<ParameterSet>();
    const char* name = key(call);
    const ScriptParameter* p = self->find(name);
    if (p) return push_typed_value(call, *p, p->value);
    if (std::strcmp(name, "schema") == 0 || std::strcmp(name, "close") == 0) return 0;
    call.attempt_quick([&] {
        throw Error(ErrorCode::invalid_argument, std::string("there is no parameter '") + name +
                                                     "'" + name_hint(name, self->names()));
    });
    return call.fail();
}

int set_value(Call& call) {
    const auto self = call.self<ParameterSet>();
    lua_State* L = call.lua();
    const char* name = key(call);
    const int type = lua_type(L, 3);
    if (type != LUA_TBOOLEAN && type != LUA_TNUMBER && type != LUA_TSTRING) {
        call.raise(lua_pushfstring(L, "parameter '%s' cannot be %s", name, luaL_typename(L, 3)));
    }
    std::size_t size = 0;
    const char* text = type == LUA_TSTRING ? lua_tolstring(L, 3, &size) : "";
    if (type == LUA_TSTRING && std::strlen(text) < size) {
        call.raise(lua_pushfstring(L, "parameter '%s' cannot be a string with zero bytes", name));
    }
    const bool flag = lua_toboolean(L, 3) != 0;
    const double number = type == LUA_TNUMBER ? lua_tonumber(L, 3) : 0.0;
    const bool done = call.attempt_quick([&] {
        ScriptParameter* p = self->find(name);
        ParameterValue value = std::string(text);
        if (type == LUA_TBOOLEAN) value = flag;
        if (type == LUA_TNUMBER) value = number;
        try {
            if (!p) {
                throw ParameterError(std::string("there is no parameter '") + name + "'" +
                                     name_hint(name, self->names()));
            }
            p->check(value);
            ScriptParameter changed = *p;
            changed.value = value;
            changed.make_folder(call.state());
            call.reserve(self, size);
            *p = std::move(changed);
        } catch (const ParameterError& error) {
            throw Error(ErrorCode::invalid_argument, error.message);
        }
    });
    if (!done) return call.fail();
    call.charge(self);
    return 0;
}

int parameter_count(Call& call) {
    return call.push(count_of(call.self<ParameterSet>()->list));
}

void push_parameter(const Call& call, const ScriptParameter& p) {
    lua_State* L = call.lua();
    lua_createtable(L, 0, 12);
    call.set_field("name", call.push(std::string_view(p.name)));
    call.set_field("type", call.push(type_name(p.type)));
    call.set_field("default", push_typed_value(call, p, p.default_value));
    call.set_field("value", push_typed_value(call, p, p.value));
    if (p.min > -std::numeric_limits<double>::infinity()) call.set_field("min", call.push(p.min));
    if (p.max < std::numeric_limits<double>::infinity()) call.set_field("max", call.push(p.max));
    if (p.step) call.set_field("step", call.push(*p.step));
    call.set_field("unit", call.push(std::string_view(p.unit)));
    call.set_field("group", call.push(std::string_view(p.group)));
    call.set_field("help", call.push(std::string_view(p.help)));
    if (!p.of.empty()) call.set_field("of", call.push(std::string_view(p.of)));
    if (p.choices.empty()) return;
    push_list(call, p.choices, [&](const std::string& name) { call.push(std::string_view(name)); });
    lua_setfield(L, -2, "choices");
}

int schema(Call& call) {
    const auto self = call.self<ParameterSet>();
    push_list(call, self->list, [&](const ScriptParameter& one) { push_parameter(call, one); });
    return 1;
}

int parameters_text(Call& call) {
    lua_pushfstring(call.lua(), "lissom.Params: %d", count_of(call.self<ParameterSet>()->list));
    return 1;
}

std::vector<Parameter> declaration_fields() {
    return {choice("type",
                   {"number", "integer", "boolean", "string", "choice", "file", "folder", "mesh",
                    "region", "boundary", "curve", "head"},
                   "Type of its values. A folder is one to write to: it is made, if it is "
                   "missing, when the parameters are declared or it is set. The last five are "
                   "texts for which a host shows a picker: the file or name of a mesh or a head, "
                   "the name of a region, the name or number of an open boundary or a curve."),
            either("default",
                   {boolean("flag", "For a boolean."), number("number", "For a number or integer."),
                    string("text", "For every other type.")},
                   "Its default; without one it must be given.")
                .optional("required"),
            number("min", "Smallest value of a number or integer.").optional("no limit"),
            number("max", "Greatest value.").optional("no limit"),
            number("step", "Step of a slider.").above(0).optional("any"),
            strings("choices", "The values of a choice.").optional(),
            string("unit", "Shown after the value.").optional("none"),
            string("group", "Heading that it stands under.").optional("none"),
            string("help", "Its help text, one line.").optional("none"),
            string("of",
                   "For a region, boundary or curve: the name of the parameter with the mesh or "
                   "head that it lies on.")
                .optional("none")};
}

}  // namespace

Type parameters_type() {
    Type type{.name = "lissom.Params",
              .summary =
                  "Values of a script's parameters: `params.length`. Values that are set are "
                  "checked as those of the command line."};
    type.is_heard = false;
    type.operators = {
        {"__index", get_value, "params.name", "the value of a parameter"},
        {"__newindex", set_value, "params.name = value", "sets it; an error if it does not fit"},
        {"__len", parameter_count, "#params", "number of parameters"},
        {"__tostring", parameters_text, "tostring(params)", "its size"}};
    type.methods = {
        {.name = "schema",
         .body = schema,
         .summary = "All declarations with their present values, ordered by group and name.",
         .results = {{"lissom.ParamSchema[]", "schema", "One table for each parameter."}},
         .example = R"(local params = lissom.params{ angle = { type = "number", default = 30 } }
assert(params:schema()[1].default == 30))"}};
    return type;
}

std::vector<Function> parameter_functions() {
    return {{.name = "params",
             .body = declare,
             .summary =
                 "Declares the parameters of the script, once, and returns their values. Under "
                 "`lissom run` they come from flags (--name value), and --help lists them.",
             .arguments = {option_map("declarations", declaration_fields(),
                                      "Description of the parameter by its name.")},
             .options = {boolean("command_line",
                                 "They are the script's. If not, they have their defaults, and may "
                                 "be declared any number of times: for tools.")
                             .defaults(true),
                         boolean("words",
                                 "The command line may have words that are no flags; else "
                                 "`lissom run` refuses them, unless the script reads `arg` or "
                                 "`...`.")
                             .defaults(false)},
             .results = {{"lissom.Params", "params", "Their values."},
                         {"string[]", "rest", "The words of the command line that are no flags."}},
             .errors = {ErrorCode::invalid_argument},
             .example = R"(local params = lissom.params{
    angle = { type = "number", default = 30, min = -180, max = 180, unit = "degrees" },
    style = { type = "choice", default = "soft", choices = { "soft", "crisp" } },
}
assert(params.angle == 30 and params.style == "soft"))"}};
}

}  // namespace lissom::lua
