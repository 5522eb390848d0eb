/// Checks of the options of generated meshes; private to kernel/mesh.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "kernel/core/error.h"
#include "kernel/core/index.h"

namespace lissom {

/// Errors: invalid_argument, naming the option, unless `value` is finite and above 0.
inline void require_length(double value, const char* option) {
    if (value > 0.0 && std::isfinite(value)) return;
    throw Error(ErrorCode::invalid_argument,
                std::string(option) + " must be a finite length above 0");
}

/// Errors: invalid_argument, naming the option, if `value` is below `least`.
inline void require_at_least(Index value, Index least, const char* option) {
    if (value >= least) return;
    throw Error(ErrorCode::invalid_argument, std::string(option) + " must be at least " +
                                                 std::to_string(least) + ", not " +
                                                 std::to_string(value));
}

/// Errors: out_of_range if `faces` quads have more corners than can be numbered.
inline void require_countable(std::int64_t faces) {
    if (faces <= std::numeric_limits<Index>::max() / 8) return;
    throw Error(ErrorCode::out_of_range,
                "the shape would have more faces than can be numbered; use fewer segments");
}

}  // namespace lissom
