#include "bindings/lua/core/parser.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <variant>

#include "bindings/lua/core/old_names.h"
#include "bindings/lua/core/registry.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

constexpr int kTextSize = 1024;

// Runs `compose`, which returns a std::string, and copies the result: no C++ object is left alive
// when a Lua error follows.
template <typename Compose>
void compose_text(char (&text)[kTextSize], const Compose& compose) noexcept {
    try {
        std::snprintf(text, sizeof text, "%s", std::string(compose()).c_str());
    } catch (const std::exception&) {
        std::snprintf(text, sizeof text, "bad argument");
    }
}

std::string range_text(const Parameter& p) {
    const bool low = std::isfinite(p.min), high = std::isfinite(p.max);
    if (low && high && p.above_min) {
        return " above " + plain_number(p.min) + " and at most " + plain_number(p.max);
    }
    if (low && high) return " from " + plain_number(p.min) + " to " + plain_number(p.max);
    if (low && p.above_min) return " above " + plain_number(p.min);
    if (low) return " of at least " + plain_number(p.min);
    if (high) return " of at most " + plain_number(p.max);
    return "";
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
        text += words[i];
    }
    return text;
}

std::string quoted_choices(const Parameter& p) {
    std::vector<std::string> words;
    for (const std::string& c : p.choices) words.push_back('"' + c + '"');
    return listed(words);
}

std::string alternative_texts(const Parameter& p) {
    std::vector<std::string> words;
    for (const Parameter& alternative : p.alternatives) words.push_back(expectation(alternative));
    return listed(words);
}

bool in_range(const Parameter& p, double value) {
    if (!p.infinite && !std::isfinite(value)) return false;
    if (std::isnan(value)) return false;
    return (p.above_min ? value > p.min : value >= p.min) && value <= p.max;
}

// Pushes a description of the value at `index`, for messages. `expected_type` is the type of object
// wanted.
const char* push_description(lua_State* L, int index, const char* expected_type) {
    const int type = lua_type(L, index);
    if (type == LUA_TNUMBER) {
        char text[32];
        std::snprintf(text, sizeof text, "%.14g", lua_tonumber(L, index));
        lua_pushstring(L, text);
        return lua_tostring(L, -1);
    }
    if (type == LUA_TSTRING) return lua_pushfstring(L, "\"%s\"", lua_tostring(L, index));
    if (const Holder* holder = find_holder(L, index, nullptr)) {
        const bool is_expected = std::strcmp(holder->type_name, expected_type) == 0;
        return is_expected ? lua_pushfstring(L, "a closed %s", expected_type) : holder->type_name;
    }
    if (type != LUA_TUSERDATA || !luaL_getmetafield(L, index, "__name")) {
        return type == LUA_TNONE ? "no value" : lua_typename(L, type);
    }
    const char* name = lua_tostring(L, -1);
    // A name that was set on a foreign object is no name of it.
    const bool is_own = name && std::strcmp(name, expected_type) != 0;
    return is_own ? name : lua_typename(L, type);
}

std::vector<std::string_view> slot_names(const Entry& entry, int first, int last) {
    std::vector<std::string_view> names;
    for (int i = first; i < last; ++i) names.push_back(entry.slots[i].parameter->name);
    return names;
}

bool is_axis_name(const char* name) {
    if (name[0] == '-' || name[0] == '+') ++name;
    return name[0] >= 'x' && name[0] <= 'z' && name[1] == '\0';
}

// The unit vector of the axis called "x", "y" or "z", perhaps with a sign.
void set_axis(const char* name, Value& value) noexcept {
    const double sign = name[0] == '-' ? -1.0 : 1.0;
    if (name[0] == '-' || name[0] == '+') ++name;
    for (int k = 0; k < 3; ++k) value.xyz[k] = name[0] - 'x' == k ? sign : 0.0;
}

}  // namespace

std::string plain_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.14g", value);
    return text;
}

