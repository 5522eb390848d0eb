#include "viewer/window/session/session_news.h"

#include <cctype>
#include <utility>

namespace lissom::window {
namespace {

std::string without_digits(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return text;
}

}  // namespace

void add_line(std::vector<ConsoleLine>& lines, ConsoleLine line) {
    const bool repeats = !lines.empty() && line.kind == LineKind::warning &&
                         lines.back().kind == line.kind &&
                         without_digits(lines.back().text) == without_digits(line.text);
    if (repeats) {
        line.times += lines.back().times;
        lines.back() = std::move(line);
    } else {
        lines.push_back(std::move(line));
    }
}

}  // namespace lissom::window
