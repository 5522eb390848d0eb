/// Hasher: a 64-bit hash of content that is the same on every platform.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/core/numbers/bits.h"

namespace lissom {

/// Mixes 64-bit words one by one (the finalizer of splitmix64); no byte order enters.
class Hasher {
  public:
    void add(std::uint64_t word) {
        state_ = (state_ ^ word) + 0x9e3779b97f4a7c15ULL;
        state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9ULL;
        state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111ebULL;
        state_ ^= state_ >> 31;
    }
    void add(Index value) { add(std::uint64_t{static_cast<std::uint32_t>(value)}); }
    void add(bool value) { add(std::uint64_t{value}); }
    /// Every NaN counts as the same, since its payload differs between machines.
    void add(double value) {
        add(std::isnan(value) ? std::uint64_t{0x7ff8000000000000} : bits_as<std::uint64_t>(value));
    }
    void add(std::string_view text) {
        add(static_cast<std::uint64_t>(text.size()));
        for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    }
    void add(const std::string& text) { add(std::string_view(text)); }
    void add(const char* text) { add(std::string_view(text)); }
    template <typename T>
    void add(const std::vector<T>& values) {
        add(static_cast<std::uint64_t>(values.size()));
        for (const T& value : values) add(value);
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0x6c6973736f6d0001ULL;
};

}  // namespace lissom
