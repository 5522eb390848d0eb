#include "kernel/hair/guides/strand_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr Index kClusterGrain = 256;
constexpr int kPlaces = 3;

// Root, and the points at thirds of the length from it, times the weight of the shape.
using Feature = Eigen::Matrix<double, 3 + 3 * kPlaces, 1>;

Feature feature_of(const StrandView& strand, double weight) {
    std::vector<double> fractions;
    arc_fractions(strand, fractions);
    Feature feature;
    feature.head<3>() = point_of(strand, 0);
    for (int i = 1; i <= kPlaces; ++i) {
        const StrandPlace place = place_at(fractions, i / double{kPlaces});
        const Vec3 a = point_of(strand, place.below);
        const Vec3 b = point_of(strand, std::min(place.below + 1, index_of(strand.cols()) - 1));
        feature.segment<3>(3 * i) = weight * (a + double{place.u} * (b - a) - feature.head<3>());
    }
    return feature;
}

void require_clusters(const Strands& strands, const ClusterOptions& options) {
    require(options.count >= 1, "there must be at least one cluster of strands");
    require(options.shape >= 0.0 && std::isfinite(options.shape),
            "the weight of shapes must be finite and not negative");
    require(options.rounds >= 0, "the number of rounds must not be negative");
    Elements bad{ElementKind::strand, 0, {}};
    for (Index s = 0; s < strands.size(); ++s) {
        if (!strands.strand(s).allFinite()) bad.add(s);
    }
    if (bad.count == 0) return;
    std::string message =
        describe(bad) + " have coordinates that are not finite; select the others first";
    throw Error(ErrorCode::not_finite, std::move(message), std::move(bad));
}

// Strands that go into one cluster together: their mean and number.
struct ClusterPart {
    Feature mean = Feature::Zero();
    double weight = 0.0;
    // The lowest id of its strands.
    std::uint32_t id = kNoGuide;
};

// The strands of one group.
struct ClusterFamily {
    std::vector<ClusterPart> units;
    std::vector<Index> cluster_of_unit;
    // Their clusters begin at this number.
    Index first = 0, count = 0;
    double weight = 0.0;
};

class Clustering {
  public:
    Clustering(const Strands& strands, const ClusterOptions& options, const Context& context)
        : strands_(strands), options_(options), context_(context) {
        measure();
        collect();
        share_counts();
    }

    StrandClusters run() {
        StrandClusters result;
        for (auto& [group, family] : families_) improve(family);
        result.of_strand.assign(at(strands_.size()), kNoIndex);
        for (Index s = 0; s < strands_.size(); ++s) {
            if (unit_of_[at(s)] == kNoIndex) continue;
            const ClusterFamily& family = families_.at(family_of(s));
            result.of_strand[at(s)] = family.first + family.cluster_of_unit[at(unit_of_[at(s)])];
        }
        find_medoids(result);
        return result;
    }

  private:
    void measure() {
        const double weight = std::sqrt(options_.shape / kPlaces);
        features_.resize(at(strands_.size()));
        has_length_.resize(at(strands_.size()));
        context_.parallel_for(0, strands_.size(), kClusterGrain, [&](Index begin, Index end) {
            for (Index s = begin; s < end; ++s) {
                has_length_[at(s)] = length(strands_.strand(s)) > 0.0;
                if (has_length_[at(s)]) {
                    features_[at(s)] = feature_of(strands_.strand(s), weight);
                }
            }
        });
    }

    std::uint64_t key_of(Index s) const {
        const std::vector<std::uint32_t>& guides = strands_.guides().ids;
        const bool follows =
            options_.unit == ClusterUnit::lock && !guides.empty() && guides[at(s)] != kNoGuide;
        constexpr std::uint64_t kAlone = std::uint64_t{1} << 32;
        return follows ? guides[at(s)] : kAlone + at(s);
    }

    using FamilyKey = std::pair<Index, std::uint64_t>;

    FamilyKey family_of(Index s) const {
        const std::vector<std::uint32_t>& guides = strands_.guides().ids;
        const bool by_lock = options_.unit == ClusterUnit::within_lock && !guides.empty();
        return {strands_.group(s), by_lock ? guides[at(s)] : 0};
    }

    void collect() {
        std::map<std::pair<FamilyKey, std::uint64_t>, Index> known;
        unit_of_.assign(at(strands_.size()), kNoIndex);
        for (Index s = 0; s < strands_.size(); ++s) {
            if (!has_length_[at(s)]) continue;
            ClusterFamily& family = families_[family_of(s)];
            const auto [place, is_new] =
                known.try_emplace({family_of(s), key_of(s)}, count_of(family.units));
            if (is_new) family.units.emplace_back();
            ClusterPart& unit = family.units[at(place->second)];
            unit.mean += features_[at(s)];
            unit.weight += 1.0;
            unit.id = std::min(unit.id, strands_.id(s));
            unit_of_[at(s)] = place->second;
            family.weight += 1.0;
        }
        require(!families_.empty(), "no strand has a length, so there is nothing to cluster");
        for (auto& [group, family] : families_) {
            for (ClusterPart& unit : family.units) unit.mean /= unit.weight;
        }
    }

