#include "bindings/lua/reference/reference.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "bindings/lua/core/failure.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/reference/departures.h"
#include "bindings/lua/reference/json.h"

namespace lissom::lua {
namespace {

std::string default_text(const Parameter& p) {
    if (const auto* flag = std::get_if<bool>(&p.default_value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<double>(&p.default_value)) return plain_number(*number);
    if (const auto* text = std::get_if<std::string>(&p.default_value)) return '"' + *text + '"';
    if (p.thesis_text.empty()) return p.default_text;
    return p.default_text + "; as in the thesis " + p.thesis_text;
}

// "Passes; in degrees; default 10": all that a reader needs beside the type.
std::string explanation(const Parameter& p) {
    std::string text = p.help;
    if (!p.unit.empty()) text += " In " + p.unit + ".";
    const std::string standard = default_text(p);
    if (!standard.empty()) text += " Default: " + standard + ".";
    return text;
}

bool has_required(const std::vector<Parameter>& parameters) {
    return std::any_of(parameters.begin(), parameters.end(),
                       [](const Parameter& p) { return p.required; });
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) text += (i == 0 ? "" : separator) + words[i];
    return text;
}

// ---- Annotations

std::string capitalized(std::string text) {
    if (!text.empty())
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

void add_fields(std::string& text, const std::vector<Parameter>& fields, const std::string& owner);

// A class for the option table `owner`, after those of its nested tables.
void add_option_class(std::string& text, const std::vector<Parameter>& fields,
                      const std::string& owner) {
    for (const Parameter& p : fields) {
        if (!p.fields.empty()) add_option_class(text, p.fields, owner + "." + capitalized(p.name));
    }
    text += "---@class " + owner + "\n";
    add_fields(text, fields, owner);
    text += "\n";
}

std::string field_type(const Parameter& p, const std::string& owner) {
    if (p.kind == Kind::options) {
        return owner + "." + capitalized(p.name) + (p.flag ? "|boolean" : "");
    }
    if (p.kind == Kind::option_map) {
        return "table<string, " + owner + "." + capitalized(p.name) + ">";
    }
    if (p.kind == Kind::option_list) return owner + "." + capitalized(p.name) + "[]";
    return annotation_type(p);
}

void add_fields(std::string& text, const std::vector<Parameter>& fields, const std::string& owner) {
    for (const Parameter& p : fields) {
        text += "---@field " + p.name + (p.required ? " " : "? ") + field_type(p, owner) + " " +
                explanation(p) + "\n";
    }
}

std::string options_class(const std::string& owner, const Function& function) {
    std::string name = function.name;
    name = name.substr(name.rfind('.') + 1);
    return owner + "." + capitalized(name) + "Options";
}

// A type that may stand beside others: a function's result would absorb the next type.
std::string single_type(const std::string& type) {
    return type.compare(0, 4, "fun(") == 0 ? "(" + type + ")" : type;
}

// "x: number, y: number, z: number" in place of a vector: the other way to call the function.
std::string spread_parameters(const Function& function, const std::string& class_name) {
    std::vector<std::string> words;
    const auto vectors = std::count_if(function.arguments.begin(), function.arguments.end(),
                                       [](const Parameter& p) { return p.kind == Kind::vector; });
    for (const Parameter& p : function.arguments) {
        if (p.kind == Kind::vector) {
            const std::string prefix = vectors > 1 ? p.name + "_" : "";
            for (const char* axis : {"x", "y", "z"}) {
                words.push_back(prefix + axis + (p.required ? ": number" : "?: number"));
            }
        } else {
            words.push_back(p.name + (p.required ? ": " : "?: ") + field_type(p, class_name));
        }
    }
    if (!function.options.empty()) words.push_back("options?: " + class_name);
    return joined(words, ", ");
}

// Whether the table of options may stand in the place of the first argument.
bool takes_options_instead(const Function& function) {
    if (function.named_arguments) return true;
    return !function.options.empty() && !function.arguments.empty() &&
           !function.arguments.front().required;
}

// The keys of a function's option table: its arguments too, if they may be given by name.
std::vector<Parameter> options_of(const Function& function) {
    std::vector<Parameter> all = function.options;
    if (function.named_arguments) {
        for (const Parameter& p : function.arguments) all.push_back(p.optional(p.default_text));
    }
    return all;
}

// Adds ---@param lines and returns the names.
std::vector<std::string> add_parameters(std::string& text, const Function& function,
                                        const std::string& class_name) {
    std::vector<std::string> names;
    for (const Parameter& p : function.arguments) {
        names.push_back(p.name);
        text += "---@param " + p.name + (p.required ? " " : "? ") + field_type(p, class_name) +
                " " + explanation(p) + "\n";
    }
    if (function.more_arguments) {
        names.emplace_back("...");
        text += "---@param ... any Its arguments.\n";
    }
    if (function.options.empty()) return names;
    names.push_back("options");
    const bool instead =
        function.named_arguments || (function.one_option && !function.arguments.empty());
    const bool required = (has_required(function.options) || function.one_option) && !instead;
    text += "---@param options" + std::string(required ? " " : "? ") + class_name + "\n";
    return names;
}

void add_results(std::string& text, const Function& function) {
    for (const Result& r : function.results) {
        text +=
            "---@return " + r.type + " " + r.name + (r.help.empty() ? "" : " # " + r.help) + "\n";
    }
}

void add_overloads(std::string& text, const Function& function, const std::string& owner,
                   const std::string& class_name, bool is_method) {
    const std::string self = is_method ? "self: " + owner + ", " : "";
    const std::string result =
        function.results.empty() ? "" : ": " + single_type(function.results[0].type);
    const bool has_vector = std::any_of(function.arguments.begin(), function.arguments.end(),
                                        [](const Parameter& p) { return p.kind == Kind::vector; });
    if (has_vector) {
        text += "---@overload fun(" + self + spread_parameters(function, class_name) + ")" +
                result + "\n";
    }
    if (takes_options_instead(function)) {
        text += "---@overload fun(" + self + "options: " + class_name + ")" + result + "\n";
    }
}

// `call` is how it is defined: "lissom.load" or "Mesh:smooth".
void add_function(std::string& text, const Function& function, const std::string& owner,
                  const std::string& call) {
    const std::string class_name = options_class(owner, function);
    for (const Parameter& p : function.arguments) {
        if (!p.fields.empty())
            add_option_class(text, p.fields, class_name + "." + capitalized(p.name));
    }
    if (!options_of(function).empty()) add_option_class(text, options_of(function), class_name);
    text += "---" + function.summary + "\n";
    const std::vector<std::string> names = add_parameters(text, function, class_name);
    add_results(text, function);
    add_overloads(text, function, owner, class_name, call.find(':') != std::string::npos);
    text += "function " + call + "(" + joined(names, ", ") + ") end\n\n";
}

void add_type(std::string& text, const Type& type) {
    text += "---" + type.summary + "\n---@class " + type.name + "\n";
    for (const Operator& op : type.operators) {
        if (op.name == "__len") text += "---@operator len: integer\n";
        if (op.name == "__index" && type.name == "lissom.Buffer")
            text += "---@field [integer] number\n";
        if (op.name == "__index" && type.name == "lissom.Params")
            text += "---@field [string] any\n";
    }
    for (const Result& field : type.fields) {
        text += "---@field " + field.name + " " + field.type + " " + field.help + "\n";
    }
    const std::string local = type.name.substr(type.name.rfind('.') + 1);
    text += "local " + local + " = {}\n\n";
    for (const Function& method : type.methods) {
        add_function(text, method, type.name, local + ":" + method.name);
    }
    text +=
        "---Frees the contents of the object. It may be called again; any other use is an error "
        "then.\nfunction " +
        local + ":close() end\n\n";
}

void add_common_types(std::string& text) {
    text +=
        "---Three numbers: {x, y, z}.\n---@alias lissom.Vector number[]\n\n"
        "---Elements that an error is about.\n---@class lissom.Elements\n"
        "---@field kind string vertex, edge, face, corner, component or line.\n"
        "---@field count integer How many there are.\n"
        "---@field ids integer[]|integer[][] The first hundred; pairs of vertices for edges.\n\n";
}

// ---- The page

// Between the name of a parameter and those of its fields.
std::string field_separator(const Parameter& p) {
    if (p.kind == Kind::option_map) return ".*.";
    return p.kind == Kind::option_list ? "[i]." : ".";
}

std::string table_cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
        text.insert(at, "\\");
    }
    return text;
}

void add_rows(std::string& text, const std::vector<Parameter>& parameters,
              const std::string& prefix) {
    for (const Parameter& p : parameters) {
        std::string accepted = expectation(p);
        std::string meaning = p.help;
        if (!p.unit.empty()) meaning += " In " + p.unit + ".";
        const std::string standard = p.required ? "required" : default_text(p);
        text += "| `" + prefix + p.name + "` | " + table_cell(accepted) + " | " +
                table_cell(standard) + " | " + table_cell(meaning) + " |\n";
        add_rows(text, p.fields, prefix + p.name + field_separator(p));
    }
}

std::string anchor(const Function& function) {
    return function.name.substr(function.name.rfind('.') + 1);
}

std::string record_anchor(const Record& record) {
    return record.name.substr(record.name.rfind('.') + 1);
}

// "shapes" of shapes.box, "" of load.
std::string table_of(const Function& function) {
    const std::size_t dot = function.name.find('.');
    return dot == std::string::npos ? "" : function.name.substr(0, dot);
}

// The first sentence of a summary, for lists.
std::string first_sentence(const std::string& text) {
    for (std::size_t at = 0; (at = text.find(". ", at)) != std::string::npos; ++at) {
        const bool abbreviated = at >= 3 && text[at - 2] == '.';
        if (!abbreviated) return text.substr(0, at + 1);
    }
    return text;
}

// An entry of a list of contents.
std::string content_line(const std::string& name, const std::string& place,
                         const std::string& summary) {
    return "- [`" + name + "`](" + place + "): " + first_sentence(summary) + "\n";
}

// " axis = ..., angle = ... ".
std::string named_words(const Function& function) {
    std::vector<std::string> words;
    for (const Parameter& p : function.arguments) words.push_back(p.name + " = ...");
    return " " + joined(words, ", ") + " ";
}

void add_function_section(std::string& text, const Function& function, const std::string& call) {
    text += "<a id=\"" + anchor(function) + "\"></a>\n\n### `" + signature(function, call) +
            "`\n\n" + function.summary + "\n\n";
    if (!function.arguments.empty() || !function.options.empty()) {
        text += "| argument | accepts | default | meaning |\n|---|---|---|---|\n";
        add_rows(text, function.arguments, "");
        add_rows(text, function.options, "");
        text += "\n";
    }
    if (function.named_arguments) {
        text += "- arguments may be given by name: `" + call + "{" + named_words(function) + "}`\n";
    }
    for (const Result& r : function.results) {
        text += "- returns `" + r.name + "` (" + r.type + ")" +
                (r.help.empty() ? "" : ": " + r.help) + "\n";
    }
    if (!function.errors.empty()) {
        text += "- errors:";
        for (std::size_t i = 0; i < function.errors.size(); ++i) {
            text += (i == 0 ? " " : ", ") + std::string(code_name(function.errors[i]));
        }
        text += "\n";
    }
    text +=
        "\n```lua\n" + function.example + (function.example.back() == '\n' ? "" : "\n") + "```\n\n";
}

constexpr const char* kPageHead = "<!-- Made from the registration table; do not edit. -->\n\n";

std::string type_page(const Type& type) {
    const std::string variable = variable_name(type);
    std::string text =
        kPageHead + ("# " + type.name + "\n\n") + type.summary + "\n\n[All pages](README.md)\n\n";
    for (const Function& method : type.methods) {
        text += content_line(variable + ":" + method.name, "#" + anchor(method), method.summary);
    }
    text += "\n";
    for (const Operator& op : type.operators) {
        text += "- `" + op.usage + "`: " + op.help + "\n";
    }
    for (const Result& field : type.fields) {
        text += "- `" + variable + "." + field.name + "`: " + field.type + ". " + field.help + "\n";
    }
    text += "- `" + variable +
            ":close()`: frees the contents of the object; it may be called again\n\n";
    for (const Function& method : type.methods) {
        add_function_section(text, method, variable + ":" + method.name);
    }
    return text;
}

// The functions of the table `prefix` ("" or "shapes.") of the module.
std::string functions_page(const std::vector<const Function*>& functions,
                           const std::string& title) {
    std::string text = kPageHead + ("# " + title + "\n\n[All pages](README.md)\n\n");
    for (const Function* function : functions) {
        text +=
            content_line("lissom." + function->name, "#" + anchor(*function), function->summary);
    }
    text += "\n";
    for (const Function* function : functions) {
        add_function_section(text, *function, "lissom." + function->name);
    }
    return text;
}

void add_conventions(std::string& text) {
    text +=
        "- Vertices, faces and all other elements count from 1; angles are in degrees; lengths are "
        "in "
        "the mesh's own unit.\n"
        "- Everything that fails raises an error object: `tostring(e)` is its message, `e.code` "
        "its [code](codes.md), `e.elements` is nil or `{kind=, count=, ids=}` (at most a hundred "
        "ids, pairs of vertices for edges), `e.file` and `e.line` are those of an input file, "
        "`e.place` is the line of the script.\n"
        "- `lissom.try(f, ...)` returns the results of `f`, or `nil, error`; `pcall` works as "
        "with every error.\n- An option that does not exist is an error, with the nearest "
        "name.\n- Arguments `x, y, z` may also be given as one `{x, y, z}`.\n- Verbs that "
        "change an object return it; those that make something return a new object.\n- Objects "
        "are freed by the collector; `close()` or `local mesh <close> =` frees them earlier.\n- "
        "A name that the module does not have is an error: test for one with `rawget(lissom, "
        "name)`.\n\n";
}

std::string codes_page() {
    std::string text = kPageHead + std::string("# Error codes\n\n[All pages](README.md)\n\n") +
                       "The field `code` of an error object.\n\n| code | meaning |\n|---|---|\n";
    for (const ErrorCode code : all_codes()) {
        text += "| " + std::string(code_name(code)) + " | " +
                table_cell(std::string(code_explanation(code))) + " |\n";
    }
    return text;
}

std::string departures_page(const std::vector<Departure>& all) {
    std::string text =
        kPageHead +
        std::string(
            "# Differences from the thesis\n\n[All pages](README.md)\n\nDeliberate choices that "
            "give better shapes and hair: Fu, *Differential methods for intuitive 3D shape "
            "modeling* (2007), chapters 2 to 4. The last column names the option that selects "
            "the thesis's choice; if it is empty, there is none. An option that is given "
            "overrides `fidelity`.\n\n| section | subject | by default | in the thesis | as in "
            "the thesis by |\n|---|---|---|---|---|\n");
    for (const Departure& one : all) {
        text += "| " + one.section + " | " + table_cell(one.subject) + " | " +
                table_cell(one.usual) + " | " + table_cell(one.thesis) + " | " +
                table_cell(one.by) + " |\n";
    }
    return text;
}

std::string records_page(const std::vector<const Record*>& records) {
    std::string text = kPageHead + std::string(
                                       "# Tables\n\nPlain tables that functions return.\n\n"
                                       "[All pages](README.md)\n\n");
    for (const Record* record : records) {
        text += content_line(record->name, "#" + record_anchor(*record), record->summary);
    }
    text += "\n";
    for (const Record* record : records) {
        text += "<a id=\"" + record_anchor(*record) + "\"></a>\n\n### " + record->name + "\n\n" +
                record->summary + "\n\n";
        for (const Result& field : record->fields) {
            text += "- `" + field.name + "` (" + field.type + "): " + field.help + "\n";
        }
        text += "\n";
    }
    return text;
}

// Names of the tables below the module: "shapes".
std::vector<std::string> subtables(const Library& library) {
    std::vector<std::string> names;
    for (const Function& function : library.functions) {
        const std::size_t dot = function.name.find('.');
        if (dot == std::string::npos) continue;
        const std::string name = function.name.substr(0, dot);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

// The entries of all libraries; functions by the table that they are in.
struct Content {
    std::map<std::string, std::vector<const Function*>> functions;
    std::vector<const Type*> types;
    std::vector<const Record*> records;
};

Content content_of(const Registry& registry) {
    Content content;
    for (const auto& library : registry.libraries()) {
        for (const Function& f : library->functions) content.functions[table_of(f)].push_back(&f);
        for (const Type& type : library->types) content.types.push_back(&type);
        for (const Record& record : library->records) content.records.push_back(&record);
    }
    return content;
}

void add_constants(std::string& index, const Registry& registry) {
    for (const auto& library : registry.libraries()) {
        for (const Constant& constant : library->constants) {
            index += "- `lissom." + constant.name + "`: " + constant.help + "\n";
        }
    }
}

void add_function_pages(std::string& index, std::vector<Page>& pages,
                        const std::map<std::string, std::vector<const Function*>>& functions) {
    for (const auto& [table, list] : functions) {
        const std::string name = table.empty() ? "lissom" : table;
        const std::string title = table.empty() ? "lissom" : "lissom." + table;
        pages.push_back({name + ".md", functions_page(list, title)});
        for (const Function* f : list) {
            index += content_line("lissom." + f->name, name + ".md#" + anchor(*f), f->summary);
        }
    }
}

void add_type_pages(std::string& index, std::vector<Page>& pages,
                    const std::vector<const Type*>& types) {
    for (const Type* type : types) {
        const std::string file = variable_name(*type) + ".md";
        pages.push_back({file, type_page(*type)});
        index += "- [" + type->name + "](" + file + "): " + type->summary + "\n";
    }
}

constexpr const char* kKernelLibrary = "lissom";

}  // namespace

std::string annotation_type(const Parameter& p) {
    switch (p.kind) {
        case Kind::boolean:
            return "boolean";
        case Kind::integer:
        case Kind::id:
            return "integer";
        case Kind::number:
            return "number";
        case Kind::string:
            return "string";
        case Kind::choice: {
            std::vector<std::string> words;
            for (const std::string& c : p.choices) words.push_back('"' + c + '"');
            return joined(words, "|");
        }
        case Kind::vector:
        case Kind::open_vector:
            return "lissom.Vector";
        case Kind::factors:
            return "number|lissom.Vector";
        case Kind::axis:
            return "\"x\"|\"y\"|\"z\"|lissom.Vector";
        case Kind::affine:
        case Kind::matrix3:
            return "number[][]";
        case Kind::address:
            return "lightuserdata";
        case Kind::ids:
        case Kind::integers:
            return "integer[]";
        case Kind::id_lists:
            return "integer[][]";
        case Kind::points:
            return "lissom.Vector[]";
        case Kind::pixels:
            return "number[][]";
        case Kind::numbers:
            return "number[]";
        case Kind::strings:
            return "string[]";
        case Kind::object:
            return p.type_name;
        case Kind::objects:
            return p.type_name + "[]";
        case Kind::function:
            return p.type_name;
        case Kind::options:
        case Kind::option_map:
        case Kind::option_list:
        case Kind::table:
            return "table";
        case Kind::either: {
            std::vector<std::string> words;
            for (const Parameter& alternative : p.alternatives) {
                words.push_back(single_type(annotation_type(alternative)));
            }
            return joined(words, "|");
        }
    }
    return "any";
}

std::string signature(const Function& function, const std::string& call) {
    std::vector<std::string> words;
    for (const Parameter& p : function.arguments) {
        const std::string shown = p.kind == Kind::vector && function.arguments.size() <= 2 &&
                                          (&p == &function.arguments.back())
                                      ? "x, y, z"
                                      : p.name;
        words.push_back(p.required ? shown : "[" + shown + "]");
    }
    if (function.more_arguments) words.emplace_back("...");
    if (function.options.empty()) return call + "(" + joined(words, ", ") + ")";
    if (words.empty()) return call + "{...}";
    words.push_back(has_required(function.options) ? "{...}" : "[{...}]");
    return call + "(" + joined(words, ", ") + ")";
}

std::string annotations(const Library& library) {
    const bool is_kernel = library.name == kKernelLibrary;
    // A script that requires "lissom" finds the kernel's file; others add to its class.
    std::string text = "---@meta " + std::string(is_kernel ? "lissom" : "_") +
                       "\n-- Made from the registration table; do not edit.\n\n";
    if (is_kernel) add_common_types(text);
    for (const Record& record : library.records) {
        text += "---" + record.summary + "\n---@class " + record.name + "\n";
        for (const Result& field : record.fields) {
            text += "---@field " + field.name + " " + field.type + " " + field.help + "\n";
        }
        text += "\n";
    }
    for (const Type& type : library.types) add_type(text, type);
    text += "---" + library.summary + "\n---@class lissom\n";
    for (const Constant& constant : library.constants) {
        text += "---@field " + constant.name + " string " + constant.help + "\n";
    }
    text += "local lissom = {}\n\n";
    for (const std::string& name : subtables(library)) text += "lissom." + name + " = {}\n\n";
    for (const Function& function : library.functions) {
        add_function(text, function, "lissom", "lissom." + function.name);
    }
    return text + "return lissom\n";
}

std::vector<Page> reference_pages(const Registry& registry) {
    const Content content = content_of(registry);
    std::vector<Page> pages;
    std::string index = kPageHead + std::string("# Lua reference\n\n");
    add_conventions(index);
    index += "## The module\n\n";
    add_constants(index, registry);
    add_function_pages(index, pages, content.functions);
    index += "\n## Objects\n\n";
    add_type_pages(index, pages, content.types);
    index +=
        "\n## Tables and codes\n\n- [Tables](tables.md) that functions return\n"
        "- [Error codes](codes.md)\n- [Differences from the thesis](thesis.md)\n";
    pages.push_back({"tables.md", records_page(content.records)});
    pages.push_back({"codes.md", codes_page()});
    pages.push_back({"thesis.md", departures_page(departures(registry))});
    pages.push_back({"README.md", index});
    pages.push_back({"reference.json", reference_json(registry)});
    return pages;
}

}  // namespace lissom::lua
