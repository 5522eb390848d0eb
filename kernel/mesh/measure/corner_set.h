/// A set of numbers below a limit with a search for the next one; private to the kernel.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/core/index.h"

namespace lissom {

/// Bits, and for each 64 of them a bit on the level above that tells if one of them is set. It
/// keeps its memory from one limit to the next.
class CornerSet {
  public:
    /// Takes the numbers below `limit`, all or none of them.
    void assign(Index limit, bool all) {
        std::size_t levels = 1;
        for (Index size = limit; size > 64; size = (size + 63) / 64) ++levels;
        levels_.resize(levels);
        Index size = limit;
        for (auto& level : levels_) {
            level.assign(at((size + 63) / 64), 0);
            size = (size + 63) / 64;
        }
        for (Index i = 0; all && i < limit; ++i) insert(i);
    }

    void insert(Index i) {
        for (auto& level : levels_) {
            level[at(i / 64)] |= bit(i);
            i /= 64;
        }
    }

    void erase(Index i) {
        for (auto& level : levels_) {
            level[at(i / 64)] &= ~bit(i);
            if (level[at(i / 64)] != 0) return;
            i /= 64;
        }
    }

    void set(Index i, bool member) { member ? insert(i) : erase(i); }

    bool contains(Index i) const { return (levels_[0][at(i / 64)] & bit(i)) != 0; }

    /// Returns the least number that is at least `i`, or the least of all if there is none, or
    /// kNoIndex if the set is empty.
    Index next_around(Index i) const {
        const Index found = next(i);
        return found == kNoIndex ? next(0) : found;
    }

  private:
    static std::uint64_t bit(Index i) { return std::uint64_t{1} << (i % 64); }

    Index next(Index i) const {
        for (std::size_t level = 0; level < levels_.size(); ++level) {
            if (at(i / 64) >= levels_[level].size()) return kNoIndex;
            const std::uint64_t rest = levels_[level][at(i / 64)] & (~std::uint64_t{0} << (i % 64));
            if (rest != 0) return descend(level, i / 64 * 64 + std::countr_zero(rest));
            i = i / 64 + 1;
        }
        return kNoIndex;
    }

    Index descend(std::size_t level, Index i) const {
        while (level-- > 0) i = i * 64 + std::countr_zero(levels_[level][at(i)]);
        return i;
    }

    std::vector<std::vector<std::uint64_t>> levels_;
};

}  // namespace lissom
