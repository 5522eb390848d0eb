/// The evaluator of bases as a C99 compiler builds it, for tests that compare it with the same in
/// C++.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Opens the basis in `bytes` and returns the status; on success also writes the first `count`
/// vertices from `first` on.
int evaluate_in_c(const void* bytes, size_t size, const double* transforms, size_t handle_count,
                  uint32_t first, uint32_t count, float* out);

/// Opens hair and rebuilds its first `count` strands at rest; returns the status.
int rebuild_in_c(const void* bytes, size_t size, uint32_t count, float* out);

#ifdef __cplusplus
}
#endif
