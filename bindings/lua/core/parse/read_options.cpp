// Readers of tables of options.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/old_names.h"
#include "bindings/lua/core/parse/message.h"
#include "bindings/lua/core/parse/parser.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

std::vector<std::string_view> slot_names(const Entry& entry, int first, int last) {
    std::vector<std::string_view> names;
    for (int i = first; i < last; ++i) names.push_back(entry.slots[i].parameter->name);
    return names;
}

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

void Parser::read_options(int index, int given) {
    const bool named = entry_.function->named_arguments;
    const bool takes_options = named || entry_.options_last > entry_.options_first;
    const bool has_options = takes_options && index <= given && !lua_isnil(L_, index);
    const int argument = index - (entry_.type ? 1 : 0);
    // The value in place of the options says more than the one after it.
    if (has_options && lua_type(L_, index) != LUA_TTABLE) {
        refuse(call_, {argument, "", 0}, "table of options", push_description(L_, index, ""));
    }
    if (entry_.function->more_arguments) return;
    for (int extra = takes_options ? index + 1 : index; extra <= given; ++extra) {
        if (lua_isnil(L_, extra)) continue;
        refuse(call_, {extra - (entry_.type ? 1 : 0), "", 0}, "no further argument",
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
        const ValuePlace place{0, entry_.slots[slot].path.c_str(), 0};
        Value& value = call_.values_[slot];
        if (lua_isnil(L_, -1)) {
            lua_pop(L_, 1);
            if (p.required) refuse_missing(call_, p, place);
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
            if (lua_type(L_, -1) != LUA_TTABLE) refuse_value(call_, p, lua_gettop(L_), place);
            value.present = true;
            value.kind = Kind::options;
            read_table(lua_gettop(L_), entry_.slots[slot].first, entry_.slots[slot].last);
        } else {
            values_.read(p, lua_gettop(L_), value, place);
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
        refuse(call_, {0, key, 0}, "table of options", push_description(L_, item, ""));
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

}  // namespace lissom::lua
