#include "viewer/window/screen/fill.h"

#include <algorithm>
#include <cmath>

namespace lissom::window {
namespace {

constexpr Index kLeast = 25;
// Times as many strands as the last time, at most.
constexpr double kGrowth = 2.0;
// A picture has so many times the strands of the one before, or as many as take this many seconds.
constexpr Index kFiner = 5;
constexpr double kMoment = 0.25;
// Times as many strands as are seen already that are worth a picture.
constexpr double kHardlyFiner = 2.0;

}  // namespace

void StrandPace::add(Index drawn, double seconds) {
    if (drawn <= 0) return;
    const double rate = drawn / std::max(seconds, 1e-7);
    // Slowing down counts at once, speeding up only as far as growth allows.
    rate_ = rate_ == 0.0 ? rate : std::min(rate, 0.5 * (rate_ + rate));
    const double wanted = std::min(rate * aim_, kGrowth * std::max(drawn, count_));
    count_ = std::max(static_cast<Index>(std::min(wanted, 1e9)), kLeast);
}

// How many strands the next picture has; 0 for none.
Index Fill::next_picture(const StrandPace& pace) const {
    const double finer = 1.0 * kFiner * std::max(shown_, kLeast);
    const double wanted = std::max(finer, pace.rate() * kMoment);
    // The last picture but one would be hardly another.
    const double of = wanted > 0.5 * all_ ? all_ : wanted;
    const double most = pace.rate() > 0.0 ? pace.rate() * longest_ : of;
    // One picture is drawn in any case: its edges are smooth, and its light is better.
    if (slice_.of == 0) return static_cast<Index>(std::min(of, std::max(most, finer)));
    if (of > most && most < kHardlyFiner * shown_) return 0;
    return static_cast<Index>(std::min(of, most));
}

std::optional<Slice> Fill::next(const StrandPace& pace) {
    if (slice_.end == slice_.of) {
        const Index of = slice_.of < all_ ? next_picture(pace) : 0;
        if (of == 0) return std::nullopt;
        slice_ = {0, 0, of};
    }
    slice_ = {slice_.end, std::min(slice_.end + pace.count(), slice_.of), slice_.of};
    return slice_;
}

void Fill::drawn() {
    if (slice_.is_last()) shown_ = slice_.of;
}

}  // namespace lissom::window
