#include "bindings/cli/file_patterns.h"

#include <algorithm>
#include <system_error>

#include "bindings/cli/scene_input.h"
#include "kernel/io/mesh_file.h"

namespace lissom::cli {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kAnyFolders = "**", kAnyName = "*";

bool has_wildcards(std::string_view name) {
    return name.find_first_of("*?") != std::string_view::npos;
}

std::string lower_case_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

bool is_mesh_path(const fs::path& file) {
    const std::vector<std::string>& known = readable_extensions();
    return std::find(known.begin(), known.end(), lower_case_extension(file)) != known.end();
}

bool is_scene_file(const fs::path& file) {
    return lower_case_extension(file) == "lissom";
}

// Bytes of the character of UTF-8 that begins `text`, which is not empty.
std::size_t character_length(std::string_view text) {
    std::size_t length = 1;
    while (length < text.size() && (static_cast<unsigned char>(text[length]) & 0xc0) == 0x80) {
        ++length;
    }
    return length;
}

// Follows the parts of a pattern from the one with the first wildcard on.
class Matcher {
  public:
    Matcher(std::vector<std::string> parts, FileKinds kinds, PatternMatches& matches)
        : parts_(std::move(parts)), kinds_(kinds), matches_(matches) {
        own_extension_ = lower_case_extension(parts_.back());
    }

    void match(const fs::path& folder, const fs::path& relative, std::size_t part) {
        const bool any_folders = parts_[part] == kAnyFolders;
        if (any_folders) match(folder, relative, part + 1);
        for (const fs::directory_entry& entry : list(folder)) {
            const fs::path name = entry.path().filename();
            std::error_code error;
            if (any_folders) {
                const bool is_hidden = name.string().starts_with('.');
                const bool enters = entry.is_directory(error) && !entry.is_symlink(error);
                if (enters && !is_hidden) match(folder / name, relative / name, part);
            } else if (!fits(name.string(), parts_[part])) {
                continue;
            } else if (part + 1 < parts_.size()) {
                if (entry.is_directory(error)) match(folder / name, relative / name, part + 1);
            } else if (entry.is_regular_file(error) && is_readable(name)) {
                matches_.files.push_back({folder / name, relative / name});
            } else if (entry.is_regular_file(error)) {
                ++matches_.passed_over;
            }
        }
    }

  private:
    static bool fits(std::string_view name, std::string_view part) {
        if (name.starts_with('.') && !part.starts_with('.')) return false;
        return matches_wildcards(name, part);
    }

    bool is_readable(const fs::path& name) const {
        const bool own = lower_case_extension(name) == own_extension_;
        return ((kinds_.meshes || own) && is_mesh_path(name)) ||
               ((kinds_.hair || own) && is_hair_path(name)) || (own && is_scene_file(name));
    }

    std::vector<fs::directory_entry> list(const fs::path& folder) {
        std::error_code error;
        std::vector<fs::directory_entry> entries;
        const fs::path listed = folder.empty() ? fs::path(".") : folder;
        for (fs::directory_iterator at(listed, error), end; !error && at != end;
             at.increment(error)) {
            entries.push_back(*at);
        }
        if (error && error != std::errc::no_such_file_or_directory) {
            matches_.unreadable_folders.push_back(listed);
        }
        return entries;
    }

    std::vector<std::string> parts_;
    std::string own_extension_;
    FileKinds kinds_;
    PatternMatches& matches_;
};

void sort_and_unite(std::vector<MatchedFile>& files) {
    const auto before = [](const MatchedFile& a, const MatchedFile& b) { return a.path < b.path; };
    const auto same = [](const MatchedFile& a, const MatchedFile& b) { return a.path == b.path; };
    std::sort(files.begin(), files.end(), before);
    files.erase(std::unique(files.begin(), files.end(), same), files.end());
}

}  // namespace

bool matches_wildcards(std::string_view name, std::string_view pattern) {
    std::size_t n = 0, p = 0;
    // Position of the last star, and the end of its match so far.
    std::size_t star = std::string_view::npos, star_end = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            star_end = n;
        } else if (p < pattern.size() && pattern[p] == '?') {
            n += character_length(name.substr(n));
            ++p;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++n;
            ++p;
        } else if (star != std::string_view::npos) {
            star_end += character_length(name.substr(star_end));
            n = star_end;
            p = star + 1;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

PatternMatches expand_pattern(const std::string& pattern, FileKinds kinds) {
    PatternMatches matches;
    std::vector<std::string> parts;
    for (const fs::path& part : fs::path(pattern)) {
        const std::string name = part.string();
        if (name.empty()) continue;
        if (parts.empty() && !has_wildcards(name)) {
            matches.base /= part;
        } else if (name != kAnyFolders || parts.empty() || parts.back() != kAnyFolders) {
            parts.push_back(name);
        }
    }
    std::error_code error;
    if (parts.empty() && !fs::is_directory(matches.base, error)) {
        matches.files.push_back({matches.base, matches.base.filename()});
        matches.base = matches.base.parent_path();
        return matches;
    }
    if (parts.empty() || parts.back() == kAnyFolders) parts.emplace_back(kAnyName);
    Matcher(std::move(parts), kinds, matches).match(matches.base, {}, 0);
    sort_and_unite(matches.files);
    return matches;
}

}  // namespace lissom::cli
