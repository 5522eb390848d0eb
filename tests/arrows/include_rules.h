/// Who may include whom: the dependency rules of the source tree as a table, and the check of one
/// file against it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lissom::test {

/// The messages, one a violation, for the file at `path` (relative to the root, with forward
/// slashes) with the text `source`; empty where it keeps the rules.
///
/// - A project header is included in quotes by its path from the root, and only from folders that
///   the including folder may know: modules by their table, rooms of one module in their order.
/// - A third-party header is included only in the folders that own the library. Headers of the
///   kernel are installed and include no library but Eigen; those of kernel/io/gltf are not
///   installed.
/// - A header opens with a docstring, followed by `#pragma once`.
std::vector<std::string> include_violations(std::string_view path, std::string_view source);

/// Project headers that `source` includes, as written between the quotes.
std::vector<std::string> quoted_includes(std::string_view source);

/// The modules that files of `module` may include, from the lowest, without itself.
std::vector<std::string_view> known_modules(std::string_view module);

/// The rooms of a module in their order: folders, the module's own among them, and single files
/// without their extension.
std::vector<std::string_view> rooms_of(std::string_view module);

}  // namespace lissom::test
