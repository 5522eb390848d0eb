#include "bindings/cli/test/test_files.h"

#include <algorithm>
#include <set>

#include "bindings/cli/script_text.h"
#include "kernel/core/error.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

// Whether one of the folders from the one that was named down to the file is called so.
bool is_below_scenes(const fs::path& file, const fs::path& folder) {
    const fs::path named = fs::weakly_canonical(folder).filename();
    const fs::path folders = (named / file.lexically_relative(folder)).parent_path();
    return std::find(folders.begin(), folders.end(), "scenes") != folders.end();
}

bool is_test(const fs::path& file, const fs::path& folder) {
    if (file.extension() != ".lua") return false;
    if (file.stem().string().ends_with("_test")) return true;
    return is_below_scenes(file, folder) && calls_test(script_text(file.string()).value_or(""));
}

std::vector<fs::path> tests_below(const fs::path& folder) {
    std::vector<fs::path> found;
    const auto options = fs::directory_options::skip_permission_denied;
    for (auto at = fs::recursive_directory_iterator(folder, options);
         at != fs::recursive_directory_iterator(); ++at) {
        const fs::path& path = at->path();
        const bool is_hidden = path.filename().string().starts_with('.');
        if (at->is_directory()) {
            if (is_hidden) at.disable_recursion_pending();
        } else if (!is_hidden && is_test(path, folder)) {
            found.push_back(path);
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

std::vector<fs::path> find_test_files(const std::vector<std::string>& paths) {
    std::vector<fs::path> files;
    std::set<fs::path> known;
    for (const std::string& path : paths) {
        if (!fs::exists(path)) {
            throw Error(ErrorCode::file_not_found, path + ": there is no such file or folder");
        }
        const bool is_folder = fs::is_directory(path);
        for (const fs::path& file : is_folder ? tests_below(path) : std::vector<fs::path>{path}) {
            if (known.insert(fs::weakly_canonical(file)).second)
                files.push_back(file.lexically_normal());
        }
    }
    return files;
}

}  // namespace lissom::cli
