#include "kernel/io/stream/line_finding.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lissom {

void LineFinding::add(std::size_t line) {
    constexpr std::size_t kLargest = std::numeric_limits<Index>::max();
    ++count_;
    const auto number = index_of(std::min(line, kLargest));
    if (lines_.empty() || lines_.back() != number) lines_.push_back(number);
}

void LineFinding::finish(Report& report, FindingKind kind, const std::string& what) {
    if (count_ == 0) return;
    std::sort(lines_.begin(), lines_.end());
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
    Elements lines{ElementKind::line, 0, {}};
    for (const Index line : lines_) lines.add(line);
    std::string message = what + " on " + describe(lines, 1);
    report.add({kind, ElementKind::line, true, count_, std::move(lines_), std::move(message)});
}

}  // namespace lissom
