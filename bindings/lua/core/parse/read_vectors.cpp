// Readers of vectors, axes and matrices.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "bindings/lua/core/parse/value_reader.h"

namespace lissom::lua {
namespace {

bool is_axis_name(const char* name) {
    if (name[0] == '-' || name[0] == '+') ++name;
    return name[0] >= 'x' && name[0] <= 'z' && name[1] == '\0';
}

}  // namespace

void set_axis(const char* name, Value& value) noexcept {
    const double sign = name[0] == '-' ? -1.0 : 1.0;
    if (name[0] == '-' || name[0] == '+') ++name;
    for (int k = 0; k < 3; ++k) value.xyz[k] = name[0] - 'x' == k ? sign : 0.0;
}

double ValueReader::read_coordinate(const Parameter& p, int index, const ValuePlace& place) const {
    const double number = lua_tonumber(L_, index);
    const bool usable = p.infinite ? !std::isnan(number) : std::isfinite(number);
    if (lua_type(L_, index) != LUA_TNUMBER || !usable) refuse_value(call_, p, index, place);
    return number;
}

void ValueReader::read_open_vector(const Parameter& p, int index, double* xyz,
                                   const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TTABLE) refuse_value(call_, p, index, place);
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
    if (given != keys) refuse_value(call_, p, index, place);
}

void ValueReader::read_vector(const Parameter& p, int index, double* xyz,
                              const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TTABLE || raw_length(L_, index) != 3)
        refuse_value(call_, p, index, place);
    for (int k = 0; k < 3; ++k) {
        lua_rawgeti(L_, index, k + 1);
        xyz[k] = read_coordinate(p, lua_gettop(L_), place);
        lua_pop(L_, 1);
    }
}

void ValueReader::read_pair(const Parameter& p, int index, double* xy,
                            const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TTABLE || raw_length(L_, index) != 2) {
        refuse_value(call_, p, index, place);
    }
    for (int k = 0; k < 2; ++k) {
        lua_rawgeti(L_, index, k + 1);
        xy[k] = read_coordinate(p, lua_gettop(L_), place);
        lua_pop(L_, 1);
    }
}

void ValueReader::read_factors(const Parameter& p, int index, Value& value,
                               const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TNUMBER) return read_vector(p, index, value.xyz, place);
    const double factor = read_coordinate(p, index, place);
    value.xyz[0] = value.xyz[1] = value.xyz[2] = factor;
}

void ValueReader::read_axis(const Parameter& p, int index, Value& value,
                            const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TSTRING) {
        read_vector(p, index, value.xyz, place);
        if (Vec3(value.xyz[0], value.xyz[1], value.xyz[2]).norm() == 0.0)
            refuse_value(call_, p, index, place);
        return;
    }
    std::size_t size = 0;
    const char* name = lua_tolstring(L_, index, &size);
    if (!is_axis_name(name) || std::strlen(name) != size) refuse_value(call_, p, index, place);
    set_axis(name, value);
}

void ValueReader::read_row(const Parameter& p, int index, int columns, double* row,
                           const ValuePlace& place) const {
    if (lua_type(L_, index) != LUA_TTABLE || index_of(raw_length(L_, index)) != columns) {
        refuse_value(call_, p, index, place);
    }
    for (int column = 0; column < columns; ++column) {
        lua_rawgeti(L_, index, column + 1);
        row[column] = read_coordinate(p, index + 1, place);
        lua_pop(L_, 1);
    }
}

// Reads rows into a row-major list of numbers.
void ValueReader::read_matrix(const Parameter& p, int index, Value& value,
                              const ValuePlace& place) const {
    const int columns = p.kind == Kind::affine ? 4 : 3;
    require_type(LUA_TTABLE, p, index, place);
    if (index_of(raw_length(L_, index)) != columns) refuse_value(call_, p, index, place);
    auto* entries = call_.scratch<double>(at(columns) * columns);
    for (int row = 0; row < columns; ++row) {
        lua_rawgeti(L_, index, row + 1);
        read_row(p, lua_gettop(L_), columns, entries + row * columns, place);
        lua_pop(L_, 1);
    }
    const double last_row[4] = {0.0, 0.0, 0.0, 1.0};
    if (p.kind == Kind::affine && !std::equal(last_row, last_row + 4, entries + 12)) {
        refuse_value(call_, p, index, place);
    }
    value.data = entries;
}

}  // namespace lissom::lua
