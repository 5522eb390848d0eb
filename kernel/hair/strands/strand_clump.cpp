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
    require(options.clumps >= 0, "the number of clumps must not be negative");
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
    Vec3 root;
    /// The strength with its variation, and the target of its tip.
    double strength;
    Vec3 offset;
};

class Clumps {
  public:
    Clumps(const Strands& strands, const ClumpOptions& options, std::vector<Index> guide_of)
        : strands_(strands), options_(options), guide_of_(std::move(guide_of)) {
        for (const Index s : guide_of_) {
            if (s != kNoIndex && !guides_.contains(s)) guides_.emplace(s, make_guide(s));
        }
    }

    void pull(StrandWork& work) const {
        const Index s = work.strand(), number = guide_of_[at(s)];
        if (number == kNoIndex) return;
        const Guide* const guide = &guides_.at(number);
        const StrandView old = work.old_points();
        const double reach = guide->strength * falloff(old, *guide);
        if (reach <= 0.0) return;
        const Vec3 tip = options_.tip_spread * random_vector(options_.seed, work.id(), kTipStream) +
                         guide->offset;
        const GuideCurve::Point root = guide->curve.at(0.0);
        const Vec3 apart = root.frame.transpose() * (work.old_point(0) - root.position);
        for (Index k = 1; k < work.count(); ++k) {
            const double along = work.t(k);
            const double s_t = options_.shape == 1.0 ? along : std::pow(along, options_.shape);
            const GuideCurve::Point center = guide->curve.at(along);
            const Vec3 target = center.position + (1.0 - s_t) * (center.frame * apart) + s_t * tip;
            const Vec3 p = work.old_point(k);
            work.set_point(k, p + s_t * reach * (target - p));
        }
        work.blend();
    }

  private:
    Guide make_guide(Index s) const {
        const StrandView strand = strands_.strand(s);
        const std::uint32_t id = strands_.id(s);
        const double random = signed_random(mixed(options_.seed, id, kStrengthStream));
        const double strength = options_.strength * (1.0 + options_.variation * random);
        return {GuideCurve(strand), strand.col(0).cast<double>(), std::clamp(strength, 0.0, 1.0),
                options_.offset * random_vector(options_.seed, id, kOffsetStream)};
    }

    // 1 at the guide's root, 0 from the radius on, level at both.
    double falloff(const StrandView& strand, const Guide& guide) const {
        if (!std::isfinite(options_.radius)) return 1.0;
        const Vec3 root = strand.col(0).cast<double>();
        const double d = std::min(1.0, (root - guide.root).norm() / options_.radius);
        return 1.0 - d * d * (3.0 - 2.0 * d);
    }

    const Strands& strands_;
    const ClumpOptions& options_;
    std::vector<Index> guide_of_;
    std::map<Index, Guide> guides_;
};

std::vector<Index> clump_guides(const Strands& strands, const ClumpOptions& options,
                                const Context& context) {
    // Fewer than so many strands in a clump are not seen to gather.
    constexpr Index kUsualClumps = 900, kFewInClump = 8;
    if (options.clumps == 0 && !strands.guides().ids.empty()) return present_guides(strands);
    GuideOptions guides;
    guides.count = options.clumps;
    if (guides.count == 0) {
        guides.count = std::clamp(strands.size() / kFewInClump, Index{1}, kUsualClumps);
    }
    guides.apart = options.apart;
    guides.within_groups = options.within_groups;
    return nearest_guides(strands, guides, context);
}

}  // namespace

void clump(Strands& strands, const ClumpOptions& options, const Context& context) {
    require_clump(options);
    Progress progress(context, "clump strands");
    // Keys, guides and weights of strands.
    const MemoryCharge working = context.charge(2 * strands.memory_bytes(), "clumping strands");
    const Clumps clumps(strands, options, clump_guides(strands, options, context));
    StrandOperatorOptions effect = options.effect;
    effect.keep_length = options.keep_length;
    change_strands(
        strands, effect, [&](StrandWork& work) { clumps.pull(work); }, context);
}

}  // namespace lissom
