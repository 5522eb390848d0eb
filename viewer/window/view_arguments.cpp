#include "viewer/window/view_arguments.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "viewer/window/session/session.h"

namespace lissom::window {
namespace {

constexpr std::array<std::string_view, 3> kToolOptions{"--tool", "--record", "--journal"};

// Options that may be given the name of a script.
bool takes_value(std::string_view word) {
    return std::find(kToolOptions.begin(), kToolOptions.end(), word) != kToolOptions.end();
}

// Whether it is one of these with its value, as in --tool=select.
bool has_value(std::string_view word) {
    const std::size_t end = word.find('=');
    return end != std::string_view::npos && takes_value(word.substr(0, end));
}

}  // namespace

ViewArguments split_arguments(const std::vector<std::string>& words) {
    ViewArguments result;
    bool behind = false, all = false, is_value = false;
    for (const std::string& word : words) {
        if (behind && !all && !is_value && word == "--") {
            all = true;
            continue;
        }
        const bool of_tools = !all && (is_value || takes_value(word) || has_value(word));
        (behind && !of_tools ? result.scripts : result.own).push_back(word);
        behind = behind || (!is_value && is_script(word) && !is_recording(word));
        is_value = !all && !is_value && takes_value(word);
    }
    return result;
}

}  // namespace lissom::window
