/// UvGrid: finds the points of a surface from points of its layout in the plane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// A point in a triangle of the plane.
struct UvPoint {
    Index triangle = kNoIndex;
    /// Weights of the triangle's corners; they sum to 1.
    Vec3 barycentric = Vec3::Zero();
};

/// Triangles of the plane in the cells of a grid, about four a cell. Building takes time in
/// proportion to their number; a look-up does not depend on it if they are of about one size. Keeps
/// copies of its inputs. Several threads may look up at once.
class UvGrid {
  public:
    /// Over places in `uv`. Triangles may be turned over, and those without an area hold no point.
    /// Errors: not_finite; out_of_range naming triangles with a corner that does not exist.
    UvGrid(std::span<const Vec2> uv, std::span<const Triangle> triangles);

    /// Returns the triangle that `point` lies in, its outline included (to 1e-9 of its weights);
    /// the first of several. Nothing if none does.
    std::optional<UvPoint> locate(const Vec2& point) const;

  private:
    struct Cells {
        std::array<Index, 2> first{}, last{};

        Cells united(const Cells& other) const {
            return {{std::min(first[0], other.first[0]), std::min(first[1], other.first[1])},
                    {std::max(last[0], other.last[0]), std::max(last[1], other.last[1])}};
        }
    };

    void set_cells();
    void sort_into_cells();
    std::array<Vec2, 3> corners(Index triangle) const {
        const auto& [a, b, c] = triangles_[at(triangle)];
        return {uv_[at(a)], uv_[at(b)], uv_[at(c)]};
    }
    Index column(double value, int axis) const;
    std::size_t cell(Index x, Index y) const { return at(y) * at(count_[0]) + at(x); }
    std::vector<Cells> cells_of_vertices() const;
    std::optional<Vec3> weights(Index triangle, const Vec2& point) const;

    std::vector<Vec2> uv_;
    std::vector<Triangle> triangles_;
    Vec2 low_ = Vec2::Zero(), high_ = Vec2::Zero();
    double cells_per_length_ = 0.0;
    std::array<Index, 2> count_{1, 1};
    // Triangles of cell c, ascending: of_cell_[begin_[c]] to of_cell_[begin_[c + 1]].
    std::vector<Index> begin_, of_cell_;
};

}  // namespace lissom
