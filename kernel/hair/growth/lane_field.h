/// The field of a hairstyle, read at several points at once; private to kernel/hair. Included as
/// growth_lanes.h is, and compiled for the same processor.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernel/core/index.h"
#include "kernel/hair/growth/growth_lanes.h"
#include "kernel/hair/growth/growth_loops.h"
#include "kernel/hair/growth/lane_vectors.h"

LISSOM_LANES_BEGIN
namespace lissom::LISSOM_LANES {

// Cells of the grid that hold the points, clamped to the grid, the places in them, and whether the
// points are in the grid.
struct LanePlaces {
    Ints cell, inside;
    Floats3 in_cell;
};

struct Reading {
    Floats3 vector;
    Floats distance;
    // Gradient of the distance a step.
    Floats3 slope;
};

class LaneField {
  public:
    explicit LaneField(const QuadGrid& grid) : grid_(grid) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            below_last_[axis] = std::nextafter(grid_.last[axis], 0.0f);
        }
    }

    LISSOM_INLINE LanePlaces locate(const Floats3& to) const {
        const Floats3 last{all(grid_.last[0]), all(grid_.last[1]), all(grid_.last[2])};
        const Floats zero = all(0.0f);
        const Floats x = least(most(to.x, zero), last.x), y = least(most(to.y, zero), last.y),
                     z = least(most(to.z, zero), last.z);
        const Ints i = truncate(least(x, all(below_last_[0]))),
                   j = truncate(least(y, all(below_last_[1]))),
                   l = truncate(least(z, all(below_last_[2])));
        return {i + all(grid_.nx) * j + all(grid_.nxy) * l,
                (x == to.x) & (y == to.y) & (z == to.z),
                {x - to_floats(i), y - to_floats(j), z - to_floats(l)}};
    }

    LISSOM_INLINE Reading read(const LanePlaces& places) const {
        const CellPlaces in(places);
        EightFloats quads[kLanes], slopes[kLanes];
        for (int k = 0; k < kLanes; ++k) read_cell(in, k, quads[k], slopes[k]);
        Floats low[4], high[4], low_slopes[4], high_slopes[4];
        transpose(quads, 0, low);
        transpose(quads, 4, high);
        transpose(slopes, 0, low_slopes);
        transpose(slopes, 4, high_slopes);
        const Floats& x = places.in_cell.x;
        return {
            {between(low[0], high[0], x), between(low[1], high[1], x), between(low[2], high[2], x)},
            between(low[3], high[3], x),
            {high[3] - low[3], between(low_slopes[2], high_slopes[2], x),
             between(low_slopes[3], high_slopes[3], x)}};
    }

    // The way out of the head, of any length.
    LISSOM_INLINE Floats3 gradients(const LanePlaces& places) const {
        const CellPlaces in(places);
        const std::size_t nx = 4 * at(grid_.nx), nxy = 4 * at(grid_.nxy);
        EightFloats gradients[kLanes];
        for (int k = 0; k < kLanes; ++k) {
            const float* from = grid_.gradients + 4 * at(in.cell[k]);
            const EightFloats a = load(from), b = load(from + nx);
            const EightFloats low = a + in.z[k] * (load(from + nxy) - a),
                              high = b + in.z[k] * (load(from + nxy + nx) - b);
            gradients[k] = low + in.y[k] * (high - low);
        }
        Floats low[4], high[4];
        transpose(gradients, 0, low);
        transpose(gradients, 4, high);
        const Floats& x = places.in_cell.x;
        return {between(low[0], high[0], x), between(low[1], high[1], x),
                between(low[2], high[2], x)};
    }

  private:
    // Compilers that read single lanes of a vector may store all of it for each.
    struct CellPlaces {
        LISSOM_INLINE explicit CellPlaces(const LanePlaces& places) {
            std::memcpy(cell, &places.cell, sizeof(cell));
            std::memcpy(y, &places.in_cell.y, sizeof(y));
            std::memcpy(z, &places.in_cell.z, sizeof(z));
        }

        std::int32_t cell[kLanes];
        float y[kLanes], z[kLanes];
    };

    // At both ends along x of a cell, there along y and z, vector and distance, and slopes of the
    // distance along y and z as the last two of four numbers.
    LISSOM_INLINE void read_cell(const CellPlaces& in, int k, EightFloats& quads,
                                 EightFloats& slopes) const {
        const float* from = grid_.values + 4 * at(in.cell[k]);
        const std::size_t nx = 4 * at(grid_.nx), nxy = 4 * at(grid_.nxy);
        const EightFloats a = load(from), b = load(from + nx);
        const EightFloats low_z = load(from + nxy) - a, high_z = load(from + nxy + nx) - b;
        const EightFloats low = a + in.z[k] * low_z, along_y = (b + in.z[k] * high_z) - low;
        quads = low + in.y[k] * along_y;
        slopes = last_of(along_y, low_z + in.y[k] * (high_z - low_z));
    }

    const QuadGrid& grid_;
    // Just below the greatest coordinates, so in the last cell.
    std::array<float, 3> below_last_{};
};

}  // namespace lissom::LISSOM_LANES
LISSOM_LANES_END
