#include "bindings/lua/core/parse/parser.h"

#include <algorithm>
#include <string>
#include <variant>

#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/core/parse/message.h"

namespace lissom::lua {

void Parser::run() {
    const int slots = count_of(entry_.slots);
    luaL_checkstack(L_, LUA_MINSTACK + 3 * slots, "too many arguments");
    for (int i = 0; i < slots; ++i) call_.values_[i] = Value{};
    const int given = lua_gettop(L_);
    int index = 1;
    if (entry_.type) {
        check_self();
        index = 2;
    }
    for (int slot = 0; slot < entry_.arguments; ++slot) index = read_argument(slot, index, given);
    read_options(index, given);
    if (entry_.function->named_arguments) require_arguments();
}

void Parser::check_self() {
    const char* name = entry_.type->name.c_str();
    const Holder* holder = find_holder(L_, 1, name);
    if (holder && holder->object) return;
    const char* got = push_description(L_, 1, name);
    const int type = lua_type(L_, 1);
    if (type == LUA_TUSERDATA || type == LUA_TNIL) refuse(call_, {1, "", 0}, name, got);
    char hinted[kTextSize];
    compose_text(hinted, [&] {
        const std::string object = variable_name(*entry_.type);
        return std::string(got) + "; write " + object + ":" + call_.name_ + ", not " + object +
               "." + call_.name_;
    });
    refuse(call_, {1, "", 0}, name, hinted);
}

// Returns the index of the argument after this one.
int Parser::read_argument(int slot, int index, int given) {
    const Parameter& p = *entry_.slots[slot].parameter;
    Value& value = call_.values_[slot];
    const ValuePlace place{index - (entry_.type ? 1 : 0), p.name.c_str(), 0};
    // What lies above the last argument are lists that were read before.
    const bool none = index > given;
    if (none || lua_isnil(L_, index)) {
        const bool refused = p.required && !entry_.function->named_arguments;
        if (refused && none) refuse_none(call_, p, place);
        if (refused) refuse_value(call_, p, index, place);
        fill_default(p, value);
        return index + 1;
    }
    if (is_left_out(p, index, given)) {
        fill_default(p, value);
        return index;
    }
    by_position_ = slot + 1;
    if (p.kind != Kind::vector || lua_type(L_, index) != LUA_TNUMBER) {
        values_.read(p, index, value, place);
        return index + 1;
    }
    value.present = true;
    value.kind = Kind::vector;
    for (int k = 0; k < 3; ++k) {
        const ValuePlace coordinate{place.argument + k, place.path, 0};
        value.xyz[k] = values_.read_coordinate(p, index + k, coordinate);
    }
    return index + 3;
}

// Returns whether the option table stands in the place of the argument `p`.
bool Parser::is_left_out(const Parameter& p, int index, int given) const {
    const bool named = entry_.function->named_arguments;
    return index == given && (named || !p.required) && is_option_table(p, index);
}

// Returns whether a table is the option table and not an argument. Lists are arguments.
bool Parser::is_option_table(const Parameter& p, int index) const {
    const bool named = entry_.function->named_arguments;
    if (lua_type(L_, index) != LUA_TTABLE) return false;
    if (!named && entry_.options_last == entry_.options_first) return false;
    return !fits(L_, p, index) || (named && raw_length(L_, index) == 0);
}

// Arguments without a default that were given neither by position nor by name are errors.
void Parser::require_arguments() {
    for (int slot = 0; slot < entry_.arguments; ++slot) {
        const Parameter& p = *entry_.slots[slot].parameter;
        if (!p.required || call_.values_[slot].present) continue;
        char text[kTextSize];
        compose_text(text, [&] {
            return "missing argument '" + p.name + "' of '" + call_.name_ + "' (" + expectation(p) +
                   " expected)";
        });
        call_.raise(text);
    }
}

void Parser::fill_default(const Parameter& p, Value& value) {
    value.present = !std::holds_alternative<std::monostate>(p.default_value);
    value.kind = p.kind;
    if (const auto* flag = std::get_if<bool>(&p.default_value)) value.number = *flag ? 1.0 : 0.0;
    if (const auto* number = std::get_if<double>(&p.default_value)) {
        value.number = *number;
        if (p.kind == Kind::either) value.kind = Kind::number;
        for (double& coordinate : value.xyz) coordinate = *number;
    }
    if (const auto* text = std::get_if<std::string>(&p.default_value)) {
        value.data = text->c_str();
        value.size = text->size();
        const auto found = std::find(p.choices.begin(), p.choices.end(), *text);
        value.number = found - p.choices.begin();
        if (p.kind == Kind::axis) set_axis(text->c_str(), value);
    }
}

void Parser::fill_defaults(int first, int last) {
    for (int slot = first; slot < last; ++slot) {
        const Parameter& p = *entry_.slots[slot].parameter;
        if (p.required) refuse_missing(call_, p, {0, entry_.slots[slot].path.c_str(), 0});
        fill_default(p, call_.values_[slot]);
    }
}

}  // namespace lissom::lua