std::string expectation(const Parameter& p) {
    switch (p.kind) {
        case Kind::boolean:
            return "boolean";
        case Kind::integer:
            return "integer" + range_text(p);
        case Kind::number:
            return (p.infinite ? "number" : "finite number") + range_text(p);
        case Kind::string:
            return "string";
        case Kind::choice:
            return quoted_choices(p);
        case Kind::id:
            return "id from 1";
        case Kind::vector:
            return "{x, y, z}";
        case Kind::open_vector:
            return "{x, y, z} with nil or math.huge for an open side";
        case Kind::factors:
            return "number or {x, y, z}";
        case Kind::axis:
            return "\"x\", \"-y\", ... or {x, y, z} with a length";
        case Kind::affine:
            return "4 rows of 4 numbers, the last 0, 0, 0, 1";
        case Kind::matrix3:
            return "3 rows of 3 numbers";
        case Kind::address:
            return "lightuserdata";
        case Kind::ids:
            return "list of ids";
        case Kind::id_lists:
            return "list of lists of ids";
        case Kind::points:
            return "list of {x, y, z}";
        case Kind::pixels:
            return "list of {x, y}";
        case Kind::numbers:
            return "list of numbers";
        case Kind::integers:
            return "list of integers" + range_text(p);
        case Kind::strings:
            return "list of strings";
        case Kind::object:
            return p.type_name;
        case Kind::objects:
            return "list of " + p.type_name;
        case Kind::function:
            return "function";
        case Kind::options:
            return p.flag ? "table of options or true" : "table of options";
        case Kind::option_map:
            return "table of tables of options";
        case Kind::option_list:
            return "list of tables of options";
        case Kind::table:
            return "table";
        case Kind::either:
            return alternative_texts(p);
    }
    return "";
}

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
    if (type == LUA_TUSERDATA || type == LUA_TNIL) refuse({1, "", 0}, name, got);
    char hinted[kTextSize];
    compose_text(hinted, [&] {
        const std::string object = variable_name(*entry_.type);
        return std::string(got) + "; write " + object + ":" + call_.name_ + ", not " + object +
               "." + call_.name_;
    });
    refuse({1, "", 0}, name, hinted);
}

