#include "kernel/mesh/parameterize/uv_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernel/core/error.h"
#include "kernel/mesh/parameterize/triangle_shape.h"

namespace lissom {
namespace {

// How far outside of a triangle a point counts as inside, by its weights; no more than this part of
// the extent.
constexpr double kOutside = 1e-9, kRoom = 4e-9;
constexpr double kTrianglesPerCell = 4.0;

void require_points(std::span<const Vec2> uv, std::span<const Triangle> triangles) {
    for (const Vec2& p : uv) {
        require(p.allFinite(), "points of the plane must be finite", ErrorCode::not_finite);
    }
    Elements wrong{ElementKind::face, 0, {}};
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const bool inside = std::all_of(triangles[t].begin(), triangles[t].end(),
                                        [&](Index v) { return v >= 0 && v < count_of(uv); });
        if (!inside) wrong.add(index_of(t));
    }
    if (wrong.count == 0) return;
    throw Error(ErrorCode::out_of_range,
                describe(wrong) + " of the plane: a corner has no place there", wrong);
}

}  // namespace

UvGrid::UvGrid(std::span<const Vec2> uv, std::span<const Triangle> triangles)
    : uv_(uv.begin(), uv.end()), triangles_(triangles.begin(), triangles.end()) {
    require_points(uv, triangles);
    if (triangles_.empty()) return;
    set_cells();
    sort_into_cells();
}

void UvGrid::set_cells() {
    low_ = high_ = uv_[at(triangles_[0][0])];
    for (const Triangle& t : triangles_) {
        for (const Index v : t) {
            low_ = low_.cwiseMin(uv_[at(v)]);
            high_ = high_.cwiseMax(uv_[at(v)]);
        }
    }
    const Vec2 size = (high_ - low_).cwiseMax(1e-9 * (high_ - low_).maxCoeff());
    const double wanted = static_cast<double>(triangles_.size()) / kTrianglesPerCell;
    cells_per_length_ = size.x() > 0.0 ? std::sqrt(wanted / (size.x() * size.y())) : 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        const double count = std::ceil(size[axis] * cells_per_length_);
        count_[at(axis)] = static_cast<Index>(std::clamp(count, 1.0, std::ceil(wanted)));
    }
}

void UvGrid::sort_into_cells() {
    const std::vector<Cells> around = cells_of_vertices();
    const auto for_each_cell = [&](Index t, const auto& use) {
        const auto& [a, b, c] = triangles_[at(t)];
        const Cells cells = around[at(a)].united(around[at(b)]).united(around[at(c)]);
        for (Index y = cells.first[1]; y <= cells.last[1]; ++y) {
            for (Index x = cells.first[0]; x <= cells.last[0]; ++x) use(cell(x, y));
        }
    };
    begin_.assign(at(count_[0]) * at(count_[1]) + 1, 0);
    for (Index t = 0; t < count_of(triangles_); ++t) {
        for_each_cell(t, [&](std::size_t place) { ++begin_[place + 1]; });
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    of_cell_.resize(at(begin_.back()));
    std::vector<Index> next(begin_.begin(), begin_.end() - 1);
    for (Index t = 0; t < count_of(triangles_); ++t) {
        for_each_cell(t, [&](std::size_t place) { of_cell_[at(next[place]++)] = t; });
    }
}

Index UvGrid::column(double value, int axis) const {
    const double place = (value - low_[axis]) * cells_per_length_;
    return static_cast<Index>(std::clamp(place, 0.0, count_[at(axis)] - 1.0));
}

// Cells around each vertex, with room for points that count as inside.
std::vector<UvGrid::Cells> UvGrid::cells_of_vertices() const {
    std::vector<Cells> result;
    result.reserve(uv_.size());
    const Vec2 room = kRoom * (high_ - low_);
    for (const Vec2& p : uv_) {
        Cells& cells = result.emplace_back();
        for (int axis = 0; axis < 2; ++axis) {
            cells.first[at(axis)] = column(p[axis] - room[axis], axis);
            cells.last[at(axis)] = column(p[axis] + room[axis], axis);
        }
    }
    return result;
}

std::optional<Vec3> UvGrid::weights(Index triangle, const Vec2& point) const {
    const auto [a, b, c] = corners(triangle);
    const double area = doubled_area(a, b, c);
    if (area == 0.0) return {};
    Vec3 weights(doubled_area(point, b, c), doubled_area(a, point, c), 0.0);
    weights /= area;
    weights.z() = 1.0 - weights.x() - weights.y();
    if (!(weights.minCoeff() >= -kOutside)) return {};
    return weights;
}

std::optional<UvPoint> UvGrid::locate(const Vec2& point) const {
    const Vec2 room = kRoom * (high_ - low_);
    const bool outside = ((point + room).array() < low_.array()).any() ||
                         ((point - room).array() > high_.array()).any();
    if (triangles_.empty() || outside || !point.allFinite()) return {};
    const std::size_t place = cell(column(point.x(), 0), column(point.y(), 1));
    for (Index i = begin_[place]; i < begin_[place + 1]; ++i) {
        const Index triangle = of_cell_[at(i)];
        if (const auto found = weights(triangle, point)) return UvPoint{triangle, *found};
    }
    return {};
}

}  // namespace lissom
