/// The map from coordinates around and away from a seam to a band beside it; private to
/// kernel/merge.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/blend/band_chart.h"
#include "kernel/merge/blend/band_place.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Finds the point of a band that has given coordinates.
class BandMap {
  public:
    /// `width` is the distance that counts as 1.
    BandMap(const BandChart& chart, double width);

    /// Returns the place at `angle` (fraction of a turn, 0 to 1) and `distance` (in widths), or
    /// nothing if no triangle has it.
    std::optional<BandPlace> locate(double angle, double distance) const;
    /// The vertex whose coordinates are nearest; nothing in a band without triangles.
    std::optional<BandPlace> nearest(double angle, double distance) const;

    /// Triangles that begin within the width and whose coordinates turn over or have no area.
    Index flipped() const { return flipped_; }

  private:
    /// Triangles with their coordinates, angles unwrapped to lie near each other.
    struct Cell {
        Triangle vertices;
        std::array<Vec2, 3> at;
    };
    void add_cell(const BandChart& chart, const Triangle& t, double width);
    void build_bins();
    bool place_in(const Cell& cell, const Vec2& at, BandPlace& place) const;
    Index row_of(double distance) const;

    std::vector<Cell> cells_;
    // Cells that may hold a point, by bins around and away, compressed.
    Index around_ = 1, away_ = 1;
    double farthest_ = 0.0;
    std::vector<Index> bin_begin_, bin_;
    Index flipped_ = 0;
};

}  // namespace lissom
