#include "bindings/lua/core/parse/value_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace lissom::lua {
namespace {

bool in_range(const Parameter& p, double value) {
    if (!p.infinite && !std::isfinite(value)) return false;
    if (std::isnan(value)) return false;
    return (p.above_min ? value > p.min : value >= p.min) && value <= p.max;
}

int first_item_type(lua_State* L, int index) {
    lua_rawgeti(L, index, 1);
    const int type = lua_type(L, -1);
    lua_pop(L, 1);
    return type;
}

}  // namespace

bool fits(lua_State* L, const Parameter& p, int index) {
    const int type = lua_type(L, index);
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
            return find_holder(L, index, p.type_name.c_str()) != nullptr;
        case Kind::function:
            return type == LUA_TFUNCTION;
        case Kind::strings:
            return type == LUA_TTABLE && first_item_type(L, index) == LUA_TSTRING;
        case Kind::points:
        case Kind::pixels:
        case Kind::id_lists:
        case Kind::objects:
            return type == LUA_TTABLE && first_item_type(L, index) != LUA_TNUMBER;
        default:
            return type == LUA_TTABLE;
    }
}

void ValueReader::require_type(int type, const Parameter& p, int index,
                               const ValuePlace& place) const {
    if (lua_type(L_, index) != type) refuse_value(call_, p, index, place);
}

void ValueReader::read(const Parameter& p, int index, Value& value, const ValuePlace& place) const {
    value.present = true;
    value.kind = p.kind;
    value.stack = index;
    switch (p.kind) {
        case Kind::boolean:
            require_type(LUA_TBOOLEAN, p, index, place);
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
            require_type(LUA_TLIGHTUSERDATA, p, index, place);
            value.data = lua_touserdata(L_, index);
            return;
        case Kind::function:
            require_type(LUA_TFUNCTION, p, index, place);
            return;
        case Kind::options:
        case Kind::option_map:
        case Kind::option_list:
        case Kind::table:
            require_type(LUA_TTABLE, p, index, place);
            return;
        case Kind::either:
            return read_alternative(p, index, value, place);
    }
}

double ValueReader::read_number(const Parameter& p, int index, const ValuePlace& place) const {
    require_type(LUA_TNUMBER, p, index, place);
    const double number = lua_tonumber(L_, index);
    if (!in_range(p, number)) refuse_value(call_, p, index, place);
    return number;
}

// An integer, or an id from 1.
int ValueReader::read_whole(const Parameter& p, int index, const ValuePlace& place) const {
    const double number = read_number(p, index, place);
    const bool is_id = p.kind != Kind::integer && p.kind != Kind::integers;
    const double lowest = is_id ? 1.0 : std::numeric_limits<int>::min();
    if (number != std::floor(number) || number < lowest ||
        number > std::numeric_limits<int>::max()) {
        refuse_value(call_, p, index, place);
    }
    return static_cast<int>(number);
}

// A string that ends at its first zero byte: the rest would be lost silently.
const char* ValueReader::read_string(const Parameter& p, int index, std::size_t& size,
                                     const ValuePlace& place) const {
    require_type(LUA_TSTRING, p, index, place);
    const char* text = lua_tolstring(L_, index, &size);
    if (std::strlen(text) < size)
        refuse(call_, place, "string without zero bytes", "one with them");
    return text;
}

void ValueReader::read_choice(const Parameter& p, int index, Value& value,
                              const ValuePlace& place) const {
    const char* given = read_string(p, index, value.size, place);
    const auto found = std::find(p.choices.begin(), p.choices.end(), given);
    if (found == p.choices.end()) refuse_value(call_, p, index, place);
    value.data = given;
    value.number = found - p.choices.begin();
}

Holder* ValueReader::read_object(const Parameter& p, int index, const ValuePlace& place) const {
    Holder* holder = find_holder(L_, index, p.type_name.c_str());
    if (!holder || !holder->object) refuse_value(call_, p, index, place);
    return holder;
}

void ValueReader::read_alternative(const Parameter& p, int index, Value& value,
                                   const ValuePlace& place) const {
    for (const Parameter& alternative : p.alternatives) {
        if (fits(L_, alternative, index)) return read(alternative, index, value, place);
    }
    refuse_value(call_, p, index, place);
}

}  // namespace lissom::lua
