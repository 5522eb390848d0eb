/// Files as bytes: reading one whole, and replacing one whole or not at all. If the context has a
/// table of files (Context::files), that is asked instead of the system.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "kernel/core/context.h"

namespace lissom {

/// The content of a file and the memory charged for it.
struct FileContent {
    std::string bytes;
    MemoryCharge charge;
};

/// Returns the path as it appears in messages, in UTF-8.
std::string display_name(const std::filesystem::path& path);

/// Returns the text of a message about a path that does not exist: "there is no such file, did you
/// mean 'scan.obj'?", with the nearest name in its folder, or about a folder that does not exist.
std::string missing_file_text(const std::filesystem::path& path);

/// Throws if `path` is not a regular file with content. A host's table is not asked. Errors:
/// file_not_found, file_is_directory, file_empty, file_unreadable.
void require_file(const std::filesystem::path& path, const Context& context = {});

/// Bytes of a file. Errors: file_unreadable; file_too_large if no memory can hold as many.
std::size_t addressable_size(const std::filesystem::path& path);

/// Reads a file into memory, which is charged to the context first. Errors: as `require_file` and
/// `addressable_size`, file_not_found also if the host's table has none; memory_limit; cancelled.
FileContent read_file(const std::filesystem::path& path, const Context& context = {});

/// Throws if no file can be made at `path` because its folder is missing: before long work whose
/// result is to be saved there. A host's table is not asked. Errors: file_write_failed.
void require_folder_of(const std::filesystem::path& path, const Context& context = {});

/// Makes the folder `path`, and those above it, if they are missing. Errors: file_write_failed.
void make_folder(const std::filesystem::path& path);

/// Replaces the content of the file at `path`, or creates it. The bytes go to a temporary file in
/// the same folder, are flushed to the disk and then renamed, so that a reader sees the old content
/// or the new one, and no error leaves a trace. A file that exists keeps its permissions; if `path`
/// is a symbolic link, the file it points to is replaced. Temporary files of processes that were
/// killed while they wrote into the folder are removed. Errors: file_is_directory;
/// file_write_failed, also for a file that is read-only or not a regular one, and if the host's
/// table cannot write it; cancelled.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           const Context& context = {});

/// Removes the temporary files that processes left in a folder when they were killed while they
/// wrote there.
void remove_left_overs(const std::filesystem::path& folder);

}  // namespace lissom
