/// The words of the command line of `lissom view`, told apart.
#pragma once

#include <string>
#include <vector>

namespace lissom::window {

/// Those of the window itself, and a script with the words that are its own.
struct ViewArguments {
    std::vector<std::string> own, scripts;
};

/// Words behind a script are the script's, but for --tool, --record and --journal with their
/// values, as two words or as one with "="; behind a "--", which is left out, those too. If no
/// script is named all words are the window's.
ViewArguments split_arguments(const std::vector<std::string>& words);

}  // namespace lissom::window
