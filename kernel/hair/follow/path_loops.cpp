#include "kernel/hair/follow/path_loops.h"

#include <cmath>
#include <cstddef>

#include "kernel/core/lanes.h"

// Each loop over lanes becomes vector instructions, unless gcc has unrolled it before.
#if defined(__GNUC__) && !defined(__clang__)
#define LISSOM_EACH_LANE _Pragma("GCC unroll 1") for (int i = 0; i < kPathLanes; ++i)
#else
#define LISSOM_EACH_LANE for (int i = 0; i < kPathLanes; ++i)
#endif

namespace lissom {
namespace {

// Parts of segments' lengths that tips may have at least before all segments shrink alike.
constexpr float kLeastTip = 0.25f, kMostTip = 4.0f;

// Places and lengths of the strands of a block.
struct PathLanes {
    float first[3][kPathLanes], target[3][kPathLanes], before[3][kPathLanes];
    float have[kPathLanes], weighted[kPathLanes], per_total[kPathLanes];
    // Factors of segments: base + slope * arc^2.
    float base[kPathLanes], slope[kPathLanes];
};

// Moves points by the motions of the knots around each.
LISSOM_INLINE void take_motions(const PathBlock& block, const PathRow& row, const PathRange& range,
                                PathLanes& lanes) {
    float knot[kPathLanes], local[3][kPathLanes];
    LISSOM_EACH_LANE {
        const float place = row.arc[i] * block.per_metre;
        knot[i] = place < block.last_knot ? place : block.last_knot;
        local[0][i] = row.x[i] - block.origin[0];
        local[1][i] = row.y[i] - block.origin[1];
        local[2][i] = row.z[i] - block.origin[2];
        lanes.target[0][i] = row.x[i];
        lanes.target[1][i] = row.y[i];
        lanes.target[2][i] = row.z[i];
    }
    for (int j = range.low; j <= range.high; ++j) {
        const float* const m = block.knots + 16 * static_cast<std::size_t>(j);
        const auto at_knot = static_cast<float>(j);
        LISSOM_EACH_LANE {
            const float near = 1.0f - std::abs(knot[i] - at_knot);
            const float part = near > 0.0f ? near : 0.0f;
            const float x = local[0][i], y = local[1][i], z = local[2][i];
            lanes.target[0][i] += part * (m[0] * x + m[4] * y + m[8] * z + m[12]);
            lanes.target[1][i] += part * (m[1] * x + m[5] * y + m[9] * z + m[13]);
            lanes.target[2][i] += part * (m[2] * x + m[6] * y + m[10] * z + m[14]);
        }
    }
}

// Near the root points turn with the skin.
LISSOM_INLINE void turn_with_root(const PathBlock& block, const PathRow& row, PathLanes& lanes) {
    const float* const m = block.turn;
    LISSOM_EACH_LANE {
        const float way = row.arc[i] * block.per_ramp, v = way < 1.0f ? way : 1.0f;
        const float w = 1.0f - v * v * (3.0f - 2.0f * v);
        const float x = row.x[i] - lanes.first[0][i], y = row.y[i] - lanes.first[1][i],
                    z = row.z[i] - lanes.first[2][i];
        float* const target[3] = {lanes.target[0], lanes.target[1], lanes.target[2]};
        const float at[3] = {block.roots[0][i] + (m[0] * x + m[3] * y + m[6] * z),
                             block.roots[1][i] + (m[1] * x + m[4] * y + m[7] * z),
                             block.roots[2][i] + (m[2] * x + m[5] * y + m[8] * z)};
        target[0][i] += w * (at[0] - target[0][i]);
        target[1][i] += w * (at[1] - target[1][i]);
        target[2][i] += w * (at[2] - target[2][i]);
    }
}

// The step from the point before to this one.
LISSOM_INLINE void take_step(const PathRow& row, PathLanes& lanes, PathRow& step) {
    LISSOM_EACH_LANE {
        const float x = lanes.target[0][i] - lanes.before[0][i],
                    y = lanes.target[1][i] - lanes.before[1][i],
                    z = lanes.target[2][i] - lanes.before[2][i];
        lanes.before[0][i] = lanes.target[0][i];
        lanes.before[1][i] = lanes.target[1][i];
        lanes.before[2][i] = lanes.target[2][i];
        step.x[i] = x;
        step.y[i] = y;
        step.z[i] = z;
        const float size = std::sqrt(x * x + y * y + z * z), t = row.arc[i] * lanes.per_total[i];
        lanes.have[i] += size;
        lanes.weighted[i] += size * t * t;
    }
}

// The factors that give strands their lengths.
LISSOM_INLINE void fit_lengths(const PathBlock& block, PathLanes& lanes) {
    LISSOM_EACH_LANE {
        const float want = block.scale * block.strands->total[i];
        const float change =
            lanes.weighted[i] > 0.0f ? (want - lanes.have[i]) / lanes.weighted[i] : 0.0f;
        const bool is_even = !(1.0f + change > kLeastTip && 1.0f + change < kMostTip);
        lanes.base[i] = is_even && lanes.have[i] > 0.0f ? want / lanes.have[i] : 1.0f;
        lanes.slope[i] = is_even ? 0.0f : change * lanes.per_total[i] * lanes.per_total[i];
    }
}

// Steps become points.
LISSOM_INLINE void make_points(const PathBlock& block, PathRow* rows, const PathLanes& lanes) {
    LISSOM_EACH_LANE {
        rows[0].x[i] = block.roots[0][i];
        rows[0].y[i] = block.roots[1][i];
        rows[0].z[i] = block.roots[2][i];
    }
    for (int k = 1; k < block.strands->rows; ++k) {
        LISSOM_EACH_LANE {
            const float arc = block.rows[k].arc[i];
            const float factor = lanes.base[i] + lanes.slope[i] * arc * arc;
            rows[k].x[i] = rows[k - 1].x[i] + factor * rows[k].x[i];
            rows[k].y[i] = rows[k - 1].y[i] + factor * rows[k].y[i];
            rows[k].z[i] = rows[k - 1].z[i] + factor * rows[k].z[i];
        }
    }
}

void write_points(const PathBlock& block, const PathRow* rows) {
    for (int i = 0; i < block.strands->count; ++i) {
        float* out = block.made + block.strands->made[i];
        const int last = block.strands->points[i];
        for (int k = 0; k < last; ++k, out += 3) {
            out[0] = rows[k].x[i];
            out[1] = rows[k].y[i];
            out[2] = rows[k].z[i];
        }
    }
}

// Rows of the next block come from memory while this one is moved.
LISSOM_INLINE void fetch_ahead([[maybe_unused]] const PathRow* row) {
#if defined(__GNUC__)
    constexpr std::uintptr_t kAhead = 20 * sizeof(PathRow), kLine = 64;
    const auto place = reinterpret_cast<std::uintptr_t>(row) + kAhead;
    __builtin_prefetch(reinterpret_cast<const void*>(place));
    __builtin_prefetch(reinterpret_cast<const void*>(place + kLine));
#endif
}

LISSOM_INLINE void move_all(const PathBlock& block, PathRow* steps) {
    PathLanes lanes;
    const PathRow& root = block.rows[0];
    LISSOM_EACH_LANE {
        lanes.first[0][i] = root.x[i];
        lanes.first[1][i] = root.y[i];
        lanes.first[2][i] = root.z[i];
        for (int c = 0; c < 3; ++c) lanes.before[c][i] = block.roots[c][i];
        lanes.have[i] = lanes.weighted[i] = 0.0f;
        lanes.per_total[i] = 1.0f / block.strands->total[i];
    }
    for (int k = 1; k < block.strands->rows; ++k) {
        fetch_ahead(block.rows + k);
        take_motions(block, block.rows[k], block.ranges[k], lanes);
        if (block.ranges[k].in_ramp) turn_with_root(block, block.rows[k], lanes);
        take_step(block.rows[k], lanes, steps[k]);
    }
    fit_lengths(block, lanes);
    make_points(block, steps, lanes);
}

#ifdef LISSOM_HAS_AVX2_PATH
// Without fused instructions, which round otherwise.
__attribute__((target("avx2"))) void move_all_avx2(const PathBlock& block, PathRow* steps) {
    move_all(block, steps);
}
#endif

}  // namespace

void move_block(const PathBlock& block, PathRow* steps) {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) {
        move_all_avx2(block, steps);
        return write_points(block, steps);
    }
#endif
    move_all(block, steps);
    write_points(block, steps);
}

}  // namespace lissom
