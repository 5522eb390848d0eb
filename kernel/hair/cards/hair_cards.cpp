#include "kernel/hair/cards/hair_cards.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/cards/card_maker.h"
#include "kernel/hair/cards/card_slots.h"
#include "kernel/hair/guides/strand_clusters.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

// Strands out of the plane of their card count as a tuft from this part of their spread within it
// on, and from this number of metres on.
constexpr double kTuftPart = 0.5, kTuftThickness = 0.003;

// Clusters of fewer than this part of the mean number of strands are stray.
constexpr double kLeastMembers = 0.1;

// One card in so many may be missing.
constexpr Index kFewLeft = 20;

constexpr Index kMaxSections = 64, kMaxCardTriangles = 2 * (kMaxSections - 1);

void require_cards(const CardOptions& options) {
    require(options.count >= 1 && options.count <= kMaxCards, "ask for 1 to 100000 cards");
    require(options.sections >= 2 && options.sections <= kMaxSections,
            "cards have 2 to 64 sections");
    require(options.triangles == 0 || options.triangles >= 2 * options.count,
            "each card needs two triangles: give fewer cards or more triangles");
    require(options.triangles <= kMaxCardTriangles * options.count,
            "a card has at most 126 triangles: give more cards or fewer triangles");
    require(options.slots >= 1 && options.slots <= 256, "there are 1 to 256 slots");
    require(options.coverage > 0.0 && options.coverage <= 1.0, "coverage is above 0, at most 1");
    require(options.bend >= 0.0 && options.bend <= 1.0, "bend is 0 to 1");
    require(std::isfinite(options.clearance) && options.clearance >= 0.0,
            "the clearance must be finite and not negative");
}

Index sections_of(const CardOptions& options, Index cards) {
    if (options.triangles == 0) return options.sections;
    return std::clamp(options.triangles / (2 * cards) + 1, 2, kMaxSections);
}

StrandClusters clusters_for(const Strands& strands, Index count, const Context& context) {
    const std::vector<std::uint32_t>& ids = strands.guides().ids;
    const std::set<std::uint32_t> guides(ids.begin(), ids.end());
    ClusterOptions clusters;
    clusters.count = count;
    const Index locks = count_of(guides);
    if (locks > 1 && locks <= 2 * count) {
        clusters.unit = locks <= count ? ClusterUnit::within_lock : ClusterUnit::lock;
    }
    return cluster_strands(strands, clusters, context);
}

// Clusters of strands and their cards.
class CardPlan {
  public:
    CardPlan(const Strands& strands, const Strands& even, const CardOptions& options,
             const Context& context)
        : strands_(strands), even_(even), options_(options), context_(context) {}

    std::vector<Card> cards(Index count) {
        const StrandClusters clusters = clusters_for(strands_, count, context_);
        std::vector<std::vector<Index>> members(clusters.medoids.size());
        Vec3 middle = Vec3::Zero();
        double counted = 0.0;
        for (Index s = 0; s < strands_.size(); ++s) {
            const Index c = clusters.of_strand[at(s)];
            if (c == kNoIndex) continue;
            members[at(c)].push_back(s);
            middle += strands_.root(s).cast<double>();
            counted += 1.0;
        }
        middle_ = middle / counted;
        std::vector<Index> medoids = clusters.medoids;
        drop_stray(counted, members, medoids);
        sections_ = sections_of(options_, std::min(options_.count, strands_.size()));
        std::vector<Card> cards(members.size());
        context_.parallel_for(0, count_of(members), 4, [&](Index begin, Index end) {
            for (Index c = begin; c < end; ++c) {
                cards[at(c)] = make_card(ground(), CardPlane::alone, std::move(members[at(c)]),
                                         medoids[at(c)]);
            }
        });
        return cards;
    }

    // Cards whose strands are about as thick a tuft as it is wide, the thickest first.
    std::vector<Index> tufts(const std::vector<Card>& cards) const {
        std::vector<double> thick(cards.size(), 0.0);
        context_.parallel_for(0, count_of(cards), 4, [&](Index begin, Index end) {
            for (Index c = begin; c < end; ++c) {
                const CardSpread spread = spread_of(cards[at(c)], even_);
                if (spread.out > kTuftPart * spread.across) thick[at(c)] = spread.out;
            }
        });
        std::vector<Index> list;
        for (Index c = 0; c < count_of(cards); ++c) {
            if (thick[at(c)] > kTuftThickness) list.push_back(c);
        }
        std::stable_sort(list.begin(), list.end(),
                         [&](Index a, Index b) { return thick[at(a)] > thick[at(b)]; });
        return list;
    }

    // Clusters anew, fewer by as many as are tufts, and gives those a second card.
    std::vector<Card> with_crossed(std::vector<Card> alone) {
        const Index all = options_.count;
        const auto missing = [&](const std::vector<Card>& cards) {
            return all - count_of(cards) - count_of(tufts(cards));
        };
        const Index tufts_before = count_of(tufts(alone));
        if (tufts_before == 0) return alone;
        const double part = static_cast<double>(all) / (all + tufts_before);
        std::vector<Card> fewer = cards(std::max<Index>(1, static_cast<Index>(part * all)));
        // Wider clusters are less often as thick as wide.
        const Index left = missing(fewer);
        if (left > all / kFewLeft) fewer = cards(count_of(fewer) + left);
        cross(fewer);
        return fewer;
    }

