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
    RefinementShare(const SecondInput& input, const MovingSurface& surface, const Deviation& plain,
                    const Deviation& refined, const Context& context)
        : input_(input),
          surface_(surface),
          context_(context),
          plain_(plain),
          refined_(refined),
          plain_shape_(shape_of(plain)) {}

    double find() {
        const Mesh refined = shape_of(refined_);
        const double share = room(refined) * firmness(refined);
        if (!(share > 0.0) || harmless(share)) return share;
        double kept = 0.0, refused = share;
        for (int halving = 0; halving < kHalvings; ++halving) {
            const double middle = 0.5 * (kept + refused);
            (harmless(middle) ? kept : refused) = middle;
        }
        return kept;
    }

  private:
    double room(const Mesh& refined) const {
        return smooth_step((surface_.closeness(refined) - kTooClose) / (1.0 - kTooClose));
    }

    double firmness(const Mesh& refined) const {
        const double limit = std::max(kHarmless, surface_.stretch(plain_shape_));
        return 1.0 - smooth_step(surface_.stretch(refined) / limit - 1.0);
    }

    // Whether no faces cross, or some do without refinement.
    bool harmless(double share) {
        const Mesh shape = shape_of(between(share));
        return surface_.crossings(shape, context_) == 0 || plain_crossings() > 0;
    }

    Index plain_crossings() {
        if (!crossings_) crossings_ = surface_.crossings(plain_shape_, context_);
        return *crossings_;
    }

    Deviation between(double share) const {
        Deviation result(plain_.size());
        for (std::size_t v = 0; v < plain_.size(); ++v) {
            result[v] = plain_[v] + share * (refined_[v] - plain_[v]);
        }
        return result;
    }

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
    const Deviation& plain_;
    const Deviation& refined_;
    Mesh plain_shape_;
    std::optional<Index> crossings_;
};

const MovingSurface& moving_surface(const SecondInput& input, FrameScratch::State& scratch,
                                    const Context& context) {
    if (!scratch.surface || scratch.surface_of.lock() != scratch.sized_for.lock()) {
        scratch.surface.emplace(input.motion.prepared(), context);
        scratch.surface_of = scratch.sized_for;
    }
    return *scratch.surface;
}

}  // namespace

void limit_refinement(const SecondInput& input, const Deviation& plain,
                      FrameScratch::State& scratch, const Context& context) {
    Deviation& result = scratch.deviation;
    const MovingSurface& surface = moving_surface(input, scratch, context);
    const double share = RefinementShare(input, surface, plain, result, context).find();
    if (share == 1.0) return;
    for (std::size_t v = 0; v < plain.size(); ++v) {
        result[v] = plain[v] + share * (result[v] - plain[v]);
    }
}

}  // namespace lissom
