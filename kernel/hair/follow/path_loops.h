/// The loop in which strands follow the motions along their group; private to kernel/hair.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lissom {

/// Strands that move side by side.
inline constexpr int kPathLanes = 16;

/// A point of each strand, and its length from the root; a strand with fewer points has its last
/// one again.
struct PathRow {
    float x[kPathLanes], y[kPathLanes], z[kPathLanes], arc[kPathLanes];
};

/// The knots that the points of a row lie between, and whether one is near its root.
struct PathRange {
    std::uint16_t low = 0, high = 0;
    bool in_ramp = false;
};

/// Points of a row that are bound to the skin: corners of the triangle below each and their
/// weights, and the least height over it. Lanes without one have weights and a floor that never
/// count.
struct PathContact {
    int row = 0;
    std::uint32_t vertices[3][kPathLanes] = {};
    float weights[3][kPathLanes] = {}, floor[kPathLanes] = {};
};

/// Strands of a block: the place of the first, their number, rows, and for each the number of its
/// points, its length, and where its coordinates begin among all.
struct PathStrands {
    std::size_t place = 0;
    int count = 0, rows = 0;
    int points[kPathLanes] = {};
    float total[kPathLanes] = {};
    std::size_t made[kPathLanes] = {};
};

/// Strands of a group as they are at rest, and their motion.
struct PathBlock {
    const PathStrands* strands = nullptr;
    const PathRow* rows = nullptr;
    const PathRange* ranges = nullptr;
    /// Motions at knots, sixteen numbers each as MotionField::Node, knots in a metre, and the
    /// number of the last.
    const float* knots = nullptr;
    float per_metre = 0.0f, last_knot = 0.0f;
    float origin[3] = {};
    /// Rotation of the skin, a column after the other, and 1 / the length over which it counts.
    float turn[9] = {};
    float per_ramp = 0.0f;
    /// Factor of lengths.
    float scale = 1.0f;
    /// Contacts by their rows, and eight numbers of each vertex of the skin: its place, a fourth
    /// number, its normal, and a fourth number.
    const PathContact* contacts = nullptr;
    int contact_count = 0;
    const float* skin = nullptr;
    /// The moved roots, x y z.
    float roots[3][kPathLanes] = {};
    /// Coordinates of all strands.
    float* made = nullptr;
};

/// Moves a block and writes its points; `steps` is room for as many rows. Segments change in parts
/// that grow with the square of the place along the strand, so that it has its length and hair near
/// the head stays where the head takes it. Points that are bound stay over the skin; segments keep
/// their lengths. The same to the bit on every processor.
void move_block(const PathBlock& block, PathRow* steps);

/// The same without writing them; for processors with these instructions.
void move_lanes_avx2(const PathBlock& block, PathRow* steps);
void move_lanes_avx512(const PathBlock& block, PathRow* steps);

}  // namespace lissom
