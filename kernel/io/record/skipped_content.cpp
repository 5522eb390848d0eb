#include "kernel/io/record/skipped_content.h"

namespace lissom {
namespace {

constexpr std::size_t kMaximumNames = 100;
constexpr std::string_view kOthers = "others";

}  // namespace

void SkippedContent::add(std::string_view what, std::size_t count) {
    if (count == 0) return;
    auto found = counts_.find(what);
    if (found == counts_.end()) {
        const bool is_full = counts_.size() >= kMaximumNames;
        found = counts_.try_emplace(std::string(is_full ? kOthers : what), 0).first;
    }
    found->second += count;
}

void SkippedContent::finish(Report& report) const {
    constexpr std::size_t kShown = 10;
    if (empty()) return;
    std::string list;
    std::size_t total = 0, shown = 0;
    for (const auto& [what, count] : counts_) {
        total += count;
        if (++shown > kShown) continue;
        list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    }
    if (shown > kShown) list += ", ...";
    report.add(FindingKind::content_skipped, total, std::move(list));
}

}  // namespace lissom
