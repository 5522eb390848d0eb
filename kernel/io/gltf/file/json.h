/// JSON of glTF files and how its members are looked up; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/io/stream/json_tree.h"

namespace lissom {

using Json = SortedJson;

/// Returns the member `key` of `object`; null if there is none or `object` is something else.
const Json* member(const Json& object, const char* key);
Json* member(Json& object, const char* key);

/// Returns the member `key` of the extension `name` of `object`, or null.
const Json* extension(const Json& object, const char* name);

/// Returns the member `key` as a whole number from 0 to 2^31 - 1. Absent: -1. Errors: file_syntax
/// naming `owner` for any other value.
int index_member(const Json& object, const char* key, const std::string& owner);

/// Returns the text of the member `key`, empty if it is absent or none.
std::string text_member(const Json& object, const char* key);

/// Elements of the array `key`, 0 if there is none.
std::size_t size_of_member(const Json& object, const char* key);

/// Returns the object called `key` inside `parent`; made if it is absent.
Json& object_in(Json& parent, const char* key);

/// Returns `json` as text; invalid UTF-8 is replaced.
std::string to_text(const Json& json);

/// Calls `visit(object)` for every object inside `json`, itself included, but not those in extras,
/// whose content means nothing to glTF. The visitor may change the object.
template <typename AnyJson, typename Visit>
void for_each_object(AnyJson& json, const Visit& visit) {
    if (json.is_array()) {
        for (auto& child : json) for_each_object(child, visit);
    }
    if (!json.is_object()) return;
    visit(json);
    for (auto it = json.begin(); it != json.end(); ++it) {
        if (it.key() != "extras") for_each_object(it.value(), visit);
    }
}

/// Returns the array `key` of an object, made if it is missing.
Json& list_in(Json& json, const char* key);

}  // namespace lissom
