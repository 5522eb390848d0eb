/// Patterns that name many files of meshes, hair or scenes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lissom::cli {

/// Returns whether `name` fits `pattern`, in which `*` stands for any characters and `?` for one.
bool matches_wildcards(std::string_view name, std::string_view pattern);

/// A file that a pattern names.
struct MatchedFile {
    std::filesystem::path path;
    /// The same from the last folder that the pattern names without wildcards.
    std::filesystem::path relative;
};

/// Kinds of files that a pattern finds if its own extension names none.
struct FileKinds {
    bool meshes = true, hair = true;
};

/// Files that a pattern names, sorted by path.
struct PatternMatches {
    std::vector<MatchedFile> files;
    /// Number of files whose names fit and whose extensions do not.
    std::size_t passed_over = 0;
    /// Folders that could not be listed.
    std::vector<std::filesystem::path> unreadable_folders;
    /// The last folder that the pattern names without wildcards.
    std::filesystem::path base;
};

/// Expands a pattern: wildcards `*` and `?` in the names of folders and files, and `**` for any
/// folders, none included. They pass over hidden files, unless the pattern's name begins with a
/// dot, and over files whose extension names no format of `kinds`, unless it is the pattern's own
/// and names a format of meshes or hair, or a scene. A folder names the files in it. Anything else
/// names one file, whether it exists or not.
PatternMatches expand_pattern(const std::string& pattern, FileKinds kinds = {});

}  // namespace lissom::cli
