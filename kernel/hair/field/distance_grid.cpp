#include "kernel/hair/field/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/hair/field/closed_surface.h"
#include "kernel/hair/field/winding_rows.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

constexpr Index kStride = 4;  // between the grid points of the coarse lattice
constexpr double kSlack = 1.0 + 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The caps as a mesh of single triangles, since caps may meet in ways that a Mesh does not allow.
std::optional<SpatialTree> tree_of_caps(const ClosedSurface& surface, const Context& context) {
    if (surface.first_cap == surface.triangles.size()) return std::nullopt;
    std::vector<Vec3> positions;
    FaceList faces;
    for (std::size_t t = surface.first_cap; t < surface.triangles.size(); ++t) {
        const auto first = count_of(positions);
        for (const Index v : surface.triangles[t]) positions.push_back(surface.positions[v]);
        faces.add({first, first + 1, first + 2});
    }
    return SpatialTree(Mesh(std::move(positions), std::move(faces), context), context);
}

// Unsigned distances to the closed surface.
class Surface {
  public:
    Surface(const Mesh& head, const ClosedSurface& closed, const Context& context)
        : head_(head, context), caps_(tree_of_caps(closed, context)) {}

    // `limit` is an upper bound of the answer, up to rounding.
    double distance(const Vec3& p, double limit) const {
        double best = limit * kSlack + 1e-12 * scale_;
        bool found = false;
        for (const SpatialTree* tree : {&head_, caps_ ? &*caps_ : nullptr}) {
            if (!tree) continue;
            const auto near = tree->nearest_within(p, best);
            if (!near) continue;
            best = near->distance;
            found = true;
        }
        return found ? best : distance(p, kInfinity);
    }

  private:
    SpatialTree head_;
    std::optional<SpatialTree> caps_;
    double scale_ = head_.bounds().diagonal();
};

// The unsigned distances at every fourth point along each axis and at the last.
class Lattice {
  public:
    Lattice(const GridLayout& grid, const Surface& surface, const Context& context) : grid_(grid) {
        for (int axis = 0; axis < 3; ++axis) {
            counts_[axis] = (grid.counts[axis] - 2) / kStride + 2;
        }
        values_.resize(at(counts_[0]) * counts_[1] * counts_[2]);
        context.parallel_for(0, counts_[1] * counts_[2], 1, [&](Index from, Index to) {
            for (Index row = from; row < to; ++row) fill_row(row, surface);
        });
    }

    // Estimate at a grid point from the eight lattice points around it.
    struct Estimate {
        double low = 0.0, high = kInfinity, value = 0.0;
        bool one_sided = true;  // all on the side of the point itself
    };

    Estimate estimate(const std::array<Index, 3>& at,
                      const std::vector<std::uint8_t>& inside) const {
        std::array<Index, 3> cell{};
        Vec3 t;
        for (int axis = 0; axis < 3; ++axis) {
            cell[axis] = std::min(at[axis] / kStride, counts_[axis] - 2);
            const Index low = grid_index(cell[axis], axis), high = grid_index(cell[axis] + 1, axis);
            t[axis] = static_cast<double>(at[axis] - low) / (high - low);
        }
        const std::uint8_t side = inside[grid_.index(at[0], at[1], at[2])];
        Estimate result;
        for (int corner = 0; corner < 8; ++corner) {
            const std::array<int, 3> up{corner & 1, (corner >> 1) & 1, corner >> 2};
            std::array<Index, 3> point{};
            Vec3 offset;
            double weight = 1.0;
            for (int axis = 0; axis < 3; ++axis) {
                point[axis] = grid_index(cell[axis] + up[axis], axis);
                offset[axis] = grid_.step * (point[axis] - at[axis]);
                weight *= up[axis] ? t[axis] : 1.0 - t[axis];
            }
            const double value = values_[index(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2])];
            const double away = offset.norm();
            result.low = std::max(result.low, value - away);
            result.high = std::min(result.high, value + away);
            result.value += weight * value;
            result.one_sided &= inside[grid_.index(point[0], point[1], point[2])] == side;
        }
        // At a lattice point rounding may leave low above high, which std::clamp must not be given.
        result.value = std::min(std::max(result.value, result.low), result.high);
        return result;
    }

  private:
    Index grid_index(Index lattice, int axis) const {
        return std::min(lattice * kStride, grid_.counts[axis] - 1);
    }
    std::size_t index(Index i, Index j, Index k) const {
        return i + counts_[0] * (j + at(counts_[1]) * k);
    }

    void fill_row(Index row, const Surface& surface) {
        const Index j = row % counts_[1], k = row / counts_[1];
        double known = kInfinity;
        for (Index i = 0; i < counts_[0]; ++i) {
            const Vec3 p = grid_.point(grid_index(i, 0), grid_index(j, 1), grid_index(k, 2));
            known = surface.distance(p, known + kStride * grid_.step);
            values_[index(i, j, k)] = known;
        }
    }

    const GridLayout& grid_;
    std::array<Index, 3> counts_{};
    std::vector<double> values_;
};

