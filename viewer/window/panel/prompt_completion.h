/// The console's line after Tab is pressed.
#pragma once

#include <string>
#include <vector>

namespace lissom::window {

struct CompletedLine {
    std::string line;
    /// Place of the cursor in it.
    std::size_t cursor = 0;
    /// Words that may stand there, if there are several.
    std::vector<std::string> candidates = {};
};

/// Returns `line` with its word before `cursor` continued as far as all of `words` agree; `begin`
/// is the start of that word. Unchanged if there are none.
CompletedLine completed_line(const std::string& line, std::size_t cursor, std::size_t begin,
                             const std::vector<std::string>& words);

}  // namespace lissom::window
