/// Objects of JSON from their members; private to kernel/io and kernel/scene.
#pragma once

#include <initializer_list>
#include <utility>

#include "kernel/io/stream/json_tree.h"

namespace lissom {

/// A member of an object that is being made.
template <typename Json>
struct JsonMember {
    template <typename Content>
    JsonMember(const char* key, Content&& content)
        : name(key), value(std::forward<Content>(content)) {}

    const char* name;
    // Members of lists of initialisers are constant, and this one is moved on.
    mutable Json value;
};

/// Returns an object with these members. nlohmann's own list of initialisers does not free the
/// members before one that finds no memory.
template <typename Json = SortedJson>
Json json_object(std::initializer_list<JsonMember<Json>> members) {
    Json object = Json::object();
    for (const JsonMember<Json>& one : members) object[one.name] = std::move(one.value);
    return object;
}

}  // namespace lissom
