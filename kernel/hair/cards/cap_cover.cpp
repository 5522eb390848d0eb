#include "kernel/hair/cards/cap_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "kernel/core/geometry.h"

namespace lissom {
namespace {

// Metres around a place in which roots count, and those over the mean distance of two roots.
constexpr double kLeastReach = 0.009, kReachPerStep = 1.6;
// Share of vertices near roots whose density is less than the usual.
constexpr double kUsualShare = 0.5;
constexpr Index kCoverGrain = 256;

// Roots in cells, found by place.
class RootGrid {
  public:
    RootGrid(const Strands& strands, double reach) : reach_(reach) {
        for (Index s = 0; s < strands.size(); ++s) {
            const Vec3 root = strands.root(s).cast<double>();
            if (root.allFinite()) cells_[key(cell_of(root))].push_back(root);
        }
    }

    // Roots around a place, less with their distance: (1 - d^2 / reach^2)^2 each.
    double around(const Vec3& p) const {
        const Cell middle = cell_of(p);
        double sum = 0.0;
        for (int i = 0; i < 27; ++i) {
            const auto found = cells_.find(
                key({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1}));
            if (found == cells_.end()) continue;
            for (const Vec3& root : found->second) {
                const double part = 1.0 - (root - p).squaredNorm() / (reach_ * reach_);
                sum += part > 0.0 ? part * part : 0.0;
            }
        }
        return sum;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;

    Cell cell_of(const Vec3& p) const {
        Cell cell;
        for (std::size_t k = 0; k < 3; ++k) {
            cell[k] = static_cast<std::int64_t>(
                std::floor(std::clamp(p[index_of(k)] / reach_, -1e6, 1e6)));
        }
        return cell;
    }
    static std::int64_t key(const Cell& cell) {
        constexpr std::int64_t kRow = 1 << 21;
        return (cell[2] * kRow + cell[1]) * kRow + cell[0];
    }

    double reach_;
    std::unordered_map<std::int64_t, std::vector<Vec3>> cells_;
};

// The area that roots lie on, roughly: that of half a ball in their box.
double reach_of(const Strands& strands) {
    Box box;
    for (Index s = 0; s < strands.size(); ++s) {
        const Vec3 root = strands.root(s).cast<double>();
        if (root.allFinite()) box.extend(root);
    }
    if (box.empty()) return kLeastReach;
    const Vec3 size = box.max - box.min;
    const double area = 0.5 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
    return std::max(kLeastReach, kReachPerStep * std::sqrt(area / strands.size()));
}

}  // namespace

std::vector<double> cover_of_roots(const Strands& strands, const Mesh& head, double unit,
                                   const Context& context) {
    const RootGrid grid(strands, reach_of(strands));
    std::vector<double> cover(at(head.vertex_count()));
    context.parallel_for(0, head.vertex_count(), kCoverGrain, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) cover[at(v)] = grid.around(unit * head.position(v));
    });
    std::vector<double> dense;
    for (const double x : cover) {
        if (x > 0.5) dense.push_back(x);
    }
    if (dense.empty()) return cover;
    const auto usual =
        dense.begin() + static_cast<std::ptrdiff_t>(kUsualShare * double(dense.size() - 1));
    std::nth_element(dense.begin(), usual, dense.end());
    for (double& x : cover) x = std::min(1.0, x / *usual);
    return cover;
}

}  // namespace lissom
