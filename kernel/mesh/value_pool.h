/// ValuePool: numbers each different tuple of values once, in the order of first use; private to
/// the kernel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/numbers/bits.h"

namespace lissom {

/// A set of tuples of `Width` doubles. Tuples are equal if all values are; -0 equals 0, and a NaN
/// equals a NaN of the same bits.
template <std::size_t Width>
class ValuePool {
  public:
    using Tuple = std::array<double, Width>;

    /// Number of `values`, which are added if they are new.
    Index add(const Tuple& values) {
        if (tuples_.size() * 2 >= slots_.size()) grow();
        const Tuple key = without_negative_zero(values);
        Index& slot = find(key);
        if (slot == kNoIndex) {
            slot = count_of(tuples_);
            tuples_.push_back(key);
        }
        return slot;
    }

    /// Returns all tuples, by number.
    const std::vector<Tuple>& tuples() const { return tuples_; }

  private:
    static Tuple without_negative_zero(Tuple values) {
        for (double& value : values) value += 0.0;
        return values;
    }

    static std::uint64_t hash(const Tuple& values) {
        std::uint64_t h = 0;
        for (const double value : values) {
            h = (h ^ bits_as<std::uint64_t>(value)) * 0x9e3779b97f4a7c15u;
            h ^= h >> 32;
        }
        return h;
    }

    static bool same_bits(const Tuple& a, const Tuple& b) {
        using Bits = std::array<std::uint64_t, Width>;
        return bits_as<Bits>(a) == bits_as<Bits>(b);
    }

    // Returns the slot of `key`, or the free slot for it.
    Index& find(const Tuple& key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = hash(key) & mask;
        while (slots_[at] != kNoIndex && !same_bits(tuples_[slots_[at]], key)) at = (at + 1) & mask;
        return slots_[at];
    }

    void grow() {
        slots_.assign(slots_.empty() ? 64 : slots_.size() * 2, kNoIndex);
        for (std::size_t i = 0; i < tuples_.size(); ++i) find(tuples_[i]) = index_of(i);
    }

    std::vector<Tuple> tuples_;
    // A power of two of them, at most half of them used; the number of a tuple, or kNoIndex.
    std::vector<Index> slots_;
};

}  // namespace lissom
