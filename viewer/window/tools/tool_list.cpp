#include "viewer/window/tools/tool_list.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "bindings/cli/script.h"

namespace lissom::window {

namespace fs = std::filesystem;

std::vector<std::string> shipped_tools() {
    std::vector<std::string> names;
    const std::string folder = cli::Script::shipped_scripts();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "tools", error)) {
        const std::string name = entry.path().stem().string();
        // The window does its work if no tool is in hand.
        if (entry.path().extension() == ".lua" && name != "navigate") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

namespace {

fs::path data_folder() {
    const char* const data = std::getenv("XDG_DATA_HOME");
    if (data && *data) return fs::path(data) / "lissom";
    const char* const home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".local" / "share" / "lissom" : fs::path();
}

}  // namespace

std::vector<std::string> own_tools() {
    std::vector<std::string> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(data_folder() / "tools", error)) {
        if (entry.path().extension() == ".lua") files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace lissom::window
