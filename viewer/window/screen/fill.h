/// Fill: draws many strands in slices that measure themselves, so that its caller can look for
/// events in between. Knows nothing of OpenGL or of clocks.
#pragma once

#include <optional>

#include "kernel/core/index.h"

namespace lissom::window {

/// Number of strands that fit into a time, by the time that the last ones took.
class StrandPace {
  public:
    /// Aims at `aim` seconds, and begins with `first` strands.
    explicit StrandPace(double aim, Index first = 300) : aim_(aim), count_(first) {}

    /// Those it begins with, then as many as take so long; never many times more than the last
    /// time.
    Index count() const { return count_; }
    /// Strands in a second, as far as it is known.
    double rate() const { return rate_; }
    /// So many took so long.
    void add(Index drawn, double seconds);

  private:
    double aim_;
    Index count_;
    double rate_ = 0.0;
};

/// Strands of one picture that are drawn at one time: from the `begin`-th to before the `end`-th of
/// the `of` that the picture has.
struct Slice {
    Index begin = 0, end = 0, of = 0;

    bool is_first() const { return begin == 0; }
    bool is_last() const { return end == of; }
};

/// Pictures of more and more strands until one has all of them: as many as a fast driver draws in a
/// moment, or a few times as many as the one before.
class Fill {
  public:
    /// A few, `shown` of `all` strands, are seen already. A picture has no more strands than are
    /// drawn in `longest` seconds, but the first one, which is always drawn.
    Fill(Index all, Index shown, double longest) : all_(all), shown_(shown), longest_(longest) {}

    /// Returns the next slice, given the pace so far; nothing when all is done.
    std::optional<Slice> next(const StrandPace& pace);
    /// The last slice was drawn.
    void drawn();

  private:
    Index next_picture(const StrandPace& pace) const;

    Index all_, shown_;
    double longest_;
    Slice slice_;
};

}  // namespace lissom::window
