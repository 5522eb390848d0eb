/// Folders whose files belong together: replacing several of them at once or none.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/io/stream/file.h"

namespace lissom {

/// Names are relative to the folder, with '/' between them.
struct FolderChange {
    /// The files that the folder has afterwards, with their bytes.
    std::map<std::string, std::string> files;
    /// The files that it had: only these are replaced, and those without a new content removed.
    std::set<std::string> before;
};

/// Makes the change: readers by `read_from_folder` see all files as they were or all as they are
/// afterwards, even if this process is killed at any time. New contents are written beside the old
/// ones and take their names only once all of them are on the disk; files whose content stays are
/// not touched, and neither are files of others. A missing folder is made; the one above it is
/// there. Errors: file_write_failed, naming the file, also if one stands in the way that is not in
/// `before`; cancelled. The folder is then as it was.
void replace_in_folder(const std::filesystem::path& folder, const FolderChange& change,
                       const Context& context = {});

/// Errors: as `read_file`; unsafe_path if a link leads out of the folder.
FileContent read_from_folder(const std::filesystem::path& folder, const std::string& name,
                             const Context& context = {});

/// Returns whether the folder has this file, as `read_from_folder` sees it.
bool has_in_folder(const std::filesystem::path& folder, const std::string& name);

}  // namespace lissom
