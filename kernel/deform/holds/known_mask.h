/// Masks of positions and gradients given by constraints; private to kernel/deform.
#pragma once

#include <vector>

namespace lissom {

/// Known values of every local vertex. A vertex whose gradient is not needed has it neither known
/// nor wanted: far outside, or without faces.
struct KnownMask {
    std::vector<char> position, gradient, gradient_wanted;
};

}  // namespace lissom
