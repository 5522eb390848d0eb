#include "bindings/lua/core/parameter.h"

#include <utility>

namespace lissom::lua {
namespace {

Parameter make(std::string name, Kind kind, std::string help) {
    Parameter parameter;
    parameter.name = std::move(name);
    parameter.kind = kind;
    parameter.help = std::move(help);
    return parameter;
}

template <typename T>
Parameter with_default(Parameter parameter, T value) {
    parameter.required = false;
    parameter.default_value = std::move(value);
    return parameter;
}

}  // namespace

Parameter Parameter::optional(std::string text) const {
    Parameter copy = *this;
    copy.required = false;
    copy.default_text = std::move(text);
    return copy;
}

Parameter Parameter::thesis(std::string section, std::string text) const {
    Parameter copy = *this;
    copy.thesis_section = std::move(section);
    copy.thesis_text = std::move(text);
    return copy;
}

Parameter Parameter::defaults(bool value) const {
    return with_default(*this, value);
}
Parameter Parameter::defaults(int value) const {
    return with_default(*this, static_cast<double>(value));
}
Parameter Parameter::defaults(double value) const {
    return with_default(*this, value);
}
Parameter Parameter::defaults(const char* value) const {
    return with_default(*this, std::string(value));
}

Parameter Parameter::between(double low, double high) const {
    Parameter copy = *this;
    copy.min = low;
    copy.max = high;
    return copy;
}

Parameter Parameter::at_least(double low) const {
    Parameter copy = *this;
    copy.min = low;
    return copy;
}

Parameter Parameter::above(double low) const {
    Parameter copy = at_least(low);
    copy.above_min = true;
    return copy;
}

Parameter Parameter::or_infinite() const {
    Parameter copy = *this;
    copy.infinite = true;
    return copy;
}

Parameter Parameter::or_true() const {
    Parameter copy = *this;
    copy.flag = true;
    return copy;
}

Parameter Parameter::in(std::string name_of_unit) const {
    Parameter copy = *this;
    copy.unit = std::move(name_of_unit);
    return copy;
}

Parameter Parameter::elsewhere(std::vector<std::string> names) const {
    Parameter copy = *this;
    copy.other_names = std::move(names);
    return copy;
}

Parameter boolean(std::string name, std::string help) {
    return make(std::move(name), Kind::boolean, std::move(help));
}
Parameter integer(std::string name, std::string help) {
    return make(std::move(name), Kind::integer, std::move(help));
}
Parameter number(std::string name, std::string help) {
    return make(std::move(name), Kind::number, std::move(help));
}
Parameter string(std::string name, std::string help) {
    return make(std::move(name), Kind::string, std::move(help));
}
Parameter choice(std::string name, std::vector<std::string> choices, std::string help) {
    Parameter parameter = make(std::move(name), Kind::choice, std::move(help));
    parameter.choices = std::move(choices);
    return parameter;
}
Parameter id(std::string name, std::string help) {
    return make(std::move(name), Kind::id, std::move(help));
}
Parameter open_vector(std::string name, std::string help) {
    return make(std::move(name), Kind::open_vector, std::move(help));
}

Parameter vector(std::string name, std::string help) {
    return make(std::move(name), Kind::vector, std::move(help));
}
Parameter factors(std::string name, std::string help) {
    return make(std::move(name), Kind::factors, std::move(help));
}
Parameter axis(std::string name, std::string help) {
    return make(std::move(name), Kind::axis, std::move(help));
}
Parameter affine(std::string name, std::string help) {
    return make(std::move(name), Kind::affine, std::move(help));
}
Parameter matrix3(std::string name, std::string help) {
    return make(std::move(name), Kind::matrix3, std::move(help));
}

Parameter address(std::string name, std::string help) {
    return make(std::move(name), Kind::address, std::move(help));
}
Parameter ids(std::string name, std::string help) {
    return make(std::move(name), Kind::ids, std::move(help));
}
Parameter id_lists(std::string name, std::string help) {
    return make(std::move(name), Kind::id_lists, std::move(help));
}
Parameter points(std::string name, std::string help) {
    return make(std::move(name), Kind::points, std::move(help));
}
Parameter pixels(std::string name, std::string help) {
    return make(std::move(name), Kind::pixels, std::move(help));
}
Parameter numbers(std::string name, std::string help) {
    return make(std::move(name), Kind::numbers, std::move(help));
}
Parameter integers(std::string name, std::string help) {
    return make(std::move(name), Kind::integers, std::move(help));
}
Parameter strings(std::string name, std::string help) {
    return make(std::move(name), Kind::strings, std::move(help));
}
Parameter object(std::string name, std::string type_name, std::string help) {
    Parameter parameter = make(std::move(name), Kind::object, std::move(help));
    parameter.type_name = std::move(type_name);
    return parameter;
}
Parameter objects(std::string name, std::string type_name, std::string help) {
    Parameter parameter = make(std::move(name), Kind::objects, std::move(help));
    parameter.type_name = std::move(type_name);
    return parameter;
}
Parameter function(std::string name, std::string signature, std::string help) {
    Parameter parameter = make(std::move(name), Kind::function, std::move(help));
    parameter.type_name = std::move(signature);
    return parameter;
}
Parameter options(std::string name, std::vector<Parameter> fields, std::string help) {
    Parameter parameter = make(std::move(name), Kind::options, std::move(help));
    parameter.fields = std::move(fields);
    return parameter;
}
Parameter option_map(std::string name, std::vector<Parameter> fields, std::string help) {
    Parameter parameter = options(std::move(name), std::move(fields), std::move(help));
    parameter.kind = Kind::option_map;
    return parameter;
}
Parameter option_list(std::string name, std::vector<Parameter> fields, std::string help) {
    Parameter parameter = options(std::move(name), std::move(fields), std::move(help));
    parameter.kind = Kind::option_list;
    return parameter;
}
Parameter table(std::string name, std::string help) {
    return make(std::move(name), Kind::table, std::move(help));
}
Parameter either(std::string name, std::vector<Parameter> alternatives, std::string help) {
    Parameter parameter = make(std::move(name), Kind::either, std::move(help));
    parameter.alternatives = std::move(alternatives);
    return parameter;
}

}  // namespace lissom::lua
