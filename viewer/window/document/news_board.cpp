#include "viewer/window/document/news_board.h"

#include <utility>

namespace lissom::window {
namespace {

// Lines that are kept for a window that does not take them.
constexpr std::size_t kMaxLines = 10000;

}  // namespace

void NewsBoard::tell(LineKind kind, const std::string& text) {
    change([&](SessionNews& news) {
        if (news.lines.size() < kMaxLines) news.lines.push_back({kind, text});
    });
    wake();
}

void NewsBoard::show(Shown& shown) {
    const std::lock_guard lock(mutex_);
    shown.number = ++number_;
    news_.shown = shown;
}

SessionNews NewsBoard::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
}

}  // namespace lissom::window
