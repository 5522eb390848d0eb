/// What the console's line becomes when Tab is pressed.
#pragma once

#include <string>
#include <vector>

namespace lissom::window {

struct CompletedLine {
    std::string line;
    /// Where the cursor is in it.
    std::size_t cursor = 0;
    /// Words that may stand there, where there are several.
    std::vector<std::string> candidates = {};
};

/// `line` with its word before `cursor` continued as far as all of `words` agree; `begin` is where
/// that word begins. Unchanged where there are none.
CompletedLine completed_line(const std::string& line, std::size_t cursor, std::size_t begin,
                             const std::vector<std::string>& words);

}  // namespace lissom::window
