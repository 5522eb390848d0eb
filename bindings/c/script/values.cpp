// Values to Lua and back.
#include <algorithm>
#include <cmath>
#include <optional>

#include "bindings/c/script/host.h"

namespace lissom::c {
namespace {

// The handle that a table stands for.
std::optional<std::uint64_t> handle_in(const Fields& fields) {
    const auto name = std::find(fields.names.begin(), fields.names.end(), "object");
    if (name == fields.names.end()) return std::nullopt;
    const Value& value = fields.values[at(name - fields.names.begin())];
    const auto* id = std::get_if<std::int64_t>(&value.content);
    if (!id || *id < 0) return std::nullopt;
    return static_cast<std::uint64_t>(*id);
}

void visit_handles(const Value& value, FunctionRef<void(std::uint64_t)> visit) {
    if (const auto* list = std::get_if<List>(&value.content)) {
        for (const Value& item : *list) visit_handles(item, visit);
    } else if (const auto* fields = std::get_if<Fields>(&value.content)) {
        if (const auto id = handle_in(*fields)) return visit(*id);
        for (const Value& item : fields->values) visit_handles(item, visit);
    }
}

[[noreturn]] void refuse_result(const std::string& why) {
    throw Error(ErrorCode::invalid_argument, why);
}

}  // namespace

void ScriptHost::check_values(const List& values) {
    holders_.clear();
    references_.clear();
    for (const Value& value : values) {
        visit_handles(value, [&](std::uint64_t id) {
            if (!context_.objects.find(id, Kind::object)) {
                holders_.insert_or_assign(id, holder_of(id));
            } else {
                references_[id] = context_.share<LuaReference>(id, Kind::object)->reference;
            }
        });
    }
}

void ScriptHost::push_object(std::uint64_t id) {
    const auto found = holders_.find(id);
    if (found == holders_.end()) {
        lua_rawgeti(L_, LUA_REGISTRYINDEX, references_.at(id));
        return;
    }
    // One userdata an object, so that scripts can compare them.
    const void* content = found->second.object.get();
    lua::raw_get_pointer(L_, LUA_REGISTRYINDEX, lua::State::object_table_key());
    lua::raw_get_pointer(L_, -1, content);
    const lua::Holder* known = lua::find_holder(L_, -1, nullptr);
    if (known && known->object.get() == content) {
        lua_remove(L_, -2);
        return;
    }
    lua_pop(L_, 1);
    lua::Holder* made = lua::push_holder(L_, binding(), found->second.type_name, 0);
    made->object = found->second.object;
    lua_pushvalue(L_, -1);
    lua::raw_set_pointer(L_, -3, content);
    lua_remove(L_, -2);
}

namespace {

// Pushes what holds no other values; false for lists and tables.
bool push_scalar(lua_State* L, const Value& value) {
    if (const auto* flag = std::get_if<bool>(&value.content)) {
        lua_pushboolean(L, *flag);
    } else if (const auto* integer = std::get_if<std::int64_t>(&value.content)) {
        lua_pushinteger(L, *integer);
    } else if (const auto* number = std::get_if<double>(&value.content)) {
        lua_pushnumber(L, *number);
    } else if (const auto* text = std::get_if<std::string>(&value.content)) {
        lua_pushlstring(L, text->data(), text->size());
    } else if (std::holds_alternative<std::monostate>(value.content)) {
        lua_pushnil(L);
    } else {
        return false;
    }
    return true;
}

}  // namespace

void ScriptHost::push_value(const Value& value) {
    luaL_checkstack(L_, 10, "too many values");
    if (push_scalar(L_, value)) return;
    if (const auto* list = std::get_if<List>(&value.content)) {
        lua_createtable(L_, static_cast<int>(list->size()), 0);
        lua_Integer i = 0;
        for (const Value& item : *list) {
            push_value(item);
            lua_rawseti(L_, -2, ++i);
        }
        return;
    }
    const auto& fields = *std::get_if<Fields>(&value.content);
    if (const auto id = handle_in(fields)) return push_object(*id);
    lua_createtable(L_, 0, static_cast<int>(fields.values.size()));
    for (std::size_t i = 0; i < fields.values.size(); ++i) {
        lua_pushlstring(L_, fields.names[i].data(), fields.names[i].size());
        push_value(fields.values[i]);
        lua_rawset(L_, -3);
    }
}

void ScriptHost::push_values(const List& values) {
    for (const Value& value : values) push_value(value);
}

Fields ScriptHost::fields_at(int index, int depth) {
    // By their names: Lua's own order changes from run to run.
    std::map<std::string, Value> sorted;
    lua_pushnil(L_);
    while (lua_next(L_, index)) {
        std::size_t size = 0;
        const char* name = lua_tolstring(L_, -2, &size);
        sorted[std::string(name, size)] = value_at(lua_gettop(L_), depth + 1);
        lua_pop(L_, 1);
    }
    Fields fields;
    for (auto& [name, value] : sorted) fields.add(name, std::move(value));
    return fields;
}

List ScriptHost::list_at(int index, int depth) {
    List list;
    const auto length = static_cast<lua_Integer>(lua_rawlen(L_, index));
    for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, index, i);
        list.push_back(value_at(lua_gettop(L_), depth + 1));
        lua_pop(L_, 1);
    }
    return list;
}

Value ScriptHost::table_at(int index, int depth) {
    lua_Integer count = 0, names = 0;
    lua_pushnil(L_);
    while (lua_next(L_, index)) {
        ++count;
        if (lua_type(L_, -2) == LUA_TSTRING) ++names;
        lua_pop(L_, 1);
    }
    if (count > 0 && names == count) return fields_at(index, depth);
    if (names > 0 || count != static_cast<lua_Integer>(lua_rawlen(L_, index))) {
        refuse_result("a table of the results is neither a list nor has it names alone as keys");
    }
    return list_at(index, depth);
}

Value ScriptHost::value_at(int index, int depth) {
    if (depth > kDepth || !lua_checkstack(L_, 10)) {
        refuse_result("the results are nested too deeply");
    }
    // A table that stands in several places counts in each: a few can be more than memory holds.
    if (values_left_-- == 0) {
        refuse_result("the results are more than " + std::to_string(kMaxValues) + " values");
    }
    switch (lua_type(L_, index)) {
        case LUA_TNIL:
            return {};
        case LUA_TBOOLEAN:
            return lua_toboolean(L_, index) != 0;
        case LUA_TNUMBER:
            if (lua_isinteger(L_, index)) return std::int64_t{lua_tointeger(L_, index)};
            if (!std::isfinite(lua_tonumber(L_, index))) {
                refuse_result("a result is a number that is not finite, which JSON cannot hold");
            }
            return lua_tonumber(L_, index);
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* text = lua_tolstring(L_, index, &size);
            return std::string(text, size);
        }
        case LUA_TTABLE:
            return table_at(index, depth);
        case LUA_TUSERDATA: {
            const lua::Holder* holder = lua::find_holder(L_, index, nullptr);
            if (!holder) break;
            Fields handle;
            handle.add("object", static_cast<std::int64_t>(handle_of(index)));
            handle.add("type", holder->type_name);
            return handle;
        }
        default:
            break;
    }
    refuse_result(std::string("a result is a ") + lua_typename(L_, lua_type(L_, index)) +
                  ", which JSON cannot hold");
}

List ScriptHost::values_from(int first) {
    List values;
    values_left_ = kMaxValues;
    const int last = lua_gettop(L_);
    for (int i = first; i <= last; ++i) values.push_back(value_at(i));
    return values;
}

}  // namespace lissom::c