    // One for each group; then each to the group with the most strands for its number.
    void share_counts() {
        Index left = options_.count - count_of(families_);
        for (auto& [group, family] : families_) family.count = 1;
        while (left-- > 0) {
            ClusterFamily* needs = nullptr;
            for (auto& [group, family] : families_) {
                if (family.count == count_of(family.units)) continue;
                if (!needs || family.weight * needs->count > needs->weight * family.count) {
                    needs = &family;
                }
            }
            if (!needs) break;
            ++needs->count;
        }
        Index first = 0;
        for (auto& [group, family] : families_) {
            family.first = first;
            first += family.count;
        }
        count_ = first;
    }

    void improve(ClusterFamily& family) {
        std::vector<Feature> means = first_means(family);
        for (int round = 0;; ++round) {
            const std::vector<Index> before = family.cluster_of_unit;
            assign(family, means);
            if (round >= options_.rounds || before == family.cluster_of_unit) break;
            means = means_of(family, means);
        }
        fill_empty(family, means);
    }

    static std::vector<Feature> first_means(const ClusterFamily& family) {
        std::vector<Index> order;
        for (Index u = 0; u < count_of(family.units); ++u) order.push_back(u);
        const auto lower = [&](Index a, Index b) {
            return std::pair(family.units[at(a)].id, a) < std::pair(family.units[at(b)].id, b);
        };
        std::partial_sort(order.begin(), order.begin() + family.count, order.end(), lower);
        std::vector<Feature> means;
        for (Index c = 0; c < family.count; ++c) {
            means.push_back(family.units[at(order[at(c)])].mean);
        }
        return means;
    }

    void assign(ClusterFamily& family, const std::vector<Feature>& means) const {
        family.cluster_of_unit.resize(family.units.size());
        context_.parallel_for(
            0, count_of(family.units), kClusterGrain, [&](Index begin, Index end) {
                for (Index u = begin; u < end; ++u) {
                    family.cluster_of_unit[at(u)] = nearest(family.units[at(u)].mean, means);
                }
            });
    }

    static Index nearest(const Feature& feature, const std::vector<Feature>& means) {
        Index best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (Index c = 0; c < count_of(means); ++c) {
            const Feature& mean = means[at(c)];
            const double roots = (mean.head<3>() - feature.head<3>()).squaredNorm();
            if (roots >= least) continue;
            const double distance = roots + (mean - feature).tail<3 * kPlaces>().squaredNorm();
            if (distance < least) {
                least = distance;
                best = c;
            }
        }
        return best;
    }

    static std::vector<Feature> means_of(const ClusterFamily& family,
                                         const std::vector<Feature>& old) {
        std::vector<Feature> sums(old.size(), Feature::Zero());
        std::vector<double> weights(old.size(), 0.0);
        for (std::size_t u = 0; u < family.units.size(); ++u) {
            const auto c = at(family.cluster_of_unit[u]);
            sums[c] += family.units[u].weight * family.units[u].mean;
            weights[c] += family.units[u].weight;
        }
        for (std::size_t c = 0; c < old.size(); ++c) {
            sums[c] = weights[c] > 0.0 ? Feature(sums[c] / weights[c]) : old[c];
        }
        return sums;
    }

    // Gives each cluster without units the one that lies furthest from the mean of its own.
    static void fill_empty(ClusterFamily& family, const std::vector<Feature>& means) {
        std::vector<Index> sizes(means.size(), 0);
        for (const Index c : family.cluster_of_unit) ++sizes[at(c)];
        for (Index c = 0; c < count_of(means); ++c) {
            if (sizes[at(c)] > 0) continue;
            std::size_t far = 0;
            double most = -1.0;
            for (std::size_t u = 0; u < family.units.size(); ++u) {
                const Index own = family.cluster_of_unit[u];
                const double distance = (family.units[u].mean - means[at(own)]).squaredNorm();
                if (sizes[at(own)] < 2 || distance <= most) continue;
                most = distance;
                far = u;
            }
            --sizes[at(family.cluster_of_unit[far])];
            family.cluster_of_unit[far] = c;
            sizes[at(c)] = 1;
        }
    }

    void find_medoids(StrandClusters& clusters) const {
        std::vector<Feature> means(at(count_), Feature::Zero());
        std::vector<double> sizes(at(count_), 0.0);
        for (std::size_t s = 0; s < clusters.of_strand.size(); ++s) {
            const Index c = clusters.of_strand[s];
            if (c == kNoIndex) continue;
            means[at(c)] += features_[s];
            sizes[at(c)] += 1.0;
        }
        for (std::size_t c = 0; c < means.size(); ++c) means[c] /= sizes[c];
        std::vector<double> least(at(count_), std::numeric_limits<double>::infinity());
        clusters.medoids.assign(at(count_), kNoIndex);
        for (std::size_t s = 0; s < clusters.of_strand.size(); ++s) {
            const Index c = clusters.of_strand[s];
            if (c == kNoIndex) continue;
            const double distance = (features_[s] - means[at(c)]).squaredNorm();
            if (distance >= least[at(c)]) continue;
            least[at(c)] = distance;
            clusters.medoids[at(c)] = index_of(s);
        }
    }

    const Strands& strands_;
    const ClusterOptions& options_;
    const Context& context_;
    std::vector<Feature> features_;
    std::vector<char> has_length_;
    // ClusterPart of each strand in its family; kNoIndex for strands without length.
    std::vector<Index> unit_of_;
    std::map<FamilyKey, ClusterFamily> families_;
    Index count_ = 0;
};

}  // namespace

StrandClusters cluster_strands(const Strands& strands, const ClusterOptions& options,
                               const Context& context) {
    require_clusters(strands, options);
    return Clustering(strands, options, context).run();
}

}  // namespace lissom
