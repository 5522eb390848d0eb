// JSON to Lua and back.
#include <algorithm>
#include <cmath>

#include "bindings/c/script/host.h"

namespace lissom::c {
namespace {

// Whether the JSON object stands for an object of the library.
bool is_handle(const Json& value) {
    return value.is_object() && value.contains("object") && value["object"].is_number_unsigned();
}

void visit_handles(const Json& value, int depth, const std::function<void(std::uint64_t)>& visit) {
    if (depth > ScriptHost::kDepth) {
        throw Error(ErrorCode::invalid_argument, "the arguments are nested too deeply");
    }
    if (is_handle(value)) return visit(value["object"].get<std::uint64_t>());
    if (!value.is_structured()) return;
    for (const Json& item : value) visit_handles(item, depth + 1, visit);
}

}  // namespace

void ScriptHost::check_values(const Json& values) {
    holders_.clear();
    visit_handles(values, 0, [&](std::uint64_t id) {
        if (!context_.objects.find(id, Kind::object)) {
            holders_.insert_or_assign(id, holder_of(id));
        } else {
            context_.share<LuaReference>(id, Kind::object);
        }
    });
}

void ScriptHost::push_object(std::uint64_t id) {
    const auto found = holders_.find(id);
    if (found == holders_.end()) {
        const auto* object = context_.objects.find(id, Kind::object);
        lua_rawgeti(L_, LUA_REGISTRYINDEX,
                    static_cast<LuaReference*>(object->content.get())->reference);
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
    auto* made = static_cast<lua::Holder*>(lua::new_userdata(L_, sizeof(lua::Holder)));
    new (made) lua::Holder(found->second.type_name);
    luaL_getmetatable(L_, found->second.type_name);
    lua_setmetatable(L_, -2);
    made->object = found->second.object;
    lua_pushvalue(L_, -1);
    lua::raw_set_pointer(L_, -3, content);
    lua_remove(L_, -2);
}

void ScriptHost::push_value(const Json& value) {
    luaL_checkstack(L_, 10, "too many values");
    if (is_handle(value)) return push_object(value["object"].get<std::uint64_t>());
    switch (value.type()) {
        case Json::value_t::boolean:
            return lua_pushboolean(L_, value.get<bool>());
        case Json::value_t::number_integer:
        case Json::value_t::number_unsigned:
            return lua_pushinteger(L_, value.get<lua_Integer>());
        case Json::value_t::number_float:
            return lua_pushnumber(L_, value.get<double>());
        case Json::value_t::string: {
            const auto& text = value.get_ref<const std::string&>();
            lua_pushlstring(L_, text.data(), text.size());
            return;
        }
        case Json::value_t::array: {
            lua_createtable(L_, static_cast<int>(value.size()), 0);
            lua_Integer i = 0;
            for (const Json& item : value) {
                push_value(item);
                lua_rawseti(L_, -2, ++i);
            }
            return;
        }
        case Json::value_t::object:
            lua_createtable(L_, 0, static_cast<int>(value.size()));
            for (auto item = value.begin(); item != value.end(); ++item) {
                lua_pushlstring(L_, item.key().data(), item.key().size());
                push_value(*item);
                lua_rawset(L_, -3);
            }
            return;
        default:
            return lua_pushnil(L_);
    }
}

void ScriptHost::push_values(const Json& values) {
    for (const Json& value : values) push_value(value);
}

Json ScriptHost::table_at(int index, int depth) {
    const auto length = static_cast<lua_Integer>(lua_rawlen(L_, index));
    bool is_list = true;
    lua_Integer count = 0;
    Json fields = Json::object();
    lua_pushnil(L_);
    while (lua_next(L_, index)) {
        ++count;
        if (lua_type(L_, -2) == LUA_TSTRING) {
            is_list = false;
            fields[lua_tostring(L_, -2)] = value_at(lua_gettop(L_), depth + 1);
        }
        lua_pop(L_, 1);
    }
    if (!is_list) return fields;
    if (count != length) {
        throw Error(ErrorCode::invalid_argument,
                    "a table of the results is neither a list nor has it names as keys");
    }
    Json list = Json::array();
    for (lua_Integer i = 1; i <= length; ++i) {
        lua_rawgeti(L_, index, i);
        list.push_back(value_at(lua_gettop(L_), depth + 1));
        lua_pop(L_, 1);
    }
    return list;
}

Json ScriptHost::value_at(int index, int depth) {
    if (depth > kDepth || !lua_checkstack(L_, 10)) {
        throw Error(ErrorCode::invalid_argument, "the results are nested too deeply");
    }
    // A table that stands in several places counts in each: a few can be more than memory holds.
    if (values_left_-- == 0) {
        throw Error(ErrorCode::invalid_argument,
                    "the results are more than " + std::to_string(kMostValues) + " values");
    }
    switch (lua_type(L_, index)) {
        case LUA_TNIL:
            return nullptr;
        case LUA_TBOOLEAN:
            return lua_toboolean(L_, index) != 0;
        case LUA_TNUMBER:
            if (lua_isinteger(L_, index)) return lua_tointeger(L_, index);
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
            const std::string type = holder->type_name;
            return Json{{"object", handle_of(index)}, {"type", type}};
        }
        default:
            break;
    }
    throw Error(ErrorCode::invalid_argument, std::string("a result is a ") +
                                                 lua_typename(L_, lua_type(L_, index)) +
                                                 ", which JSON cannot hold");
}

Json ScriptHost::values_from(int first) {
    Json values = Json::array();
    values_left_ = kMostValues;
    const int last = lua_gettop(L_);
    for (int i = first; i <= last; ++i) values.push_back(value_at(i));
    return values;
}

}  // namespace lissom::c
