// The loop of strands that follow for processors with AVX-512.
#include "kernel/core/lanes.h"

#ifdef LISSOM_HAS_AVX2_PATH
#define LISSOM_LANES_AVX512
#include "kernel/hair/follow/path_lanes.h"

namespace lissom {

void move_lanes_avx512(const PathBlock& block, PathRow* steps) {
    lanes_avx512::move_lanes(block, steps);
}

}  // namespace lissom
#endif
