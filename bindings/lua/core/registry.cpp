#include "bindings/lua/core/registry.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>
#include <utility>

namespace lissom::lua {
namespace {

[[noreturn]] void inconsistent(const std::string& where, const std::string& what) {
    throw std::logic_error("registration of '" + where + "': " + what);
}

void check_default(const std::string& where, const Parameter& p) {
    const auto* text = std::get_if<std::string>(&p.default_value);
    if (p.kind != Kind::choice || !text) return;
    if (std::find(p.choices.begin(), p.choices.end(), *text) == p.choices.end()) {
        inconsistent(where, "the default of '" + p.name + "' is none of its choices");
    }
}

void check_parameters(const std::string& where, const std::vector<Parameter>& parameters) {
    std::set<std::string> names;
    for (const Parameter& p : parameters) {
        if (p.name.empty()) inconsistent(where, "a parameter has no name");
        if (p.help.empty()) inconsistent(where, "'" + p.name + "' has no help");
        if (!names.insert(p.name).second) inconsistent(where, "'" + p.name + "' appears twice");
        if (p.kind == Kind::choice && p.choices.empty()) {
            inconsistent(where, "'" + p.name + "' has no choices");
        }
        for (const Parameter& alternative : p.alternatives) {
            if (alternative.kind == Kind::options || alternative.kind == Kind::either) {
                inconsistent(where, "'" + p.name + "' nests alternatives");
            }
        }
        check_default(where, p);
        check_parameters(where + "." + p.name, p.fields);
    }
}

bool has_name(const std::vector<Parameter>& parameters, const std::string& name) {
    return std::any_of(parameters.begin(), parameters.end(),
                       [&](const Parameter& p) { return p.name == name; });
}

void check_function(const std::string& where, const Function& function) {
    if (!function.body) inconsistent(where, "there is no body");
    if (function.summary.empty()) inconsistent(where, "there is no summary");
    if (function.example.empty()) inconsistent(where, "there is no example");
    check_parameters(where, function.arguments);
    check_parameters(where, function.options);
    for (const Parameter& p : function.arguments) {
        if (function.named_arguments && has_name(function.options, p.name)) {
            inconsistent(where, "'" + p.name + "' is an argument and an option");
        }
    }
    bool optional_seen = false;
    for (const Parameter& p : function.arguments) {
        if (p.required && optional_seen) {
            inconsistent(where, "the required argument '" + p.name + "' follows an optional one");
        }
        optional_seen = optional_seen || !p.required;
    }
}

// Gives the parameters of one level places next to each other, then the fields of each.
std::pair<int, int> add_slots(std::vector<Entry::Slot>& slots,
                              const std::vector<Parameter>& parameters, const std::string& prefix) {
    const int first = count_of(slots);
    for (const Parameter& p : parameters) slots.push_back({prefix + p.name, &p, 0, 0});
    const int last = count_of(slots);
    for (int i = first; i < last; ++i) {
        const Parameter& p = *slots[i].parameter;
        if (p.fields.empty()) continue;
        const auto [fields_first, fields_last] = add_slots(slots, p.fields, prefix + p.name + ".");
        slots[i].first = fields_first;
        slots[i].last = fields_last;
    }
    return {first, last};
}

}  // namespace

Registry::Registry() = default;
Registry::~Registry() = default;
Registry::Registry(Registry&&) noexcept = default;
Registry& Registry::operator=(Registry&&) noexcept = default;

void Registry::add(Library library) {
    libraries_.push_back(std::make_unique<const Library>(std::move(library)));
    const Library& added = *libraries_.back();
    for (const Type& type : added.types) {
        if (find_type(type.name) != &type) inconsistent(type.name, "the name is taken");
        for (const Function& method : type.methods) add_entry(method, &type);
    }
    for (const Function& function : added.functions) add_entry(function, nullptr);
}

void Registry::add_entry(const Function& function, const Type* type) {
    const std::string where = (type ? type->name + ":" : "lissom.") + function.name;
    check_function(where, function);
    for (const auto& other : entries_) {
        if (other->type == type && other->function->name == function.name) {
            inconsistent(where, "the name is taken");
        }
    }
    auto entry = std::make_unique<Entry>();
    entry->function = &function;
    entry->type = type;
    entry->arguments = add_slots(entry->slots, function.arguments, "").second;
    const auto [first, last] = add_slots(entry->slots, function.options, "");
    entry->options_first = first;
    entry->options_last = last;
    if (entry->slots.size() > at(Entry::kMaximumSlots)) {
        inconsistent(where, "there are too many parameters");
    }
    entries_.push_back(std::move(entry));
}

const Type* Registry::find_type(const std::string& name) const {
    for (const auto& library : libraries_) {
        for (const Type& type : library->types) {
            if (type.name == name) return &type;
        }
    }
    return nullptr;
}

Registry kernel_registry() {
    Registry registry;
    registry.add(kernel_library());
    return registry;
}

std::string variable_name(const Type& type) {
    std::string name = type.name.substr(type.name.rfind('.') + 1);
    name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    return name;
}

}  // namespace lissom::lua
