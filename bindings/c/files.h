/// Files through the host's functions where it has given any; private to bindings/c.
#pragma once

#include <filesystem>
#include <string>

#include "bindings/c/context.h"

namespace lissom::c {

/// Whether the host opens files by itself.
inline bool reads_files(const lissom_context& context) {
    return context.options.read_file;
}
inline bool writes_files(const lissom_context& context) {
    return context.options.write_file;
}

/// The content of a file that the host reads. Errors: file_not_found.
std::string read_by_host(const lissom_context& context, const std::string& path);
/// Errors: file_write_failed.
void write_by_host(const lissom_context& context, const std::string& path,
                   const std::string& bytes);

/// A path of UTF-8, and what stands behind its last dot.
std::filesystem::path path_of(const std::string& text);
std::string extension_of(const std::string& path);

}  // namespace lissom::c
