/// Paths of a host; private to bindings/c.
#pragma once

#include <filesystem>
#include <string>

namespace lissom::c {

/// Returns a path of UTF-8.
std::filesystem::path path_of(const std::string& text);

}  // namespace lissom::c