    // Gives tufts a second card through the first, as far as the count allows.
    void cross(std::vector<Card>& cards) const {
        const auto room = static_cast<std::size_t>(std::max(0, options_.count - count_of(cards)));
        std::vector<Index> list = tufts(cards);
        list.resize(std::min(list.size(), room));
        const std::size_t first = cards.size();
        cards.resize(first + list.size());
        context_.parallel_for(0, count_of(list), 4, [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                Card& card = cards[at(list[at(i)])];
                Card& second = cards[first + at(i)];
                second = make_card(ground(), CardPlane::crossing, card.strands, card.medoid);
                second.crosses = list[at(i)];
                card =
                    make_card(ground(), CardPlane::crossed, std::move(card.strands), card.medoid);
            }
        });
    }

  private:
    // Drops clusters of few strands: a card would show them as wide as a lock.
    static void drop_stray(double counted, std::vector<std::vector<Index>>& members,
                           std::vector<Index>& medoids) {
        const double least = kLeastMembers * counted / static_cast<double>(members.size());
        std::size_t kept = 0;
        for (std::size_t c = 0; c < members.size(); ++c) {
            if (static_cast<double>(members[c].size()) < least) continue;
            medoids[kept] = medoids[c];
            if (kept != c) members[kept] = std::move(members[c]);
            ++kept;
        }
        members.resize(kept);
        medoids.resize(kept);
    }

    CardGround ground() const { return {even_, options_, sections_, middle_}; }

    const Strands& strands_;
    const Strands& even_;
    const CardOptions& options_;
    const Context& context_;
    Index sections_ = 2;
    Vec3 middle_ = Vec3::Zero();
};

// Points count once, where two cards cross on the nearer one.
void measure_cards(const Strands& even, HairCards& cards) {
    std::vector<const Card*> second(cards.cards.size(), nullptr);
    for (const Card& card : cards.cards) {
        if (card.crosses != kNoIndex) second[at(card.crosses)] = &card;
    }
    double inside = 0.0, all = 0.0, squares = 0.0;
    for (std::size_t c = 0; c < second.size(); ++c) {
        const Card& card = cards.cards[c];
        if (card.crosses != kNoIndex) continue;
        for (const Index s : card.strands) {
            for (Index k = 0; k < kCardPoints; k += 3) {
                const Vec3 point = point_of(even.strand(s), k);
                CardPoint p = place_on_card(card, point);
                if (second[c]) {
                    const CardPoint other = place_on_card(*second[c], point);
                    if (std::abs(other.out) < std::abs(p.out)) p = other;
                }
                inside += std::abs(p.u) <= 1.0 ? 1.0 : 0.0;
                squares += p.out * p.out;
                all += 1.0;
            }
        }
    }
    cards.covered = inside / std::max(all, 1.0);
    cards.rms = std::sqrt(squares / std::max(all, 1.0));
}

}  // namespace

double Card::length() const {
    double sum = 0.0;
    for (std::size_t k = 1; k < sections.size(); ++k) {
        sum += (sections[k].center - sections[k - 1].center).norm();
    }
    return sum;
}

CardPoint place_on_card(const Card& card, const Vec3& point) {
    CardPoint best;
    double least = std::numeric_limits<double>::infinity();
    const auto last = count_of(card.sections) - 1;
    for (Index k = 0; k < last; ++k) {
        const CardSection &a = card.sections[at(k)], &b = card.sections[at(k + 1)];
        const Vec3 along = b.center - a.center;
        const double square = along.squaredNorm();
        double part = square > 0.0 ? (point - a.center).dot(along) / square : 0.0;
        part = std::clamp(part, k == 0 ? -0.5 : 0.0, k + 1 == last ? 1.5 : 1.0);
        const Vec3 d = point - (a.center + part * along);
        if (d.squaredNorm() >= least) continue;
        least = d.squaredNorm();
        const double u = std::clamp(part, 0.0, 1.0);
        const Vec3 across = (a.across + u * (b.across - a.across)).normalized();
        const Vec3 out = (a.out + u * (b.out - a.out)).normalized();
        const double width = a.half_width + u * (b.half_width - a.half_width);
        best = {d.dot(across) / width, (k + part) / last, d.dot(out)};
    }
    return best;
}

HairCards make_cards(const Strands& strands, const CardOptions& options, const Context& context) {
    require_cards(options);
    Progress progress(context, "make cards");
    const Strands even = resample(strands, {.count = kCardPoints}, context);
    CardPlan plan(strands, even, options, context);
    HairCards result;
    result.cards = plan.cards(options.count);
    if (options.crossed) result.cards = plan.with_crossed(std::move(result.cards));
    share_slots(even, options.slots, result);
    measure_cards(even, result);
    return result;
}

}  // namespace lissom
