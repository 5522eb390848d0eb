/// The loop in which strands grow; private to kernel/hair. Coordinates are those of the grid's
/// cells, so that a step of the grid is one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/growth/growth.h"

namespace lissom {

/// Three fields and the distance at the points of a grid.
struct QuadGrid {
    const float* values = nullptr;
    /// Gradient of the distance at each point, with a fourth number that is not used: continuous
    /// from cell to cell, as that of the interpolated distance is not.
    const float* gradients = nullptr;
    Index nx = 0, nxy = 0;
    /// The greatest coordinates.
    std::array<float, 3> last{};
};

/// A strand before it grows.
struct StrandSeed {
    Eigen::Vector3f at, normal;
    float length, floor;
    /// Random numbers, as StrandChance.
    float cut, tail;
};

/// A plane across a tail, and how far behind its tie it is along the spine.
struct TailPlane {
    Eigen::Vector3f center, direction;
    float behind;
    /// Across the direction, as long as the tail's radius there; 0 if hair goes as it comes.
    Eigen::Vector3f side = Eigen::Vector3f::Zero(), up = Eigen::Vector3f::Zero();
};

/// A disc that catches hair.
struct TailGate {
    Eigen::Vector3f center, direction;
    float square_radius;
    /// Distance behind the tie, and the number of the tail's next plane.
    float behind = 0.0f;
    std::int32_t plane = 0;
};

struct TieRule {
    TailGate tie;
    float tail_length, ragged;
    std::vector<TailPlane> planes = {};
    /// Whether the tie says how long strands become.
    bool measures = true;
    /// Behind the tie, for hair that came in beside it.
    std::vector<TailGate> gates = {};
};

/// Hair is kept if normal . p <= offset + ragged x chance.
struct CutRule {
    Eigen::Vector3f normal;
    float offset, ragged;
};

struct GrowthRules {
    float segment, min_speed, min_move, lift, inverse_ramp;
    /// 1 or 0: whether first segments never point inward, and whether longer vectors count as of
    /// length 1.
    float outward, inverse_cap;
    /// Cosine of the greatest turn.
    float min_cosine;
    /// Steps in a unit of the distances.
    float inverse_step;
    bool avoid, spare_tied;
    Index max_segments;
    std::vector<TieRule> ties;
    std::vector<CutRule> cuts;
    /// From cells to the coordinates of strands.
    Eigen::Matrix3f linear;
    Eigen::Vector3f translation;
};

/// Strands that were grown together; strands[i] is that of seed i.
struct StrandBatch {
    struct Strand {
        /// Its list, the beginning of its points in it, and their count.
        std::size_t list, first;
        Index count;
        Index tie;
        StrandEnd end;
    };
    /// Points of strands grown in one lane are in one list, with room behind them that is kept.
    std::vector<std::vector<float>> lists;
    std::vector<Strand> strands;
};

/// With which instructions strands grow; the results are the same to the bit. A processor that runs
/// one runs those before.
enum class GrowthLoop { anywhere, avx2, avx512 };
/// Returns the last that this processor runs.
GrowthLoop best_growth_loop();

/// Replaces the contents of `batch`. `loop` must be one that this processor runs.
void grow_batch(const QuadGrid& grid, const GrowthRules& rules, std::span<const StrandSeed> seeds,
                GrowthLoop loop, StrandBatch& batch);

/// grow_batch on processors with AVX2, and with AVX-512; only with LISSOM_HAS_AVX2_PATH.
void grow_batch_avx2(const QuadGrid& grid, const GrowthRules& rules,
                     std::span<const StrandSeed> seeds, StrandBatch& batch);
void grow_batch_avx512(const QuadGrid& grid, const GrowthRules& rules,
                       std::span<const StrandSeed> seeds, StrandBatch& batch);

}  // namespace lissom
