#include "kernel/hair/strands/strand_clump.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strand_guides.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_operators.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr std::uint64_t kStrengthStream = 1, kOffsetStream = 2, kTipStream = 3;

void require_clump(const ClumpOptions& options) {
    require(options.clumps >= 1, "clump needs at least one guide");
    require(options.strength >= 0.0 && options.strength <= 1.0,
            "the strength of clump must be from 0 to 1");
    require(options.variation >= 0.0 && options.variation <= 1.0,
            "the variation of clump must be from 0 to 1");
    require(options.shape > 0.0 && std::isfinite(options.shape),
            "the shape of clump must be positive");
    require(options.radius > 0.0, "the radius of clump must be positive");
    require(is_length(options.apart) && is_length(options.tip_spread) && is_length(options.offset),
            "'apart', 'tip_spread' and 'offset' of clump must be finite and not negative");
}

struct Guide {
    GuideCurve curve;
    GuideKey key;
    /// The strength with its variation, and the target of its tip.
    double strength;
    Vec3 offset;
};

// The usable strands of the lowest ids, in the order of their ids.
std::vector<Index> guide_strands(const Strands& strands, Index count) {
    std::vector<Index> list;
    for (Index s = 0; s < strands.size(); ++s) {
        if (strands.point_count(s) > 1 && strands.strand(s).allFinite()) list.push_back(s);
    }
    const auto lower = [&](Index a, Index b) {
        return std::pair(strands.id(a), a) < std::pair(strands.id(b), b);
    };
    const auto last = list.begin() + std::min(count, count_of(list));
    std::partial_sort(list.begin(), last, list.end(), lower);
    list.erase(last, list.end());
    return list;
}

// The guides of one group.
struct Family {
    std::vector<Guide> guides;
    GuideTree tree{{}};

    void finish() {
        std::vector<GuideKey> keys;
        for (const Guide& guide : guides) keys.push_back(guide.key);
        tree = GuideTree(std::move(keys));
    }
};

class Clumps {
  public:
    Clumps(const Strands& strands, const ClumpOptions& options)
        : strands_(strands), options_(options) {
        for (const Index s : guide_strands(strands, options.clumps)) {
            families_[family_of(s)].guides.push_back(make_guide(s));
        }
        for (auto& entry : families_) entry.second.finish();
    }

    void pull(Index s, const StrandView& old, StrandEdit& made) const {
        const Guide* const guide = guide_of(s, old);
        if (!guide) return;
        const double reach = guide->strength * falloff(old, *guide);
        if (reach <= 0.0) return;
        const Vec3 tip =
            options_.tip_spread * random_vector(options_.seed, strands_.id(s), kTipStream) +
            guide->offset;
        const GuideCurve::Point root = guide->curve.at(0.0);
        const Vec3 apart = root.frame.transpose() * (old.col(0).cast<double>() - root.position);
        std::vector<double> t;
        arc_fractions(old, t);
        for (Index k = 1; k < old.cols(); ++k) {
            const double along = t[at(k)];
            const double s_t = options_.shape == 1.0 ? along : std::pow(along, options_.shape);
            const GuideCurve::Point center = guide->curve.at(along);
            const Vec3 target = center.position + (1.0 - s_t) * (center.frame * apart) + s_t * tip;
            const Vec3 p = old.col(k).cast<double>();
            made.col(k) = (p + s_t * reach * (target - p)).cast<float>();
        }
        if (options_.keep_length) restore_lengths(old, made);
    }

  private:
    Index family_of(Index s) const { return options_.within_groups ? strands_.group(s) : kNoIndex; }

    Guide make_guide(Index s) const {
        const StrandView strand = strands_.strand(s);
        const std::uint32_t id = strands_.id(s);
        const double random = signed_random(mixed(options_.seed, id, kStrengthStream));
        const double strength = options_.strength * (1.0 + options_.variation * random);
        return {GuideCurve(strand), guide_key(strand, options_.apart),
                std::clamp(strength, 0.0, 1.0),
                options_.offset * random_vector(options_.seed, id, kOffsetStream)};
    }

    const Guide* guide_of(Index s, const StrandView& strand) const {
        const auto family = families_.find(family_of(s));
        if (family == families_.end()) return nullptr;
        const Index nearest = family->second.tree.nearest(guide_key(strand, options_.apart));
        return nearest == kNoIndex ? nullptr : &family->second.guides[at(nearest)];
    }

    // 1 at the guide's root, 0 from the radius on, level at both.
    double falloff(const StrandView& strand, const Guide& guide) const {
        if (!std::isfinite(options_.radius)) return 1.0;
        const Vec3 root = strand.col(0).cast<double>();
        const double d = std::min(1.0, (root - guide.key.head<3>()).norm() / options_.radius);
        return 1.0 - d * d * (3.0 - 2.0 * d);
    }

    const Strands& strands_;
    const ClumpOptions& options_;
    std::map<Index, Family> families_;
};

}  // namespace

void clump(Strands& strands, const ClumpOptions& options, const Context& context) {
    require_clump(options);
    Progress progress(context, "clump strands");
    // Keys, guides and weights of strands.
    const MemoryCharge working = context.charge(2 * strands.memory_bytes(), "clumping strands");
    const Clumps clumps(strands, options);
    move_points(
        strands,
        [&](Index s, const StrandView& old, StrandEdit& made) { clumps.pull(s, old, made); },
        context);
}

}  // namespace lissom
