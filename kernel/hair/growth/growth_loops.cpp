#include "kernel/hair/growth/growth_loops.h"

#include "kernel/hair/growth/lane_grower.h"

namespace lissom {

GrowthLoop best_growth_loop() {
    if (has_avx512()) return GrowthLoop::avx512;
    return has_avx2() ? GrowthLoop::avx2 : GrowthLoop::anywhere;
}

void grow_batch(const QuadGrid& grid, const GrowthRules& rules, std::span<const StrandSeed> seeds,
                [[maybe_unused]] GrowthLoop loop, StrandBatch& batch) {
#ifdef LISSOM_HAS_AVX2_PATH
    if (loop == GrowthLoop::avx512) return grow_batch_avx512(grid, rules, seeds, batch);
    if (loop == GrowthLoop::avx2) return grow_batch_avx2(grid, rules, seeds, batch);
#endif
    lanes_anywhere::LaneGrower(grid, rules, seeds, batch).run();
}

}  // namespace lissom
