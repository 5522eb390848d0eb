#include "bindings/lua/reference/json.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <variant>

#include "bindings/lua/reference/reference.h"

namespace lissom::lua {
namespace {

std::string json_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (c == '\n') {
            result += "\\n";
        } else {
            result += c;
        }
    }
    return result + '"';
}

// JSON has no infinite numbers; they are the texts "inf" and "-inf".
std::string json_number(double value) {
    if (!std::isfinite(value)) return value > 0.0 ? "\"inf\"" : "\"-inf\"";
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string json_default(const Parameter& p) {
    if (const auto* flag = std::get_if<bool>(&p.default_value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&p.default_value)) return json_number(*number);
    if (const auto* text = std::get_if<std::string>(&p.default_value)) return json_string(*text);
    return "";
}

template <typename Items, typename Write>
std::string json_list(const Items& items, const Write& write) {
    std::string text = "[";
    for (const auto& item : items) text += (text.size() > 1 ? "," : "") + write(item);
    return text + "]";
}

std::string json_parameter(const Parameter& p) {
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    std::string text = "{\"name\":" + json_string(p.name);
    text += ",\"type\":" + json_string(annotation_type(p));
    text += std::string(",\"required\":") + (p.required ? "true" : "false");
    if (const std::string value = json_default(p); !value.empty()) text += ",\"default\":" + value;
    if (p.min > -kEndless) text += ",\"min\":" + json_number(p.min);
    if (p.max < kEndless) text += ",\"max\":" + json_number(p.max);
    if (p.above_min) text += ",\"above_min\":true";
    if (!p.unit.empty()) text += ",\"unit\":" + json_string(p.unit);
    if (!p.choices.empty()) text += ",\"choices\":" + json_list(p.choices, json_string);
    if (!p.fields.empty()) text += ",\"fields\":" + json_list(p.fields, json_parameter);
    if (!p.alternatives.empty()) {
        text += ",\"alternatives\":" + json_list(p.alternatives, json_parameter);
    }
    return text + ",\"help\":" + json_string(p.help) + "}";
}

std::string json_result(const Result& result) {
    return "{\"name\":" + json_string(result.name) + ",\"type\":" + json_string(result.type) +
           ",\"help\":" + json_string(result.help) + "}";
}

// The name by which lissom_call of the C ABI knows a function: "shapes.box", "Mesh.smooth".
std::string name_for_calls(const Entry& entry) {
    constexpr std::string_view kPrefix = "lissom.";
    if (!entry.type) return entry.function->name;
    std::string_view type = entry.type->name;
    if (type.starts_with(kPrefix)) type.remove_prefix(kPrefix.size());
    return std::string(type) + "." + entry.function->name;
}

std::string json_entry(const Entry& entry) {
    const Function& function = *entry.function;
    std::string text = "{\"name\":" + json_string(name_for_calls(entry));
    text += ",\"call\":" + json_string(signature(function, call_of(entry)));
    text += ",\"summary\":" + json_string(function.summary);
    text += ",\"arguments\":" + json_list(function.arguments, json_parameter);
    text += ",\"options\":" + json_list(function.options, json_parameter);
    text += ",\"results\":" + json_list(function.results, json_result);
    text += ",\"errors\":" +
            json_list(function.errors, [](ErrorCode code) { return json_string(code_name(code)); });
    return text + "}";
}

}  // namespace

std::string reference_json(const Registry& registry) {
    std::string text = "{\"functions\":[\n";
    bool is_first = true;
    for (const auto& entry : registry.entries()) {
        text += (is_first ? "" : ",\n") + json_entry(*entry);
        is_first = false;
    }
    return text + "\n]}\n";
}

}  // namespace lissom::lua