// Returns the index of the argument after this one.
int Parser::read_argument(int slot, int index, int given) {
    const Parameter& p = *entry_.slots[slot].parameter;
    Value& value = call_.values_[slot];
    const Place place{index - (entry_.type ? 1 : 0), p.name.c_str(), 0};
    if (index > given || lua_isnil(L_, index)) {
        if (p.required && !entry_.function->named_arguments) mismatch(p, index, place);
        fill_default(p, value);
        return index + 1;
    }
    if (is_left_out(p, index, given)) {
        fill_default(p, value);
        return index;
    }
    by_position_ = slot + 1;
    if (p.kind != Kind::vector || lua_type(L_, index) != LUA_TNUMBER) {
        read(p, index, value, place);
        return index + 1;
    }
    value.present = true;
    value.kind = Kind::vector;
    for (int k = 0; k < 3; ++k) {
        const Place coordinate{place.argument + k, place.path, 0};
        value.xyz[k] = read_coordinate(p, index + k, coordinate);
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
    return !fits(p, index) || (named && raw_length(L_, index) == 0);
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

void Parser::read_options(int index, int given) {
    const bool named = entry_.function->named_arguments;
    const bool takes_options = named || entry_.options_last > entry_.options_first;
    const bool has_options = takes_options && index <= given && !lua_isnil(L_, index);
    const int argument = index - (entry_.type ? 1 : 0);
    // The value in place of the options says more than the one after it.
    if (has_options && lua_type(L_, index) != LUA_TTABLE) {
        refuse({argument, "", 0}, "table of options", push_description(L_, index, ""));
    }
    if (entry_.function->more_arguments) return;
    for (int extra = takes_options ? index + 1 : index; extra <= given; ++extra) {
        if (lua_isnil(L_, extra)) continue;
        refuse({extra - (entry_.type ? 1 : 0), "", 0}, "no further argument",
               push_description(L_, extra, ""));
    }
    if (!takes_options) return;
    if (has_options && named) {
        read_named_table(index);
    } else if (has_options) {
        read_table(index, entry_.options_first, entry_.options_last);
    } else {
        fill_defaults(entry_.options_first, entry_.options_last);
    }
    if (entry_.function->one_option) require_one_option();
}

void Parser::read_table(int index, int first, int last) {
    lua_pushnil(L_);
    while (lua_next(L_, index)) {
        lua_pop(L_, 1);
        check_key(first, last);
    }
    read_fields(index, first, last);
}

// The option table of a function whose arguments may be given by name.
void Parser::read_named_table(int index) {
    const int first = entry_.options_first, last = entry_.options_last;
    lua_pushnil(L_);
    while (lua_next(L_, index)) {
        lua_pop(L_, 1);
        const char* key = lua_type(L_, -1) == LUA_TSTRING ? lua_tostring(L_, -1) : nullptr;
        if (!key || !knows_key(key, by_position_, entry_.arguments)) check_key(first, last);
    }
    read_fields(index, by_position_, entry_.arguments);
    read_fields(index, first, last);
}

void Parser::read_fields(int index, int first, int last) {
    for (int slot = first; slot < last; ++slot) {
        const Parameter& p = *entry_.slots[slot].parameter;
        lua_pushstring(L_, p.name.c_str());
        lua_rawget(L_, index);
        const Place place{0, entry_.slots[slot].path.c_str(), 0};
        Value& value = call_.values_[slot];
        if (lua_isnil(L_, -1)) {
            lua_pop(L_, 1);
            if (p.required) refuse_missing(p, place);
            fill_default(p, value);
        } else if (p.flag && lua_isboolean(L_, -1)) {
            value.present = lua_toboolean(L_, -1) != 0;
            value.kind = Kind::boolean;
            value.number = lua_toboolean(L_, -1);
            lua_pop(L_, 1);
            if (value.present) {
                fill_defaults(entry_.slots[slot].first, entry_.slots[slot].last);
            }
        } else if (p.kind == Kind::options) {
            if (lua_type(L_, -1) != LUA_TTABLE) mismatch(p, lua_gettop(L_), place);
            value.present = true;
            value.kind = Kind::options;
            read_table(lua_gettop(L_), entry_.slots[slot].first, entry_.slots[slot].last);
        } else {
            read(p, lua_gettop(L_), value, place);
        }
    }
}

void Parser::read_item(const Entry::Slot& slot, int table, const char* key) {
    drop_item(slot);
    const char* name = call_.name_;
    call_.name_ = lua_pushfstring(L_, "%s: %s", name, key);
    lua_pushstring(L_, key);
    lua_rawget(L_, table);
    read_top_item(slot, name, key);
}

void Parser::read_item(const Entry::Slot& slot, int table, int place) {
    drop_item(slot);
    const char* name = call_.name_;
    const char* key = lua_pushfstring(L_, "%s[%d]", slot.path.c_str(), place);
    call_.name_ = lua_pushfstring(L_, "%s: %s", name, key);
    lua_rawgeti(L_, table, place);
    read_top_item(slot, name, key);
}

// Drops all that the item before has pushed.
void Parser::drop_item(const Entry::Slot& slot) {
    if (call_.item_top_ == 0) call_.item_top_ = lua_gettop(L_);
    lua_settop(L_, call_.item_top_);
    luaL_checkstack(L_, LUA_MINSTACK + 3 * (slot.last - slot.first), "too many options");
}

// Reads the item on top of the stack; the call gets its own `name` back afterwards.
void Parser::read_top_item(const Entry::Slot& slot, const char* name, const char* key) {
    const int item = lua_gettop(L_);
    if (lua_type(L_, item) != LUA_TTABLE) {
        refuse({0, key, 0}, "table of options", push_description(L_, item, ""));
    }
    for (int i = slot.first; i < slot.last; ++i) call_.values_[i] = Value{};
    read_table(item, slot.first, slot.last);
    call_.name_ = name;
}

bool Parser::knows_key(const char* key, int first, int last) const {
    for (int slot = first; slot < last; ++slot) {
        if (entry_.slots[slot].parameter->name == key) return true;
    }
    return false;
}

namespace {

// Returns the name of the parameter among slots that `key` is called by elsewhere, or "".
std::string name_elsewhere(const Entry& entry, int first, int last, const std::string& key) {
    for (int slot = first; slot < last; ++slot) {
        const Parameter& p = *entry.slots[slot].parameter;
        const auto& names = p.other_names;
        if (std::find(names.begin(), names.end(), key) != names.end()) return p.name;
    }
    return "";
}

}  // namespace

// Looks at the key on top of the stack.
void Parser::check_key(int first, int last) {
    const char* key = lua_type(L_, -1) == LUA_TSTRING ? lua_tostring(L_, -1) : nullptr;
    if (key && knows_key(key, first, last)) return;
    refuse_key(key ? key : push_description(L_, lua_gettop(L_), ""), first, last);
}

void Parser::refuse_key(const char* key, int first, int last) {
    char text[kTextSize];
    compose_text(text, [&] {
        const std::string path = first < last ? entry_.slots[first].path : "";
        const std::string table = path.substr(0, path.rfind('.') + 1);
        const std::string unknown =
            "unknown option '" + table + key + "' of '" + std::string(call_.name_) + "'";
        const std::string old = old_name_hint(OldKind::option, call_.name_, key);
        if (!old.empty()) return unknown + old;
        auto names = slot_names(entry_, first, last);
        if (first == entry_.options_first && entry_.function->named_arguments) {
            const auto arguments = slot_names(entry_, by_position_, entry_.arguments);
            names.insert(names.begin(), arguments.begin(), arguments.end());
        }
        const std::string meant = name_elsewhere(entry_, first, last, key);
        return unknown + name_hint(meant.empty() ? key : meant.c_str(), names);
    });
    call_.raise(text);
}

void Parser::require_one_option() {
    int count = 0;
    for (int slot = 0; slot < entry_.options_last; ++slot) {
        const bool alternative = slot < entry_.arguments || slot >= entry_.options_first;
        if (alternative && call_.values_[slot].present) ++count;
    }
    if (count == 1) return;
    char text[kTextSize];
    compose_text(text, [&] {
        std::vector<std::string> names;
        for (const auto name : slot_names(entry_, entry_.options_first, entry_.options_last)) {
            names.emplace_back(name);
        }
        const std::string argument =
            entry_.arguments > 0 ? "a " + entry_.slots[0].path + " or " : "";
        return "'" + std::string(call_.name_) + "' needs " + argument +
               "exactly one of the options " + listed(names) + "; got " + std::to_string(count);
    });
    call_.raise(text);
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
        if (p.required) refuse_missing(p, {0, entry_.slots[slot].path.c_str(), 0});
        fill_default(p, call_.values_[slot]);
    }
}

void Parser::read(const Parameter& p, int index, Value& value, const Place& place) {
    value.present = true;
    value.kind = p.kind;
    value.stack = index;
    switch (p.kind) {
        case Kind::boolean:
            if (!lua_isboolean(L_, index)) mismatch(p, index, place);
            value.number = lua_toboolean(L_, index);
            return;
        case Kind::integer:
            value.number = read_whole(p, index, place);
            return;
        case Kind::id:
            value.number = read_whole(p, index, place) - 1;
            return;
        case Kind::number:
            value.number = read_number(p, index, place);
            return;
        case Kind::string:
            value.data = read_string(p, index, value.size, place);
            return;
        case Kind::choice:
            return read_choice(p, index, value, place);
        case Kind::vector:
            return read_vector(p, index, value.xyz, place);
        case Kind::open_vector:
            return read_open_vector(p, index, value.xyz, place);
        case Kind::factors:
            return read_factors(p, index, value, place);
        case Kind::axis:
            return read_axis(p, index, value, place);
        case Kind::affine:
        case Kind::matrix3:
            return read_matrix(p, index, value, place);
        case Kind::ids:
        case Kind::points:
        case Kind::pixels:
        case Kind::numbers:
        case Kind::integers:
        case Kind::strings:
        case Kind::objects:
            return read_list(p, index, value, place);
        case Kind::id_lists:
            return read_id_lists(p, index, value, place);
        case Kind::object:
            value.data = read_object(p, index, place);
            return;
        case Kind::address:
            if (lua_type(L_, index) != LUA_TLIGHTUSERDATA) mismatch(p, index, place);
            value.data = lua_touserdata(L_, index);
            return;
        case Kind::function:
            if (lua_type(L_, index) != LUA_TFUNCTION) mismatch(p, index, place);
            return;
        case Kind::options:
        case Kind::option_map:
        case Kind::option_list:
        case Kind::table:
            if (lua_type(L_, index) != LUA_TTABLE) mismatch(p, index, place);
            return;
        case Kind::either:
            return read_alternative(p, index, value, place);
    }
}

double Parser::read_number(const Parameter& p, int index, const Place& place) {
    if (lua_type(L_, index) != LUA_TNUMBER) mismatch(p, index, place);
    const double number = lua_tonumber(L_, index);
    if (!in_range(p, number)) mismatch(p, index, place);
    return number;
}

// An integer, or an id from 1.
int Parser::read_whole(const Parameter& p, int index, const Place& place) {
    const double number = read_number(p, index, place);
    const bool is_id = p.kind != Kind::integer && p.kind != Kind::integers;
    const double lowest = is_id ? 1.0 : std::numeric_limits<int>::min();
    if (number != std::floor(number) || number < lowest ||
        number > std::numeric_limits<int>::max()) {
        mismatch(p, index, place);
    }
    return static_cast<int>(number);
}

// A string that ends at its first zero byte: the rest would be lost silently.
const char* Parser::read_string(const Parameter& p, int index, std::size_t& size,
                                const Place& place) {
    if (lua_type(L_, index) != LUA_TSTRING) mismatch(p, index, place);
    const char* text = lua_tolstring(L_, index, &size);
    if (std::strlen(text) < size) refuse(place, "string without zero bytes", "one with them");
    return text;
}

void Parser::read_choice(const Parameter& p, int index, Value& value, const Place& place) {
    const char* given = read_string(p, index, value.size, place);
    const auto found = std::find(p.choices.begin(), p.choices.end(), given);
    if (found == p.choices.end()) mismatch(p, index, place);
    value.data = given;
    value.number = found - p.choices.begin();
}

Holder* Parser::read_object(const Parameter& p, int index, const Place& place) {
    Holder* holder = find_holder(L_, index, p.type_name.c_str());
    if (!holder || !holder->object) mismatch(p, index, place);
    return holder;
}

double Parser::read_coordinate(const Parameter& p, int index, const Place& place) {
    const double number = lua_tonumber(L_, index);
    const bool usable = p.infinite ? !std::isnan(number) : std::isfinite(number);
    if (lua_type(L_, index) != LUA_TNUMBER || !usable) mismatch(p, index, place);
    return number;
}

void Parser::read_open_vector(const Parameter& p, int index, double* xyz, const Place& place) {
    if (lua_type(L_, index) != LUA_TTABLE) mismatch(p, index, place);
    int keys = 0, given = 0;
    for (lua_pushnil(L_); lua_next(L_, index) != 0; lua_pop(L_, 1)) ++keys;
    for (int k = 0; k < 3; ++k) {
        lua_rawgeti(L_, index, k + 1);
        const bool is_number = lua_type(L_, -1) == LUA_TNUMBER;
        xyz[k] = is_number ? lua_tonumber(L_, -1) : std::numeric_limits<double>::quiet_NaN();
        given += is_number && !std::isnan(xyz[k]) ? 1 : 0;
        lua_pop(L_, 1);
    }
    // Wrong type, wrong place, or NaN.
    if (given != keys) mismatch(p, index, place);
}

void Parser::read_vector(const Parameter& p, int index, double* xyz, const Place& place) {
    if (lua_type(L_, index) != LUA_TTABLE || raw_length(L_, index) != 3) mismatch(p, index, place);
    for (int k = 0; k < 3; ++k) {
        lua_rawgeti(L_, index, k + 1);
        xyz[k] = read_coordinate(p, lua_gettop(L_), place);
        lua_pop(L_, 1);
    }
}

void Parser::read_factors(const Parameter& p, int index, Value& value, const Place& place) {
    if (lua_type(L_, index) != LUA_TNUMBER) return read_vector(p, index, value.xyz, place);
    const double factor = read_coordinate(p, index, place);
    value.xyz[0] = value.xyz[1] = value.xyz[2] = factor;
}

void Parser::read_axis(const Parameter& p, int index, Value& value, const Place& place) {
    if (lua_type(L_, index) != LUA_TSTRING) {
        read_vector(p, index, value.xyz, place);
        if (Vec3(value.xyz[0], value.xyz[1], value.xyz[2]).norm() == 0.0) mismatch(p, index, place);
        return;
    }
    std::size_t size = 0;
    const char* name = lua_tolstring(L_, index, &size);
    if (!is_axis_name(name) || std::strlen(name) != size) mismatch(p, index, place);
    set_axis(name, value);
}

// Reads rows into a row-major list of numbers.
void Parser::read_matrix(const Parameter& p, int index, Value& value, const Place& place) {
    const int columns = p.kind == Kind::affine ? 4 : 3;
    if (lua_type(L_, index) != LUA_TTABLE) mismatch(p, index, place);
    const int rows = index_of(raw_length(L_, index));
    if (rows != columns) mismatch(p, index, place);
    auto* entries = call_.scratch<double>(at(rows) * columns);
    for (int row = 0; row < rows; ++row) {
        lua_rawgeti(L_, index, row + 1);
        const int at = lua_gettop(L_);
        if (lua_type(L_, at) != LUA_TTABLE || index_of(raw_length(L_, at)) != columns) {
            mismatch(p, index, place);
        }
        for (int column = 0; column < columns; ++column) {
            lua_rawgeti(L_, at, column + 1);
            entries[row * columns + column] = read_coordinate(p, at + 1, place);
            lua_pop(L_, 1);
        }
        lua_pop(L_, 1);
    }
    const double last_row[4] = {0.0, 0.0, 0.0, 1.0};
    if (p.kind == Kind::affine && !std::equal(last_row, last_row + 4, entries + 12)) {
        mismatch(p, index, place);
    }
    value.data = entries;
}

void Parser::read_pair(const Parameter& p, int index, double* xy, const Place& place) {
    if (lua_type(L_, index) != LUA_TTABLE || raw_length(L_, index) != 2) {
        mismatch(p, index, place);
    }
    for (int k = 0; k < 2; ++k) {
        lua_rawgeti(L_, index, k + 1);
        xy[k] = read_coordinate(p, lua_gettop(L_), place);
        lua_pop(L_, 1);
    }
}

void Parser::read_list(const Parameter& p, int index, Value& value, const Place& place) {
    if (lua_type(L_, index) != LUA_TTABLE) mismatch(p, index, place);
    const std::size_t size = raw_length(L_, index);
    if (size > at(std::numeric_limits<Index>::max())) {
        refuse(place, "shorter list", "too many entries");
    }
    value.size = size;
    switch (p.kind) {
        case Kind::points: {
            auto* xyz = call_.scratch<double>(3 * size);
            for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
                read_vector(p, at, xyz + 3 * i, item);
            });
            value.data = xyz;
            return;
        }
        case Kind::pixels: {
            auto* pairs = call_.scratch<std::array<double, 2>>(size);
            for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
                read_pair(p, at, pairs[i].data(), item);
            });
            value.data = pairs;
            return;
        }
        case Kind::numbers: {
            auto* list = call_.scratch<double>(size);
            for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
                list[i] = read_number(p, at, item);
            });
            value.data = list;
            return;
        }
        case Kind::strings: {
            // The strings stay in the script's table, which stays on the stack.
            auto** list = call_.scratch<const char*>(size);
            for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
                std::size_t length = 0;
                list[i] = read_string(p, at, length, item);
            });
            value.data = list;
            return;
        }
        case Kind::objects: {
            auto** list = call_.scratch<Holder*>(size);
            for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
                list[i] = read_object(p, at, item);
            });
            value.data = list;
            return;
        }
        default: {
            auto* list = call_.scratch<Index>(size);
            const int shift = p.kind == Kind::ids ? 1 : 0;
            for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
                list[i] = read_whole(p, at, item) - shift;
            });
            value.data = list;
        }
    }
}

