#include "viewer/window/panel/prompt_completion.h"

#include <algorithm>

namespace lissom::window {
namespace {

std::string common_beginning(const std::vector<std::string>& words) {
    std::string common = words.front();
    for (const std::string& word : words) {
        const auto [end, other] =
            std::mismatch(common.begin(), common.end(), word.begin(), word.end());
        common.erase(end, common.end());
    }
    return common;
}

}  // namespace

CompletedLine completed_line(const std::string& line, std::size_t cursor, std::size_t begin,
                             const std::vector<std::string>& words) {
    if (words.empty() || begin > cursor || cursor > line.size()) return {line, cursor};
    const std::string word = common_beginning(words);
    CompletedLine result{line.substr(0, begin) + word + line.substr(cursor), begin + word.size()};
    if (words.size() > 1) result.candidates = words;
    return result;
}

}  // namespace lissom::window
