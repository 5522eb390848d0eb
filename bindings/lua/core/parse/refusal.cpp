#include "bindings/lua/core/parse/refusal.h"

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/old_names.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/core/parse/message.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {

void refuse(const Call& call, const ValuePlace& place, const char* expected, const char* got) {
    char text[kTextSize];
    compose_text(text, [&] {
        const std::string where = place.argument > 0
                                      ? "bad argument #" + std::to_string(place.argument) + " to '"
                                      : "bad option '" + std::string(place.path) + "' of '";
        const std::string item = place.item > 0 ? " at [" + std::to_string(place.item) + "]" : "";
        return where + call.name() + "' (" + expected + " expected" + item + ", got " + got + ")";
    });
    call.raise(text);
}

void refuse_value(const Call& call, const Parameter& p, int index, const ValuePlace& place) {
    char expected[kTextSize];
    compose_text(expected, [&] { return expectation(p); });
    const bool is_choice = p.kind == Kind::choice && lua_type(call.lua(), index) == LUA_TSTRING;
    const char* got = push_description(call.lua(), index, p.type_name.c_str());
    if (!is_choice) refuse(call, place, expected, got);
    char hinted[kTextSize];
    const char* given = lua_tostring(call.lua(), index);
    compose_text(hinted, [&] {
        const std::vector<std::string_view> names(p.choices.begin(), p.choices.end());
        const std::string old =
            old_name_hint(OldKind::value, std::string(call.name()) + "." + place.path, given);
        if (!old.empty()) return std::string(got) + old;
        const std::string_view nearest = nearest_name(given, names);
        return std::string(got) +
               (nearest.empty() ? "" : ", did you mean \"" + std::string(nearest) + "\"?");
    });
    refuse(call, place, expected, hinted);
}

void refuse_none(const Call& call, const Parameter& p, const ValuePlace& place) {
    char expected[kTextSize];
    compose_text(expected, [&] { return expectation(p); });
    refuse(call, place, expected, "no value");
}

void refuse_missing(const Call& call, const Parameter& p, const ValuePlace& place) {
    char text[kTextSize];
    compose_text(text, [&] {
        return "missing option '" + std::string(place.path) + "' of '" + call.name() + "' (" +
               expectation(p) + ")";
    });
    call.raise(text);
}

}  // namespace lissom::lua
