/// Opening of files: links are followed only as far as the caller means; private to kernel/io.
#pragma once

#include <filesystem>
#include <fstream>

namespace lissom {

/// Returns the place of `name` below `folder`, with links followed: for files that others refer to,
/// and those of a folder that may have come from elsewhere, whose links lead anywhere. It need not
/// exist. Errors: unsafe_path if it is not below the folder.
std::filesystem::path path_within(const std::filesystem::path& folder,
                                  const std::filesystem::path& name);

/// Opens a file to be read; no other function of the kernel does. Errors: file_unreadable.
std::ifstream open_to_read(const std::filesystem::path& path);

}  // namespace lissom
