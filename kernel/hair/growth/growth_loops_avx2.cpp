// The growth loop for processors with AVX2.
#include "kernel/core/lanes.h"

#ifdef LISSOM_HAS_AVX2_PATH
#define LISSOM_LANES_AVX2
#include "kernel/hair/growth/lane_grower.h"

namespace lissom {

void grow_batch_avx2(const QuadGrid& grid, const GrowthRules& rules,
                     std::span<const StrandSeed> seeds, StrandBatch& batch) {
    lanes_avx2::LaneGrower(grid, rules, seeds, batch).run();
}

}  // namespace lissom
#endif