void require_layout(const GridLayout& layout, const DistanceGridOptions& options) {
    const auto [x, y, z] = layout.counts;
    const bool counts = x >= 2 && y >= 2 && z >= 2 &&
                        static_cast<double>(x) * y * z <= std::numeric_limits<Index>::max();
    if (!counts || !(layout.step > 0.0) || !std::isfinite(layout.step) ||
        !layout.origin.allFinite()) {
        throw Error(ErrorCode::invalid_argument,
                    "the grid needs a finite origin, a step above 0, and at least 2 points along "
                    "each axis");
    }
    if (!(options.band >= 0.0 && options.band <= 1e6)) {
        throw Error(ErrorCode::invalid_argument, "band must lie between 0 and 1e6 steps");
    }
}

}  // namespace

DistanceGrid::DistanceGrid(const Mesh& head, const GridLayout& layout,
                           const DistanceGridOptions& options, const Context& context)
    : layout_(layout) {
    require_layout(layout, options);
    Progress progress(context, "distance grid");
    const std::size_t size = layout.size();
    charge_ = context.charge(size * sizeof(float), "the distance grid");
    const auto flags_charge = context.charge(size, "the inside of the distance grid");
    progress.step(0.2);
    const ClosedSurface closed = close_surface(head);
    const Surface surface(head, closed, context);
    const std::vector<std::uint8_t> inside = inside_flags(closed, layout, context);
    progress.step(0.1);
    const Lattice lattice(layout_, surface, context);
    progress.step(0.7);
    values_.resize(size);
    context.parallel_for(0, layout.counts[1] * layout.counts[2], 8, [&](Index from, Index to) {
        for (Index row = from; row < to; ++row) {
            const Index j = row % layout.counts[1], k = row / layout.counts[1];
            double known = kInfinity;
            for (Index i = 0; i < layout.counts[0]; ++i) {
                const Lattice::Estimate estimate = lattice.estimate({i, j, k}, inside);
                const bool far = estimate.one_sided && estimate.low > options.band * layout.step;
                const double bound = std::min(known + layout.step, estimate.high);
                const double distance =
                    far ? estimate.value : surface.distance(layout.point(i, j, k), bound);
                known = far ? kInfinity : distance;
                const Index at = layout.index(i, j, k);
                values_[at] = inside[at] ? -distance : distance;
            }
        }
    });
}

DistanceGrid::Sample DistanceGrid::sample(const Vec3& point) const {
    const Box box = layout_.box();
    const Vec3 clamped = point.cwiseMax(box.min).cwiseMin(box.max);
    if (!point.allFinite()) {
        return {std::numeric_limits<double>::quiet_NaN(), Vec3::Constant(point.sum() * 0.0)};
    }
    const Vec3 at = (clamped - layout_.origin) / layout_.step;
    std::array<Index, 3> cell{};
    Vec3 t;
    for (int axis = 0; axis < 3; ++axis) {
        cell[axis] = std::clamp(static_cast<Index>(at[axis]), 0, layout_.counts[axis] - 2);
        t[axis] = std::clamp(at[axis] - cell[axis], 0.0, 1.0);
    }
    Sample result;
    for (int corner = 0; corner < 8; ++corner) {
        const std::array<int, 3> up{corner & 1, (corner >> 1) & 1, corner >> 2};
        const double v = this->at(cell[0] + up[0], cell[1] + up[1], cell[2] + up[2]);
        std::array<double, 3> w{}, gradient{};
        for (int axis = 0; axis < 3; ++axis) {
            w[axis] = up[axis] ? t[axis] : 1.0 - t[axis];
            gradient[axis] = (up[axis] ? 1.0 : -1.0) / layout_.step;
        }
        result.value += v * w[0] * w[1] * w[2];
        result.gradient += v * Vec3(gradient[0] * w[1] * w[2], w[0] * gradient[1] * w[2],
                                    w[0] * w[1] * gradient[2]);
    }
    const Vec3 outward = point - clamped;
    const double beyond = outward.norm();
    if (beyond > 0.0) {
        // Along the axes on which the point left the box, the nearest point stays.
        for (int axis = 0; axis < 3; ++axis) {
            if (outward[axis] != 0.0) result.gradient[axis] = 0.0;
        }
        result.value += beyond;
        result.gradient += outward / beyond;
    }
    return result;
}

}  // namespace lissom
