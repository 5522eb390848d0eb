#include "kernel/deform/volume/pair_patches.h"

#include <algorithm>
#include <limits>

namespace lissom {
namespace {

// Radius of a patch, in the distance at which the seeds cover all pairs.
constexpr double kOverlap = 1.6;

// The cosine of normals below which a pair does not belong to a patch.
constexpr double kSameSide = 0.2;

class PatchSpreader {
  public:
    PatchSpreader(std::span<const ThicknessPair> pairs, const WorkingPatch& work)
        : pairs_(pairs), work_(work), nearest_(pairs.size(), std::numeric_limits<double>::max()) {}

    std::vector<PairPatch> spread(Index count) {
        for (Index seed = first_seed(); count_of(seeds_) < count; seed = farthest()) {
            if (nearest_[at(seed)] == 0.0) break;
            add_seed(seed);
        }
        return patches(covering_radius());
    }

  private:
    const Vec3& place(Index pair) const { return work_.patch.rest[at(pairs_[at(pair)].vertex)]; }
    bool same_side(Index a, Index b) const {
        const std::vector<Vec3>& normal = work_.geometry.normal;
        return normal[at(pairs_[at(a)].vertex)].dot(normal[at(pairs_[at(b)].vertex)]) > kSameSide;
    }
    // Pairs of another side count as further away than any of the same.
    double distance(Index a, Index b) const {
        const double between = (place(a) - place(b)).norm();
        return same_side(a, b) ? between : between + kOtherSide * work_.radius;
    }

    // The first of those as far as the furthest, up to rounding: symmetric shapes have several.
    template <typename Distance>
    Index farthest_by(const Distance& distance_of) const {
        double most = 0.0;
        for (Index i = 0; i < count_of(pairs_); ++i) most = std::max(most, distance_of(i));
        Index first = 0;
        while (distance_of(first) < (1.0 - kSame) * most) ++first;
        return first;
    }
    Index first_seed() const {
        return farthest_by([&](Index i) { return place(i).norm(); });
    }
    Index farthest() const {
        return farthest_by([&](Index i) { return nearest_[at(i)]; });
    }
    void add_seed(Index seed) {
        seeds_.push_back(seed);
        for (Index i = 0; i < count_of(pairs_); ++i) {
            nearest_[at(i)] = std::min(nearest_[at(i)], distance(seed, i));
        }
    }
    double covering_radius() const {
        double radius = 0.0;
        for (const double d : nearest_) {
            if (d < kOtherSide * work_.radius) radius = std::max(radius, d);
        }
        return radius;
    }

    std::vector<PairPatch> patches(double radius) const {
        const double reach = std::max(kOverlap * radius, 1e-9 * work_.radius);
        std::vector<PairPatch> result(seeds_.size());
        for (Index i = 0; i < count_of(pairs_); ++i) {
            std::vector<std::pair<std::size_t, double>> shares;
            double total = 0.0;
            for (std::size_t r = 0; r < seeds_.size(); ++r) {
                const double d = distance(seeds_[r], i) / reach;
                if (d >= 1.0) continue;
                shares.emplace_back(r, (1.0 - d * d) * (1.0 - d * d));
                total += shares.back().second;
            }
            for (const auto& [r, share] : shares) result[r].emplace_back(i, share / total);
        }
        return result;
    }

    // Distances that differ by less than this part of them are the same.
    static constexpr double kSame = 1e-9;
    // Beyond every distance of the surface, in its radii.
    static constexpr double kOtherSide = 1e3;

    std::span<const ThicknessPair> pairs_;
    const WorkingPatch& work_;
    std::vector<double> nearest_;
    std::vector<Index> seeds_;
};

}  // namespace

std::vector<PairPatch> spread_patches(std::span<const ThicknessPair> pairs,
                                      const WorkingPatch& work, Index count) {
    if (pairs.empty()) return {};
    return PatchSpreader(pairs, work).spread(count);
}

}  // namespace lissom
