/// Random numbers that belong to a seed and an id: the same for any order of strands, any number of
/// threads and on every machine.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "kernel/core/geometry.h"

namespace lissom {

/// Scrambles 64 bits (SplitMix64, Steele et al. 2014).
inline std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Scrambles a seed and an id; `stream` tells the uses of one seed apart.
inline std::uint64_t mixed(std::uint64_t seed, std::uint64_t id, std::uint64_t stream = 0) {
    return mixed(mixed(mixed(seed) ^ id) ^ stream);
}

/// Evenly distributed in [-1, 1).
inline double signed_random(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-52 - 1.0;
}

/// Each coordinate evenly distributed in [-1, 1).
inline Vec3 random_vector(std::uint64_t seed, std::uint64_t id, std::uint64_t stream = 0) {
    const std::uint64_t bits = mixed(seed, id, stream);
    return {signed_random(bits), signed_random(mixed(bits)), signed_random(mixed(bits + 1))};
}

}  // namespace lissom
