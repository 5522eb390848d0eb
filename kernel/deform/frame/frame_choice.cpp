// A refinement is taken back as far as it harms the surface: no more faces may cross or fold than
// without it, and no edge may be stretched further than the worst one there.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "kernel/deform/frame/frame_steps.h"

namespace lissom {
namespace {

// Stretch up to here does no harm.
constexpr double kHarmless = 1.5;

// A refinement kept in part is known to this share of it.
constexpr double kFinest = 1.0 / 32.0;

// The shares that are tried, so that one near the last pose's is found if the harm is small, and
// one above none as long as there is any.
constexpr std::array kShares{1.0, 31.0 / 32.0, 15.0 / 16.0, 7.0 / 8.0,  3.0 / 4.0,
                             0.5, 0.25,        1.0 / 8.0,   1.0 / 16.0, kFinest};

class RefinementLimit {
  public:
    RefinementLimit(const SecondInput& input, const MovingSurface& surface, const Deviation& plain,
                    const Context& context)
        : input_(input), surface_(surface), context_(context), plain_(shape_of(plain)) {
        stretch_ = std::max(kHarmless, surface.stretch(plain_));
        flips_ = surface.flips(plain_);
    }

    bool allows(const Deviation& result) {
        const Mesh shape = shape_of(result);
        if (surface_.stretch(shape) > stretch_ || surface_.flips(shape) > flips_) return false;
        const Index crossings = surface_.crossings(shape, context_);
        if (crossings == 0) return true;
        if (!crossings_) crossings_ = surface_.crossings(plain_, context_);
        return crossings <= *crossings_;
    }

  private:
    Mesh shape_of(const Deviation& result) const {
        const FrameInput& motion = input_.motion;
        const Preparation& prepared = motion.prepared();
        const Patch& patch = motion.patch();
        const Vec3 shift = motion.base().topRightCorner<3, 1>() + patch.origin;
        std::vector<Vec3> positions = prepared.rest->positions;
        positions.resize(positions.size() + patch.inserted.size());
        for (Index v = 0; v < patch.real_count; ++v) {
            const Index row = prepared.rest->frame_row(patch, v);
            if (row == kNoIndex) continue;
            positions[at(row)] = prepared.known.position[at(v)]
                                     ? Vec3(motion.known_position(v) + patch.origin)
                                     : Vec3(input_.base_rotation * patch.rest[at(v)] + shift +
                                            result[at(v)].head<3>());
        }
        place_followers(prepared, motion.poses(), positions);
        return surface_.shape(positions);
    }

    const SecondInput& input_;
    const MovingSurface& surface_;
    const Context& context_;
    Mesh plain_;
    double stretch_ = kHarmless;
    Index flips_ = 0;
    std::optional<Index> crossings_;
};

void between(const Deviation& first, const Deviation& last, double share, Deviation& result) {
    for (std::size_t v = 0; v < first.size(); ++v) {
        result[v] = first[v] + share * (last[v] - first[v]);
    }
}

const MovingSurface& moving_surface(const SecondInput& input, FrameScratch::State& scratch,
                                    const Context& context) {
    if (!scratch.surface || scratch.surface_of.lock() != scratch.sized_for.lock()) {
        scratch.surface.emplace(input.motion.prepared(), context);
        scratch.surface_of = scratch.sized_for;
    }
    return *scratch.surface;
}

}  // namespace

// Takes the greatest fraction without self-intersection instead of all or nothing, so that a path
// of poses does not jump when the refined surface begins to touch itself.
void limit_refinement(const SecondInput& input, const Deviation& plain,
                      FrameScratch::State& scratch, const Context& context) {
    Deviation& result = scratch.deviation;
    RefinementLimit limit(input, moving_surface(input, scratch, context), plain, context);
    if (limit.allows(result)) return;
    const Deviation refined = result;
    const auto allowed = [&](double share) {
        between(plain, refined, share, result);
        return limit.allows(result);
    };
    const auto* const found = std::find_if(kShares.begin() + 1, kShares.end(), allowed);
    double kept = found == kShares.end() ? 0.0 : *found;
    double refused = *std::prev(found);
    while (kept > 0.0 && refused - kept > kFinest) {
        const double middle = 0.5 * (kept + refused);
        (allowed(middle) ? kept : refused) = middle;
    }
    between(plain, refined, kept, result);
}

}  // namespace lissom
