/// Documents made from the registration table: editor annotations and the reference page.
#pragma once

#include <string>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// LuaCATS annotations (a ---@meta file) of what one library exposes.
std::string annotations(const Library& library);

/// The reference of one library as a Markdown page, with the table of all error codes where the
/// library is the kernel's.
std::string reference_page(const Library& library);

/// The LuaCATS type of a parameter: "number", "\"a\"|\"b\"", "lissom.Mesh", ...
std::string annotation_type(const Parameter& parameter);

}  // namespace lissom::lua
