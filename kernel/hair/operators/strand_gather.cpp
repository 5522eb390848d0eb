#include "kernel/hair/operators/strand_gather.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/operators/guide_table.h"
#include "kernel/hair/strands/strand_random.h"

namespace lissom {
namespace {

constexpr std::uint64_t kSpreadStream = 11;

void require_measure(double value, const char* message) {
    require(value >= 0.0 && std::isfinite(value), message);
}

// Moves strands that follow a guide: `target(work, guide, k, center, below)` is the place wanted
// for a point, `center` the guide's point that belongs to it. It weighs the effect itself unless
// `blends`. Guides assigned before an error go again.
template <typename Prepare>
void move_to_guides(Strands& strands, const StrandOperatorOptions& options, Index guides,
                    bool blends, const Prepare& prepare, const Context& context) {
    require_operator(strands, options);
    if (options.factor == 0.0) return;
    StrandGuides before = strands.guides();
    ensure_guides(strands, guides, context);
    try {
        const GuideTable table(strands);
        const std::vector<float>& arcs = strands.guides().arcs;
        const auto change = [&](StrandWork& work) {
            const Index s = work.strand();
            if (!table.follows(s)) return;
            const Index guide = table.guide_of(s);
            const double stretch =
                std::min<double>(arcs[at(s)], table.length(guide)) / work.length();
            const auto target = prepare(work, guide);
            Index below = 0;
            for (Index k = 1; k < work.count(); ++k) {
                const Vec3 center = table.at_arc(guide, stretch * work.arc(k), below);
                work.set_point(k, target(k, center, table.tangent(guide, below)));
            }
            if (blends) work.blend();
            if (!blends && options.keep_length) work.restore_lengths();
        };
        change_strands(strands, options, change, context);
    } catch (...) {
        strands.set_guides(std::move(before));
        throw;
    }
}

// About the distribution of a sum of three even ones; the standard deviation is 1.
Vec3 spread_of(std::uint64_t seed, std::uint32_t id) {
    return random_vector(seed, id, kSpreadStream) + random_vector(seed, id, kSpreadStream + 1) +
           random_vector(seed, id, kSpreadStream + 2);
}

}  // namespace

void gather(Strands& strands, const GatherOptions& options, const Context& context) {
    require_measure(options.ramp, "the ramp of gather must be finite and not negative");
    require_measure(options.spread, "the spread of gather must be finite and not negative");
    Progress progress(context, "gather strands");
    const auto prepare = [&](const StrandWork& work, Index) {
        const Vec3 apart = options.spread * spread_of(options.seed, work.id());
        return [&work, &options, apart](Index k, const Vec3& center, const Vec3&) -> Vec3 {
            const Vec3 old = work.old_point(k);
            const double part = smooth_step(0.0, options.ramp, work.arc(k));
            return old + part * (center + apart - old);
        };
    };
    move_to_guides(strands, options, options.guides, true, prepare, context);
}

void twist(Strands& strands, const TwistOptions& options, const Context& context) {
    require(options.wavelength != 0.0 && std::isfinite(options.wavelength),
            "the wavelength of twist must be finite and not 0");
    require_measure(options.ramp, "the ramp of twist must be finite and not negative");
    Progress progress(context, "twist strands");
    const auto prepare = [&](const StrandWork& work, Index) {
        return [&work, &options](Index k, const Vec3& center, const Vec3& tangent) -> Vec3 {
            const Vec3 apart = work.old_point(k) - center;
            const double turns = work.arc(k) / options.wavelength *
                                 smooth_step(0.0, options.ramp, work.arc(k)) * work.weight(k);
            const double c = cosine_of_turns(turns), s = sine_of_turns(turns);
            return center + c * apart + s * tangent.cross(apart) +
                   (1.0 - c) * tangent.dot(apart) * tangent;
        };
    };
    move_to_guides(strands, options, options.guides, false, prepare, context);
}

void pinch(Strands& strands, const PinchOptions& options, const Context& context) {
    require(options.place >= 0.0 && options.place <= 1.0, "the place of pinch must be from 0 to 1");
    require(options.width > 0.0 && std::isfinite(options.width),
            "the width of pinch must be positive and finite");
    Progress progress(context, "pinch strands");
    const auto prepare = [&](const StrandWork& work, Index) {
        return [&work, &options](Index k, const Vec3& center, const Vec3&) -> Vec3 {
            const double away = (work.t(k) - options.place) / options.width;
            const Vec3 old = work.old_point(k);
            return old + std::exp(-away * away) * (center - old);
        };
    };
    move_to_guides(strands, options, options.guides, true, prepare, context);
}

}  // namespace lissom