template <typename Read>
void Parser::for_each_item(int index, std::size_t size, const Place& place, const Read& read_item) {
    for (std::size_t i = 0; i < size; ++i) {
        lua_rawgeti(L_, index, index_of(i) + 1);
        read_item(lua_gettop(L_), i, Place{place.argument, place.path, index_of(i) + 1});
        lua_pop(L_, 1);
    }
}

void Parser::read_id_lists(const Parameter& p, int index, Value& value, const Place& place) {
    if (lua_type(L_, index) != LUA_TTABLE) mismatch(p, index, place);
    const std::size_t size = raw_length(L_, index);
    std::size_t total = 0;
    for_each_item(index, size, place, [&](int at, std::size_t, const Place& item) {
        if (lua_type(L_, at) != LUA_TTABLE) mismatch(p, at, item);
        total += raw_length(L_, at);
    });
    if (size + total > at(std::numeric_limits<Index>::max()) - 1) {
        refuse(place, "shorter list", "too many entries");
    }
    auto* offsets = call_.scratch<Index>(size + 1);
    auto* ids = call_.scratch<Index>(total);
    std::size_t filled = 0;
    offsets[0] = 0;
    for_each_item(index, size, place, [&](int at, std::size_t i, const Place& item) {
        const std::size_t length = raw_length(L_, at);
        for (std::size_t k = 0; k < length; ++k) {
            lua_rawgeti(L_, at, index_of(k) + 1);
            ids[filled++] = read_whole(p, lua_gettop(L_), item) - 1;
            lua_pop(L_, 1);
        }
        offsets[i + 1] = index_of(filled);
    });
    value.data = ids;
    value.offsets = offsets;
    value.size = size;
}

