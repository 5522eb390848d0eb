/// Ticker: progress of loops over many elements; private to kernel/io.
#pragma once

#include <cstddef>

#include "kernel/core/context.h"

namespace lissom {

/// Reports progress and looks for a cancel, once every so many elements.
class Ticker {
  public:
    explicit Ticker(Progress& progress) : progress_(progress) {}

    /// Call once an element; `fraction()` returns the fraction done.
    template <typename Fraction>
    void tick(const Fraction& fraction) {
        constexpr std::size_t kEvery = 1 << 14;
        if (++count_ % kEvery == 0) progress_.update(fraction());
    }

  private:
    Progress& progress_;
    std::size_t count_ = 0;
};

}  // namespace lissom
