// Help of functions and types as text for a terminal.
#include <algorithm>
#include <cctype>

#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/reference/reference.h"

namespace lissom::lua {
namespace {

constexpr std::size_t kWidth = 96;

// `text` in lines of at most kWidth, each behind `indent` spaces.
std::string wrapped(const std::string& text, std::size_t indent) {
    std::string result, line;
    const auto end_line = [&] {
        if (!line.empty()) result += std::string(indent, ' ') + line + "\n";
        line.clear();
    };
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && indent + line.size() + 1 + word.size() > kWidth) end_line();
        line += (line.empty() ? "" : " ") + word;
        at = end + 1;
    }
    end_line();
    return result;
}

std::string standard_text(const Parameter& p) {
    if (p.required) return "required";
    if (const auto* flag = std::get_if<bool>(&p.default_value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&p.default_value)) {
        return "default " + plain_number(*number);
    }
    if (const auto* word = std::get_if<std::string>(&p.default_value)) return "default " + *word;
    return p.default_text.empty() ? "optional" : "default: " + p.default_text;
}

const char* separator_of(const Parameter& p) {
    if (p.kind == Kind::option_map) return ".*.";
    return p.kind == Kind::option_list ? "[i]." : ".";
}

void add_parameter_help(std::string& text, const std::vector<Parameter>& parameters,
                        const std::string& prefix) {
    for (const Parameter& p : parameters) {
        text += wrapped(prefix + p.name + " (" + expectation(p) + "; " + standard_text(p) + ")", 2);
        text += wrapped(p.help + (p.unit.empty() ? "" : " In " + p.unit + "."), 6);
        add_parameter_help(text, p.fields, prefix + p.name + separator_of(p));
    }
}

std::string indented(const std::string& lines) {
    std::string text = "  ";
    for (const char c : lines) {
        text += c;
        if (c == '\n') text += "  ";
    }
    return text + "\n";
}

// "Mesh" of "lissom.Mesh".
std::string local_name(const std::string& name) {
    return name.substr(name.rfind('.') + 1);
}

std::string lowered(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        c = c == ':' ? '.' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return result;
}

// Without "lissom.", in small letters, with "." for ":": "mesh.save".
std::string plain_name(std::string_view name) {
    std::string plain = lowered(name);
    constexpr std::string_view kModule = "lissom.";
    if (plain.compare(0, kModule.size(), kModule) == 0) plain.erase(0, kModule.size());
    return plain;
}

bool is_part_of_name(char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c));
}

// Returns whether the example of a method calls it by `plain`: edit:report() by "edit.report".
bool is_in_example(const Function& method, const std::string& plain) {
    const std::size_t dot = plain.rfind('.');
    if (dot == std::string::npos || plain.substr(dot + 1) != lowered(method.name)) return false;
    const std::string example = lowered(method.example);
    const auto ends_at = [&](std::size_t i) {
        return i >= example.size() || !is_part_of_name(example[i]);
    };
    for (std::size_t at = example.find(plain); at != std::string::npos;
         at = example.find(plain, at + 1)) {
        if ((at == 0 || ends_at(at - 1)) && ends_at(at + plain.size())) return true;
    }
    return false;
}

// Returns whether examples of the type's methods call its object so: "edit" of a deformation.
bool is_variable_of(const Type& type, const std::string& plain) {
    return std::any_of(type.methods.begin(), type.methods.end(), [&](const Function& method) {
        return is_in_example(method, plain + "." + lowered(method.name));
    });
}

// Returns whether a name is that of a function in full, the part behind its last dot, or that of
// its example.
bool is_called(const Entry& entry, const std::string& plain) {
    const std::string full = plain_name(call_of(entry));
    return full == plain || full.substr(full.rfind('.') + 1) == plain ||
           (entry.type && is_in_example(*entry.function, plain));
}

std::string option_text(const Entry& entry, const Parameter& option) {
    std::string text = "option of " + signature(*entry.function, call_of(entry)) + "\n";
    add_parameter_help(text, {option}, "");
    return text;
}

}  // namespace

