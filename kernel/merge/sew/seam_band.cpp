#include "kernel/merge/sew/seam_band.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

namespace lissom {
namespace {

// Areas that differ by less than this part are equal, so that rounding does not decide.
constexpr double kSame = 1.0 - 1e-10;
constexpr double kFar = std::numeric_limits<double>::infinity();

// A path through the grid of pairs (point of the first loop, point of the second): for each of its
// n + 1 rows from `start` on, the first and the last column it visits.
struct GridPath {
    Index start = 0;
    std::vector<Index> from, to;
    double area = kFar;
};

class BandSearch {
  public:
    BandSearch(std::span<const Vec3> first, std::span<const Vec3> second, const Context& context)
        : first_(first),
          second_(second),
          context_(context),
          n_(count_of(first)),
          m_(count_of(second)) {}

    GridPath best() {
        const GridPath start = shortest(0, nullptr, nullptr);
        best_ = start;
        GridPath end = start;
        end.start = n_;
        divide(start, end);
        return best_;
    }

  private:
    const Vec3& p(Index row) const { return first_[row % n_]; }
    const Vec3& q(Index column) const { return second_[column % m_]; }

    static double area(const Vec3& a, const Vec3& b, const Vec3& c) {
        return 0.5 * (b - a).cross(c - a).norm();
    }

    // Paths that start between two shortest ones need not cross them.
    void divide(const GridPath& low, const GridPath& high) {
        if (high.start - low.start < 2) return;
        const GridPath middle = shortest((low.start + high.start) / 2, &low, &high);
        if (middle.area < best_.area * kSame) best_ = middle;
        divide(low, middle);
        divide(middle, high);
    }

    // Columns that a path may visit in a row between `low`, which is ahead, and `high`.
    std::pair<Index, Index> range(Index row, const GridPath* low, const GridPath* high) const {
        std::pair<Index, Index> columns{0, m_};
        if (low && row <= low->start + n_) columns.second = low->to[row - low->start];
        if (high && row >= high->start) columns.first = high->from[row - high->start];
        return columns;
    }

    GridPath shortest(Index start, const GridPath* low, const GridPath* high) {
        context_.checkpoint();
        const auto width = at(m_) + 1;
        std::vector<double> cost(width, kFar), last;
        std::vector<char> along_row(width * (at(n_) + 1), 0);
        for (Index i = 0; i <= n_; ++i) {
            const Index row = start + i;
            last.swap(cost);
            cost.assign(width, kFar);
            const auto [from, to] = range(row, low, high);
            for (Index c = from; c <= to; ++c) {
                const double down =
                    i > 0 ? last[c] + area(p(row - 1), p(row), q(c)) : (c == 0 ? 0.0 : kFar);
                const double right = c > from ? cost[c - 1] + area(q(c - 1), q(c), p(row)) : kFar;
                cost[c] = right < down * kSame ? right : down;
                along_row[i * width + c] = right < down * kSame;
            }
        }
        return traced(start, cost[m_], along_row);
    }

    GridPath traced(Index start, double area, const std::vector<char>& along_row) const {
        const auto width = at(m_) + 1;
        GridPath path{start, std::vector<Index>(n_ + 1), std::vector<Index>(n_ + 1), area};
        Index column = m_;
        for (Index i = n_; i >= 0; --i) {
            path.to[i] = column;
            while (column > 0 && along_row[i * width + column]) --column;
            path.from[i] = column;
        }
        return path;
    }

    std::span<const Vec3> first_, second_;
    const Context& context_;
    Index n_, m_;
    GridPath best_;
};

}  // namespace

std::vector<BandTriangle> min_area_band(std::span<const Vec3> first, std::span<const Vec3> second,
                                        const Context& context) {
    const auto n = count_of(first), m = count_of(second);
    const GridPath path = BandSearch(first, second, context).best();
    std::vector<BandTriangle> band;
    for (Index i = 0; i <= n; ++i) {
        const Index row = (path.start + i) % n;
        if (i > 0) band.push_back({true, (row + n - 1) % n, path.from[i] % m});
        for (Index c = path.from[i]; c < path.to[i]; ++c) band.push_back({false, c, row});
    }
    return band;
}

}  // namespace lissom
