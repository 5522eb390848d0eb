// A refinement is taken back where it would harm the surface: softly as parts of it come near to
// one another or edges stretch, and wholly before faces cross if none do without it.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "kernel/deform/frame/frame_steps.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// Stretch up to here does no harm; above it, and above that without refinement, twice as much is
// refused.
constexpr double kHarmless = 1.5;

// Closeness at which nothing of a refinement is kept. It leaves room for the surface between the
// samples, and for the one without refinement to meet in its turn.
constexpr double kTooClose = 0.25;

// How often the kept share is halved between one that is harmless and one that is not.
constexpr int kHalvings = 6;

// The share of a refinement that is kept. It follows from measures that are continuous in the pose,
// so that a path of poses does not jump; the number of crossings only guards it.
class RefinementShare {
  public:
    RefinementShare(const SecondInput& input, MovingSurface& surface, const Deviation& refined,
                    RefineRoom& room, const Context& context)
        : input_(input), surface_(surface), context_(context), refined_(refined), room_(room) {
        find_shape(room_.plain, room_.plain_shape);
    }

    double find() {
        find_shape(refined_, room_.shape);
        const double share = roominess() * firmness();
        if (!(share > 0.0) || harmless(share)) return share;
        double kept = 0.0, refused = share;
        for (int halving = 0; halving < kHalvings; ++halving) {
            const double middle = 0.5 * (kept + refused);
            (harmless(middle) ? kept : refused) = middle;
        }
        return kept;
    }

  private:
    double roominess() {
        return smooth_step((surface_.closeness(room_.shape) - kTooClose) / (1.0 - kTooClose));
    }

    double firmness() const {
        const double limit = std::max(kHarmless, surface_.stretch(room_.plain_shape));
        return 1.0 - smooth_step(surface_.stretch(room_.shape) / limit - 1.0);
    }

    // Whether no faces cross, or some do without refinement.
    bool harmless(double share) {
        find_between(share);
        find_shape(room_.between, room_.shape);
        return !surface_.crosses(room_.shape, context_) || plain_crosses();
    }

    bool plain_crosses() {
        if (!plain_crosses_) plain_crosses_ = surface_.crosses(room_.plain_shape, context_);
        return *plain_crosses_;
    }

    void find_between(double share) {
        const Deviation& plain = room_.plain;
        room_.between.resize(plain.size());
        for (std::size_t v = 0; v < plain.size(); ++v) {
            room_.between[v] = plain[v] + share * (refined_[v] - plain[v]);
        }
    }

    void find_shape(const Deviation& result, std::vector<Vec3>& shape) {
        const FrameInput& motion = input_.motion;
        const Preparation& prepared = motion.prepared();
        const Patch& patch = motion.patch();
        const Vec3 shift = motion.base().topRightCorner<3, 1>() + patch.origin;
        std::vector<Vec3>& positions = room_.of_region;
        positions.assign(prepared.rest->positions.begin(), prepared.rest->positions.end());
        positions.resize(positions.size() + patch.inserted.size(), Vec3::Zero());
        for (Index v = 0; v < patch.real_count; ++v) {
            const Index row = prepared.rest->frame_row(patch, v);
            if (row == kNoIndex) continue;
            positions[at(row)] = prepared.known.position[at(v)]
                                     ? Vec3(motion.known_position(v) + patch.origin)
                                     : Vec3(input_.base_rotation * patch.rest[at(v)] + shift +
                                            result[at(v)].head<3>());
        }
        place_followers(prepared, motion.poses(), positions);
        surface_.place(positions, shape);
    }

    const SecondInput& input_;
    MovingSurface& surface_;
    const Context& context_;
    const Deviation& refined_;
    RefineRoom& room_;
    std::optional<bool> plain_crosses_;
};

MovingSurface& moving_surface(const SecondInput& input, FrameScratch::State& scratch,
                              const Context& context) {
    if (!scratch.surface || scratch.surface_of.lock() != scratch.sized_for.lock()) {
        scratch.surface.emplace(input.motion.prepared(), context);
        scratch.surface_of = scratch.sized_for;
    }
    return *scratch.surface;
}

}  // namespace

void limit_refinement(const SecondInput& input, FrameScratch::State& scratch,
                      const Context& context) {
    const Deviation& plain = scratch.refine.plain;
    Deviation& result = scratch.deviation;
    MovingSurface& surface = moving_surface(input, scratch, context);
    const double share = RefinementShare(input, surface, result, scratch.refine, context).find();
    if (share == 1.0) return;
    for (std::size_t v = 0; v < plain.size(); ++v) {
        result[v] = plain[v] + share * (result[v] - plain[v]);
    }
}

}  // namespace lissom