void Parser::read_alternative(const Parameter& p, int index, Value& value, const Place& place) {
    for (const Parameter& alternative : p.alternatives) {
        if (fits(alternative, index)) return read(alternative, index, value, place);
    }
    mismatch(p, index, place);
}

// Whether the value is of the Lua type that `p` wants; its contents are checked later.
bool Parser::fits(const Parameter& p, int index) const {
    const int type = lua_type(L_, index);
    switch (p.kind) {
        case Kind::boolean:
            return type == LUA_TBOOLEAN;
        case Kind::integer:
        case Kind::number:
        case Kind::id:
            return type == LUA_TNUMBER;
        case Kind::string:
        case Kind::choice:
            return type == LUA_TSTRING;
        case Kind::factors:
            return type == LUA_TNUMBER || type == LUA_TTABLE;
        case Kind::axis:
            return type == LUA_TSTRING || type == LUA_TTABLE;
        case Kind::object:
            return find_holder(L_, index, p.type_name.c_str()) != nullptr;
        case Kind::function:
            return type == LUA_TFUNCTION;
        case Kind::strings:
            return type == LUA_TTABLE && first_item_type(index) == LUA_TSTRING;
        case Kind::points:
        case Kind::pixels:
        case Kind::id_lists:
        case Kind::objects:
            return type == LUA_TTABLE && first_item_type(index) != LUA_TNUMBER;
        default:
            return type == LUA_TTABLE;
    }
}

