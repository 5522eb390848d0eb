// The growth loop for processors with AVX2.
#include "kernel/core/lanes.h"

#ifdef LISSOM_HAS_AVX2_PATH
#define LISSOM_LANES_AVX2
#include "kernel/hair/growth/lane_grower.h"

namespace lissom {

void grow_tuft_avx2(const QuadGrid& grid, const GrowthRules& rules,
                    std::span<const Seedling> seedlings, Tuft& tuft) {
    lanes_avx2::LaneGrower(grid, rules, seedlings, tuft).run();
}

}  // namespace lissom
#endif
