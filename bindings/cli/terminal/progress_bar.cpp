#include "bindings/cli/terminal/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace lissom::cli {

ProgressBar::ProgressBar(std::ostream& out, std::function<Clock::time_point()> now)
    : out_(out), now_(std::move(now)) {}

void ProgressBar::show(std::string_view label, double fraction) {
    const Clock::time_point now = now_();
    if (!working_) {
        working_ = true;
        begin_ = now;
        return;
    }
    if (now - begin_ < kPatience || (visible_ && now - shown_ < kInterval)) return;
    constexpr int kWidth = 30;
    const double part = std::clamp(fraction, 0.0, 1.0);
    const std::size_t filled = std::lround(part * kWidth);
    const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
    const std::string percent = std::to_string(std::lround(100.0 * part));
    out_ << "\r[" << bar << "] " << std::string(3 - percent.size(), ' ') << percent << " % "
         << label << "\x1b[K" << std::flush;
    visible_ = true;
    shown_ = now;
}

void ProgressBar::clear() {
    if (visible_) out_ << "\r\x1b[K" << std::flush;
    working_ = visible_ = false;
}

}  // namespace lissom::cli
