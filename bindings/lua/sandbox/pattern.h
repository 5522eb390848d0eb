/// Lua's patterns (reference manual, section 6.4.1) by a matcher that can be stopped: a pattern of
/// a few characters can keep that of Lua's own library busy for hours, in one call that no hook
/// sees.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "bindings/lua/sandbox/stop.h"

namespace lissom::lua {

/// A pattern that is none, or nests too deep.
struct PatternError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Part of the text; a position if `length` is kPosition.
struct Capture {
    static constexpr std::size_t kOpen = static_cast<std::size_t>(-1), kPosition = kOpen - 1;

    std::size_t begin = 0, length = kOpen;
};

class Matcher {
  public:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    static constexpr int kMaximumCaptures = 32;

    /// `text` and `pattern` (without the leading '^') outlive the matcher.
    Matcher(std::string_view text, std::string_view pattern, const Stop& stop)
        : text_(text), pattern_(pattern), stop_(stop) {}

    /// Returns the end of the match that begins at `begin`, or kNone. Fills the captures. Throws
    /// PatternError; Stopped.
    std::size_t match_at(std::size_t begin);

    int capture_count() const { return count_; }
    /// Returns capture `i`; throws PatternError if it was opened and not closed.
    const Capture& capture(int i) const;

  private:
    static constexpr std::size_t kLongest = 1 << 20;

    void tick(std::size_t characters);
    std::size_t match(std::size_t s, std::size_t p);
    std::optional<std::size_t> step(std::size_t& s, std::size_t& p);
    std::optional<std::size_t> step_frontier(std::size_t s, std::size_t& p) const;
    std::optional<std::size_t> step_part(std::size_t& s, std::size_t& p, char kind) const;
    std::optional<std::size_t> step_characters(std::size_t& s, std::size_t& p);
    std::size_t open(std::size_t s, std::size_t p, std::size_t length);
    std::size_t close(std::size_t s, std::size_t p);
    std::size_t balanced(std::size_t s, std::size_t p) const;
    bool at_frontier(std::size_t s, std::size_t set) const;
    std::size_t repeated(std::size_t s, char digit) const;
    std::size_t longest(std::size_t s, std::size_t p, std::size_t after, bool once);
    std::size_t shortest(std::size_t s, std::size_t p, std::size_t after);
    std::size_t item_end(std::size_t p) const;
    std::size_t set_end(std::size_t p) const;
    bool fits(std::size_t s, std::size_t p, std::size_t after);
    bool is_in_set(unsigned char c, std::size_t p, std::size_t end) const;

    std::string_view text_, pattern_;
    const Stop& stop_;
    std::array<Capture, kMaximumCaptures> captures_;
    int count_ = 0, depth_ = 0;
    unsigned ticks_ = 0;
};

/// Whether a pattern means itself: it has no character with a meaning of its own.
bool is_plain(std::string_view pattern);

/// Returns the first place of `part` in `text` from `begin` on, or Matcher::kNone. Throws Stopped.
std::size_t find_plain(std::string_view text, std::string_view part, std::size_t begin,
                       const Stop& stop);

}  // namespace lissom::lua
