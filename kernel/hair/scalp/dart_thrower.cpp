#include "kernel/hair/scalp/dart_thrower.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

// Darts are thrown in rounds. Within a round all have one radius, so that most can be told apart
// from earlier roots on any thread and in any order; the remaining ones are placed one after
// another, in the order they were thrown. Rounds do not depend on the number of roots wanted.
namespace lissom {
namespace {

// Radius of a dart over the spacing sqrt(area / n): as large as leaves room for about one dart in
// eight.
constexpr double kRadius = 0.60;
// Darts are not widened below this density; there the roots are only fewer.
constexpr double kMinDensity = 0.1;
// If fewer darts of a round than one in this many find room, the radius shrinks by a part.
constexpr Index kMinShare = 64;
constexpr double kShrink = 0.98;
constexpr Index kFewestDarts = 256, kMaxDarts = 1 << 18;
constexpr Index kNoDart = -1;

// The roots so far in cells as wide as the largest dart. Cells share the slots of a hash table;
// roots of other cells in a slot only cost a test. Neighbours along x are neighbours in the table.
class PointTable {
  public:
    void reset(const std::vector<Root>& roots, double cell) {
        cells_ = 1.0 / cell;
        capacity_ = std::max<std::size_t>(64, 4 * roots.size());
        std::size_t size = 64;
        while (size < 2 * capacity_) size *= 2;
        heads_.assign(size, kNoDart);
        next_.clear();
        points_.clear();
        for (const Root& root : roots) add(root.position);
    }

    bool full() const { return points_.size() >= capacity_; }

    void add(const Vec3& p) {
        Index& head = heads_[slot(cell_of(p))];
        next_.push_back(head);
        points_.push_back(p);
        head = count_of(next_) - 1;
    }

    bool any_within(const Vec3& p, double radius) const {
        if (meets(cell_of(p), p, radius)) return true;
        const Cell low = cell_of(p - Vec3::Constant(radius));
        const Cell high = cell_of(p + Vec3::Constant(radius));
        for (std::int64_t k = low[2]; k <= high[2]; ++k) {
            for (std::int64_t j = low[1]; j <= high[1]; ++j) {
                const double y = gap(j, p.y()), z = gap(k, p.z());
                const double left = radius * radius - y * y - z * z;
                if (left <= 0.0) continue;
                const std::int64_t first = cell_at(p.x() - std::sqrt(left));
                const std::int64_t last = cell_at(p.x() + std::sqrt(left));
                for (std::int64_t i = first; i <= last; ++i) {
                    if (meets({i, j, k}, p, radius)) return true;
                }
            }
        }
        return false;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;

    std::int64_t cell_at(double x) const {
        return static_cast<std::int64_t>(std::floor(x * cells_));
    }
    Cell cell_of(const Vec3& p) const { return {cell_at(p.x()), cell_at(p.y()), cell_at(p.z())}; }

    // From `x` to a cell's side, along an axis.
    double gap(std::int64_t cell, double x) const {
        const double low = cell / cells_;
        return std::max({low - x, x - low - 1.0 / cells_, 0.0});
    }

    std::size_t slot(const Cell& cell) const {
        const auto hash = static_cast<std::uint64_t>(cell[1]) * 0x9e3779b97f4a7c15ULL ^
                          static_cast<std::uint64_t>(cell[2]) * 0xc2b2ae3d27d4eb4fULL;
        return static_cast<std::size_t>((hash >> 20) + static_cast<std::uint64_t>(cell[0])) &
               (heads_.size() - 1);
    }

    bool meets(const Cell& cell, const Vec3& p, double radius) const {
        for (Index i = heads_[slot(cell)]; i != kNoDart; i = next_[i]) {
            if ((points_[i] - p).squaredNorm() < radius * radius) return true;
        }
        return false;
    }

    double cells_ = 1.0;  // in a unit of length
    std::size_t capacity_ = 0;
    std::vector<Index> heads_, next_;
    std::vector<Vec3> points_;
};

class DartThrower {
  public:
    DartThrower(const RootSurface& surface, const RootOptions& options, const Context& context)
        : surface_(surface), options_(options), context_(context) {}

