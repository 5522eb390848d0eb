#include "kernel/mesh/fill/minimum_area.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

constexpr Index kMaximumExactLoop = 300;
// Distance of a chord's ends from those of a chord of the coarser line, in points; doubled if that
// gives nothing.
constexpr Index kChordReach = 3, kFarthestReach = 12;
// Weight of squared edges beside areas, times their ratio to the areas, which is limited.
constexpr double kShapeCost = 1e-8, kWorstShape = 1e4;
// Costs that differ by a smaller part are equal, so that the first of symmetric solutions is taken
// in every frame.
constexpr double kCostTolerance = 1e-10;
constexpr double kImpossible = std::numeric_limits<double>::infinity();

// For each point the lower ends of the chords to it, descending; edges of the line among them.
using LowerEnds = std::vector<std::vector<Index>>;

// The dynamic programme over the parts i .. k of a line, each closed by the chord from k to i.
class LeastArea {
  public:
    LeastArea(std::span<const Vec3> points, const LowerEnds& lower, const Context& context)
        : points_(points), chords_(points.size()), cost_to_(points.size()) {
        for (Index k = 1; k < count_of(points); ++k) {
            context.checkpoint();
            std::fill(cost_to_.begin(), cost_to_.end(), kImpossible);
            for (const Index i : lower[k]) close(i, k);
        }
    }

    // Empty if there is none.
    std::vector<Triangle> triangles() const {
        std::vector<Triangle> result;
        std::vector<std::pair<Index, Index>> open{{0, count_of(points_) - 1}};
        while (!open.empty()) {
            const auto [i, k] = open.back();
            open.pop_back();
            if (k - i < 2) continue;
            const Chord* chord = find(i, k);
            if (!chord) return {};
            result.push_back({i, chord->middle, k});
            open.emplace_back(i, chord->middle);
            open.emplace_back(chord->middle, k);
        }
        return result;
    }

  private:
    // Chord from a point to a later one, with the cost of closing the part between.
    struct Chord {
        Index to, middle;
        double cost;
    };

    const Chord* find(Index i, Index k) const {
        const auto found =
            std::lower_bound(chords_[i].begin(), chords_[i].end(), k,
                             [](const Chord& chord, Index to) { return chord.to < to; });
        return found != chords_[i].end() && found->to == k ? &*found : nullptr;
    }

    // Finds the best triangle (i, m, k) on the chord from k to i.
    void close(Index i, Index k) {
        Chord best{k, kNoIndex, i + 1 == k ? 0.0 : kImpossible};
        const Vec3 base = points_[k] - points_[i];
        for (const Chord& left : chords_[i]) {
            const double sides = left.cost + cost_to_[left.to], room = best.cost - sides;
            if (!(room > 0.0)) continue;
            const Vec3 side = points_[left.to] - points_[i], normal = base.cross(side);
            if (normal.squaredNorm() >= 4.0 * room * room) continue;
            const double cost = sides + triangle_cost(base, side, 0.5 * normal.norm());
            if (cost < best.cost * (1.0 - kCostTolerance)) best = {k, left.to, cost};
        }
        if (best.cost == kImpossible) return;
        chords_[i].push_back(best);
        cost_to_[i] = best.cost;
    }

    static double triangle_cost(const Vec3& base, const Vec3& side, double area) {
        const double edges = base.squaredNorm() + side.squaredNorm() + (base - side).squaredNorm();
        const double shape = edges < kWorstShape * area ? edges / area : kWorstShape;
        return area + kShapeCost * edges * shape;
    }

    std::span<const Vec3> points_;
    // Chords of each point, ascending.
    std::vector<std::vector<Chord>> chords_;
    // Cost of the part from each point to the one that is at hand.
    std::vector<double> cost_to_;
};

bool is_line_edge(Index i, Index k, Index n) {
    return k - i == 1 || (i == 0 && k == n - 1);
}

LowerEnds all_chords(Index n, const ChordTaken& taken) {
    LowerEnds lower(at(n));
    for (Index k = 1; k < n; ++k) {
        for (Index i = k - 1; i >= 0; --i) {
            if (is_line_edge(i, k, n) || !taken || !taken(i, k)) lower[k].push_back(i);
        }
    }
    return lower;
}

// Chords whose ends lie within `reach` of those of an edge of the triangles of the coarser line.
LowerEnds chords_near(std::span<const Triangle> coarse, Index n, Index reach,
                      const ChordTaken& taken) {
    LowerEnds lower(at(n));
    const auto near_edge = [&](Index a, Index b) {
        for (Index da = -reach; da <= reach; ++da) {
            for (Index db = -reach; db <= reach; ++db) {
                const Index i = (2 * a + da + n) % n, k = (2 * b + db + n) % n;
                if (i != k) lower[std::max(i, k)].push_back(std::min(i, k));
            }
        }
    };
    for (const Triangle& t : coarse) {
        for (int k = 0; k < 3; ++k) near_edge(t[k], t[(k + 1) % 3]);
    }
    for (Index k = 1; k < n; ++k) {
        lower[k].push_back(k - 1);
        if (k == n - 1) lower[k].push_back(0);
        std::sort(lower[k].begin(), lower[k].end(), std::greater<>());
        lower[k].erase(std::unique(lower[k].begin(), lower[k].end()), lower[k].end());
        if (!taken) continue;
        std::erase_if(lower[k], [&](Index i) { return !is_line_edge(i, k, n) && taken(i, k); });
    }
    return lower;
}

}  // namespace

std::vector<Triangle> minimum_area_triangles(std::span<const Vec3> loop, const ChordTaken& taken,
                                             const Context& context) {
    const Index n = count_of(loop);
    require(n >= 3, "a line to be closed by triangles needs at least 3 points");
    if (n <= kMaximumExactLoop) return LeastArea(loop, all_chords(n, taken), context).triangles();
    std::vector<Vec3> every_second;
    for (Index i = 0; i < n; i += 2) every_second.push_back(loop[at(i)]);
    const std::vector<Triangle> coarse = minimum_area_triangles(every_second, {}, context);
    std::vector<Triangle> triangles;
    for (Index reach = kChordReach; triangles.empty() && reach <= kFarthestReach; reach *= 2) {
        triangles = LeastArea(loop, chords_near(coarse, n, reach, taken), context).triangles();
    }
    return triangles;
}

}  // namespace lissom