std::string call_of(const Entry& entry) {
    if (!entry.type) return "lissom." + entry.function->name;
    return variable_name(*entry.type) + ":" + entry.function->name;
}

std::string help_text(const Entry& entry) {
    const Function& f = *entry.function;
    std::string text = signature(f, call_of(entry)) + "\n" + wrapped(f.summary, 2);
    if (!f.arguments.empty() || !f.options.empty()) text += "\n";
    add_parameter_help(text, f.arguments, "");
    add_parameter_help(text, f.options, "");
    if (!f.results.empty()) text += "\n";
    for (const Result& r : f.results) {
        text += wrapped(
            "returns " + r.name + " (" + r.type + ")" + (r.help.empty() ? "" : ": " + r.help), 2);
    }
    if (!f.errors.empty()) {
        std::string codes = "errors:";
        for (const ErrorCode code : f.errors) codes += " " + std::string(code_name(code));
        text += wrapped(codes, 2);
    }
    return text + "\n" + indented(f.example);
}

std::string help_text(const Type& type) {
    std::string text = type.name + "\n" + wrapped(type.summary, 2) + "\n";
    for (const Operator& op : type.operators) text += wrapped(op.usage + ": " + op.help, 2);
    for (const Function& method : type.methods) {
        text += "  " + signature(method, variable_name(type) + ":" + method.name) + "\n";
    }
    return text;
}

std::string help_text(const Record& record) {
    std::string text = record.name + " (a table)\n" + wrapped(record.summary, 2) + "\n";
    for (const Result& field : record.fields) {
        text += wrapped(
            field.name + " (" + field.type + ")" + (field.help.empty() ? "" : ": " + field.help),
            2);
    }
    return text;
}

std::string help_overview(const Registry& registry) {
    std::string functions, types, tables;
    for (const auto& library : registry.libraries()) {
        for (const Function& f : library->functions) {
            functions += "  " + signature(f, "lissom." + f.name) + "\n";
        }
        for (const Type& type : library->types) {
            types += "  " + local_name(type.name) + ": " + type.summary + "\n";
        }
        for (const Record& record : library->records) {
            tables += "  " + local_name(record.name) + ": " + record.summary + "\n";
        }
    }
    return "Functions:\n" + functions + "\nTypes:\n" + types + "\nTables that functions return:\n" +
           tables;
}

std::string help_for(const Registry& registry, std::string_view name) {
    const std::string plain = plain_name(name);
    if (plain == "lissom" || plain.empty()) return help_overview(registry);
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "\n") + part; };
    for (const auto& library : registry.libraries()) {
        for (const Type& type : library->types) {
            if (plain_name(type.name) == plain) add(help_text(type));
        }
        for (const Record& record : library->records) {
            // Scripts know lissom.ToolEvent as an event.
            const std::string full = plain_name(record.name);
            if (full == plain || full == "tool" + plain) add(help_text(record));
        }
    }
    for (const auto& entry : registry.entries()) {
        if (is_called(*entry, plain)) add(help_text(*entry));
    }
    if (!text.empty()) return text;
    for (const auto& library : registry.libraries()) {
        for (const Type& type : library->types) {
            if (is_variable_of(type, plain)) add(help_text(type));
        }
    }
    for (const auto& entry : registry.entries()) {
        for (const Parameter& option : entry->function->options) {
            if (plain_name(option.name) == plain) add(option_text(*entry, option));
        }
    }
    return text;
}

std::vector<std::string> help_names(const Registry& registry) {
    std::vector<std::string> names;
    for (const auto& entry : registry.entries()) {
        const std::string full = plain_name(call_of(*entry));
        names.push_back(full);
        names.push_back(full.substr(full.rfind('.') + 1));
        for (const Parameter& option : entry->function->options) names.push_back(option.name);
    }
    for (const auto& library : registry.libraries()) {
        for (const Type& type : library->types) names.push_back(plain_name(type.name));
        for (const Record& record : library->records) names.push_back(plain_name(record.name));
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

}  // namespace lissom::lua
