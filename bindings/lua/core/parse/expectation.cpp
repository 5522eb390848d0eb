#include "bindings/lua/core/parse/expectation.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include "bindings/lua/core/parse/message.h"

namespace lissom::lua {
namespace {

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

}  // namespace lissom::lua
