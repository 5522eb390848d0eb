/// Hostile scripts composed at random: callbacks, coroutines, metamethods and limits within each
/// other.
#pragma once

#include <cstdint>
#include <string>

namespace lissom::test {

/// Returns the script of a seed, always the same.
std::string composed_script(std::uint32_t seed);

}  // namespace lissom::test
