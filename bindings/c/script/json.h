/// Values of lissom_call and of scripts, and their JSON; private to bindings/c. The library's own
/// type, because a tree of nlohmann's takes memory when it is destroyed, and ends the process if
/// there is none.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kernel/core/context.h"

namespace lissom::c {

struct Value;

/// Names and values, in order.
struct Fields {
    std::vector<std::string> names;
    std::vector<Value> values;

    void add(std::string name, Value value);
};

using List = std::vector<Value>;

/// A value of JSON; monostate is null.
struct Value {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Fields> content;

    Value() = default;
    Value(bool value) : content(value) {}
    Value(std::int64_t value) : content(value) {}
    Value(double value) : content(value) {}
    Value(const char* value) : content(std::string(value)) {}
    Value(std::string value) : content(std::move(value)) {}
    Value(List value) : content(std::move(value)) {}
    Value(Fields value) : content(std::move(value)) {}
};

/// Levels of lists and tables in one another, at most.
constexpr int kDepth = 100;

/// Returns the list that `text` holds. Errors: invalid_argument, naming the byte, if it is no JSON,
/// no list, nested too deeply, or has a number that neither an integer of 64 bits nor a double
/// holds, or a name twice.
List list_of_json(std::string_view text, const Context& context);

/// Returns the JSON of a list, on one line. Errors: invalid_argument for a
/// text that is not UTF-8.
std::string json_of(const List& list);

}  // namespace lissom::c
