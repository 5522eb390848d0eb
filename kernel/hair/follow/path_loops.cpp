#include "kernel/hair/follow/path_loops.h"

#include <cstddef>
#include <cstring>

#include "kernel/hair/follow/path_lanes.h"

namespace lissom {
namespace {

constexpr std::size_t kPointBytes = 3 * sizeof(float);

void write_strand(const PathRow* rows, int lane, int count, float* out) {
    for (int k = 0; k < count; ++k, out += 3) {
        out[0] = rows[k].x[lane];
        out[1] = rows[k].y[lane];
        out[2] = rows[k].z[lane];
    }
}

#ifdef LISSOM_HAS_SHUFFLES
constexpr int kQuad = 4;
using Quad = float __attribute__((vector_size(kQuad * sizeof(float))));

// Writes whole points of four strands. Each goes with a fourth number, which the next point or
// strand replaces; the last goes without.
void write_quad(const PathRow* rows, int first, int count, float* const out[kQuad]) {
    for (int k = 0; k < count; ++k) {
        Quad x, y, z;
        std::memcpy(&x, rows[k].x + first, sizeof(Quad));
        std::memcpy(&y, rows[k].y + first, sizeof(Quad));
        std::memcpy(&z, rows[k].z + first, sizeof(Quad));
        const Quad low = __builtin_shufflevector(x, y, 0, 4, 1, 5);
        const Quad high = __builtin_shufflevector(x, y, 2, 6, 3, 7);
        const Quad points[kQuad] = {__builtin_shufflevector(low, z, 0, 1, 4, 4),
                                    __builtin_shufflevector(low, z, 2, 3, 5, 5),
                                    __builtin_shufflevector(high, z, 0, 1, 6, 6),
                                    __builtin_shufflevector(high, z, 2, 3, 7, 7)};
        const std::size_t place = 3 * static_cast<std::size_t>(k);
        if (k + 1 < count) {
            for (int i = 0; i < kQuad; ++i) std::memcpy(out[i] + place, &points[i], sizeof(Quad));
        } else {
            for (int i = 0; i < kQuad; ++i) std::memcpy(out[i] + place, &points[i], kPointBytes);
        }
    }
}

bool is_whole_quad(const PathStrands& strands, int first) {
    for (int i = first; i < first + kQuad; ++i) {
        if (i >= strands.count || strands.points[i] != strands.rows) return false;
    }
    return true;
}
#endif

void write_points(const PathBlock& block, const PathRow* rows) {
    const PathStrands& strands = *block.strands;
    int i = 0;
#ifdef LISSOM_HAS_SHUFFLES
    for (; i < strands.count && is_whole_quad(strands, i); i += kQuad) {
        float* out[kQuad];
        for (int k = 0; k < kQuad; ++k) out[k] = block.made + strands.made[i + k];
        write_quad(rows, i, strands.rows, out);
    }
#endif
    for (; i < strands.count; ++i) {
        write_strand(rows, i, strands.points[i], block.made + strands.made[i]);
    }
}

// Fetches the memory of results while the block is moved.
LISSOM_INLINE void fetch_results([[maybe_unused]] const PathBlock& block) {
#if defined(__GNUC__)
    constexpr int kLineNumbers = 16;
    for (int i = 0; i < block.strands->count; ++i) {
        const float* const first = block.made + block.strands->made[i];
        const int last = 3 * block.strands->points[i];
        for (int k = 0; k < last; k += kLineNumbers) __builtin_prefetch(first + k, 1);
        __builtin_prefetch(first + last - 1, 1);
    }
#endif
}

}  // namespace

void move_block(const PathBlock& block, PathRow* steps) {
    fetch_results(block);
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx512()) {
        move_lanes_avx512(block, steps);
    } else if (has_avx2()) {
        move_lanes_avx2(block, steps);
    } else {
        lanes_anywhere::move_lanes(block, steps);
    }
#else
    lanes_anywhere::move_lanes(block, steps);
#endif
    write_points(block, steps);
}

}  // namespace lissom