    std::vector<Root> run() {
        Progress progress(context_, "roots");
        roots_.reserve(options_.count);
        while (missing() > 0) {
            progress.update(roots_.size(), options_.count);
            radius_ = shrink_ * kRadius * std::sqrt(surface_.mass() / (roots_.size() + 1));
            if (roots_.empty() || table_.full()) table_.reset(roots_, radius_);
            throw_round();
        }
        return std::move(roots_);
    }

  private:
    std::size_t missing() const { return options_.count - roots_.size(); }

    void throw_round() {
        const auto known = count_of(roots_);
        const Index darts = std::clamp(known / 2, kFewestDarts, kMaxDarts);
        find_triangles(darts);
        find_room(by_triangle(darts));
        for (Index i = 0; i < darts && missing() > 0; ++i) {
            if (triangle_[i] != kNoDart) place(i);
        }
        if (count_of(roots_) - known < darts / kMinShare) shrink_ *= kShrink;
        thrown_ += darts;
    }

    CountedRandom random_of(Index dart) const { return {options_.seed, thrown_ + dart}; }

    double radius_at(double density) const {
        return radius_ / std::sqrt(std::max(density, kMinDensity));
    }

    // Finds the triangle of each dart, or kNoDart if it is lost to a lower density.
    void find_triangles(Index darts) {
        triangle_.resize(darts);
        context_.parallel_for(0, darts, 2048, [&](Index from, Index to) {
            for (Index i = from; i < to; ++i) {
                CountedRandom random = random_of(i);
                const RootSurface::Dart dart = surface_.random_dart(random);
                const bool lost = random.uniform() >= surface_.density(dart);
                triangle_[i] = lost ? kNoDart : dart.triangle;
            }
        });
    }

    // Returns the darts that are not lost, grouped by triangle, so that neighbours in space are
    // neighbours in time.
    std::vector<Index> by_triangle(Index darts) const {
        std::vector<Index> begin(at(surface_.triangle_count()) + 1, 0);
        for (Index i = 0; i < darts; ++i) {
            if (triangle_[i] != kNoDart) ++begin[triangle_[i] + 1];
        }
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<Index> order(begin.back());
        for (Index i = 0; i < darts; ++i) {
            if (triangle_[i] != kNoDart) order[begin[triangle_[i]]++] = i;
        }
        return order;
    }

    // Takes out the darts that are too near to the roots of earlier rounds.
    void find_room(const std::vector<Index>& order) {
        context_.parallel_for(0, count_of(order), 2048, [&](Index from, Index to) {
            for (Index i = from; i < to; ++i) {
                CountedRandom random = random_of(order[i]);
                const RootSurface::Dart dart = surface_.random_dart(random);
                const double radius = radius_at(surface_.density(dart));
                if (table_.any_within(surface_.position(dart), radius)) {
                    triangle_[order[i]] = kNoDart;
                }
            }
        });
    }

    void place(Index i) {
        CountedRandom random = random_of(i);
        const RootSurface::Dart dart = surface_.random_dart(random);
        const Vec3 position = surface_.position(dart);
        if (table_.any_within(position, radius_at(surface_.density(dart)))) return;
        roots_.push_back(surface_.root(dart));
        table_.add(position);
    }

    const RootSurface& surface_;
    const RootOptions& options_;
    const Context& context_;
    std::vector<Root> roots_;
    PointTable table_;
    std::vector<Index> triangle_;
    double radius_ = 0.0, shrink_ = 1.0;
    std::uint64_t thrown_ = 0;
};

}  // namespace

std::vector<Root> throw_darts(const RootSurface& surface, const RootOptions& options,
                              const Context& context) {
    return DartThrower(surface, options, context).run();
}

}  // namespace lissom