int Parser::first_item_type(int index) const {
    lua_rawgeti(L_, index, 1);
    const int type = lua_type(L_, -1);
    lua_pop(L_, 1);
    return type;
}

void Parser::mismatch(const Parameter& p, int index, const Place& place) {
    char expected[kTextSize];
    compose_text(expected, [&] { return expectation(p); });
    const bool is_choice = p.kind == Kind::choice && lua_type(L_, index) == LUA_TSTRING;
    const char* got = push_description(L_, index, p.type_name.c_str());
    if (!is_choice) refuse(place, expected, got);
    char hinted[kTextSize];
    const char* given = lua_tostring(L_, index);
    compose_text(hinted, [&] {
        const std::vector<std::string_view> names(p.choices.begin(), p.choices.end());
        const std::string old =
            old_name_hint(OldKind::value, std::string(call_.name_) + "." + place.path, given);
        if (!old.empty()) return std::string(got) + old;
        const std::string_view nearest = nearest_name(given, names);
        return std::string(got) +
               (nearest.empty() ? "" : ", did you mean \"" + std::string(nearest) + "\"?");
    });
    refuse(place, expected, hinted);
}

void Parser::refuse_missing(const Parameter& p, const Place& place) {
    char text[kTextSize];
    compose_text(text, [&] {
        return "missing option '" + std::string(place.path) + "' of '" + call_.name_ + "' (" +
               expectation(p) + ")";
    });
    call_.raise(text);
}

void Parser::refuse(const Place& place, const char* expected, const char* got) {
    char text[kTextSize];
    compose_text(text, [&] {
        const std::string where = place.argument > 0
                                      ? "bad argument #" + std::to_string(place.argument) + " to '"
                                      : "bad option '" + std::string(place.path) + "' of '";
        const std::string item = place.item > 0 ? " at [" + std::to_string(place.item) + "]" : "";
        return where + call_.name_ + "' (" + expected + " expected" + item + ", got " + got + ")";
    });
    call_.raise(text);
}

}  // namespace lissom::lua
