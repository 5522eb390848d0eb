// The loop of strands that follow for processors with AVX2.
#include "kernel/core/lanes.h"

#ifdef LISSOM_HAS_AVX2_PATH
#define LISSOM_LANES_AVX2
#include "kernel/hair/follow/path_lanes.h"

namespace lissom {

void move_lanes_avx2(const PathBlock& block, PathRow* steps) {
    lanes_avx2::move_lanes(block, steps);
}

}  // namespace lissom
#endif
