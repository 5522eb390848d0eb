/// Contexts of tests that run on several threads.
#pragma once

#include "kernel/core/context.h"

namespace lissom::test {

inline Context threads(int count) {
    ContextOptions options;
    options.threads = count;
    return Context(options);
}

}  // namespace lissom::test
