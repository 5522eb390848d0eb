/// Operations of the kernel that take memory in proportion to what they are given.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kernel/core/context.h"

namespace lissom::test {

/// What an operation makes, kept as long as it lives, and a number that tells it from another.
struct Made {
    std::shared_ptr<void> kept;
    std::uint64_t hash = 0;
};

/// Operations on inputs that were made once, in a context of their own.
struct Operation {
    const char* name;
    std::function<Made(const Context&)> run;
    /// Memory on the account over that of the heap, at the peak and of what is kept: the bounds of
    /// what a test allows.
    double min_peak = 0.75, max_peak = 4.0, min_kept = 0.8;
    /// Putting back what has failed may take more than a limit.
    bool overdraws = false;
};

const std::vector<Operation>& operations();

}  // namespace lissom::test
