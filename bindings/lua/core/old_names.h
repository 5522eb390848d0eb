/// Names of version 0.1 with the names that replace them. Errors about an unknown name, the verb
/// `lissom migrate` and the tests of the documents all read this one table.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lissom::lua {

/// Kind of a replaced name.
enum class OldKind {
    /// A function of the module; `owner` is "lissom".
    function,
    /// A method; `owner` is the present name of its type.
    method,
    /// An option; `owner` is the present name of its function.
    option,
    /// A value of the option `owner`, "merge.fidelity".
    value,
    /// A field of a table that a function returns; `owner` is the table.
    field,
    /// A type of object; `owner` is "lissom".
    type,
};

/// One name of version 0.1.
struct OldName {
    OldKind kind;
    const char* owner;
    const char* old_name;
    const char* new_name;
    /// The call as it is written now, for messages: "deformer:add_handle(region)".
    const char* usage;
};

/// Returns all replaced names.
std::span<const OldName> old_names();

/// Returns the entry of a replaced name, or null.
const OldName* find_old_name(OldKind kind, std::string_view owner, std::string_view name);

/// Returns "; since version 0.2 write deformer:add_handle(region)", or "" if the name was never
/// one.
std::string old_name_hint(OldKind kind, std::string_view owner, std::string_view name);

}  // namespace lissom::lua
