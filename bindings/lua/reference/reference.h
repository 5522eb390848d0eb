/// Documents made from the registration table: editor annotations, the reference pages, and the
/// help of single functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// Returns LuaCATS annotations (a ---@meta file) of one library.
std::string annotations(const Library& library);

/// A file of the reference.
struct Page {
    std::string file;
    std::string text;
};

/// The reference of all libraries as Markdown pages: README.md with conventions and contents, one
/// for the module and for each of its tables, one a type, tables.md and codes.md; and as
/// reference.json (json.h).
std::vector<Page> reference_pages(const Registry& registry);

/// The LuaCATS type of a parameter: "number", "\"a\"|\"b\"", "lissom.Mesh", ...
std::string annotation_type(const Parameter& parameter);

/// Returns the call of a function: "mesh:save(path, [{...}])" for `call` "mesh:save".
std::string signature(const Function& function, const std::string& call);

/// Returns the name in a call: "lissom.load", "mesh:save".
std::string call_of(const Entry& entry);

/// Returns a function's help for terminals: call, summary, arguments, results, errors, example.
std::string help_text(const Entry& entry);
/// The same of a type: its summary, operators, and a line for each method.
std::string help_text(const Type& type);
/// The same of a table that functions return: its summary and fields.
std::string help_text(const Record& record);
/// A line for each function of the module, each type and each such table.
std::string help_overview(const Registry& registry);

/// Returns the help of all that `name` may mean: "save", "mesh.save", "Mesh:save", "lissom.load",
/// "shapes.box", "Mesh", "Bounds". Empty if nothing has the name.
std::string help_for(const Registry& registry, std::string_view name);
/// All names that help_for knows.
std::vector<std::string> help_names(const Registry& registry);

}  // namespace lissom::lua
