#include "kernel/deform/contact/contact_stop.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/contact/kept_contacts.h"
#include "kernel/deform/contact/pose_path.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/frame/tears.h"

namespace lissom {
namespace {

// The way is sampled by steps of this share of the region's size, and at most so many.
constexpr double kSample = 0.1;
constexpr double kMostSamples = 64.0;
// The place of a contact is found to this share of the way.
constexpr double kPlace = 1e-3;

struct Sample {
    double share = 0.0;
    DeformFrame frame;
    std::vector<FacePair> contacts;
};

// Goes along a path of poses, frame by frame.
class Walk {
  public:
    Walk(std::shared_ptr<const Preparation> prepared, const PosePath& path, ContactSearch& search,
         FrameScratch& scratch, const Context& context)
        : prepared_(std::move(prepared)),
          path_(path),
          search_(search),
          scratch_(scratch),
          context_(context) {}

    // Makes `last` the last sample before contacts appear, and returns the first one after it, or
    // the end.
    Sample go(Sample& last) const {
        last = sample(0.0);
        const std::size_t allowed = last.contacts.size();
        const double count = sample_count();
        for (double i = 1.0; i <= count; i += 1.0) {
            Sample next = sample(i / count);
            if (next.contacts.size() > allowed) return narrow(last, std::move(next), allowed);
            last = std::move(next);
        }
        return {1.0, {}, {}};
    }

  private:
    double sample_count() const {
        const double size = rest_of(*prepared_)->size;
        return std::clamp(std::ceil(path_.length() / (kSample * size)), 1.0, kMostSamples);
    }

    Sample sample(double share) const {
        Sample made;
        made.share = share;
        made.frame =
            solve_frame(prepared_, path_.at(share), scratch_, FrameQuality::full, context_);
        made.contacts = contacts_of(search_, *rest_of(*prepared_), *constraints_of(*prepared_),
                                    made.frame, context_);
        return made;
    }

    Sample narrow(Sample& last, Sample next, std::size_t allowed) const {
        while (next.share - last.share > kPlace) {
            Sample middle = sample(0.5 * (last.share + next.share));
            (middle.contacts.size() > allowed ? next : last) = std::move(middle);
        }
        return next;
    }

    std::shared_ptr<const Preparation> prepared_;
    const PosePath& path_;
    ContactSearch& search_;
    FrameScratch& scratch_;
    const Context& context_;
};

}  // namespace

ContactStop solve_until_contact(Deformer& deformer, const Mesh& mesh, const Context& given) {
    require_same_topology(mesh, deformer.region().topology(), "the deformer");
    auto& state = DeformerAccess::state(deformer);
    const Context& context = state.chosen(given);
    return with_memory_errors([&] {
        // Targets have an order of their own for each constraint set.
        const bool same = state.preparation && state.preparation->rest == state.rest &&
                          state.preparation->constraints == state.constraints;
        Poses from = state.shown->poses;
        if (!same || from.targets.size() != state.poses.targets.size()) {
            from.targets = state.poses.targets;
        }
        const auto prepared = state.prepare(context);
        ContactSearch& search = contact_search(state.contacts, state.rest, mesh, context);
        const PosePath path(*state.rest, *state.constraints, std::move(from), state.poses);
        Sample last;
        Sample next = Walk(prepared, path, search, state.scratch, context).go(last);
        Poses reached = last.frame.poses;
        state.show(std::move(last.frame));
        state.poses = std::move(reached);
        const std::vector<Tear> tears = tears_of(*prepared, state.poses);
        if (!tears.empty()) {
            context.log(LogLevel::warning, tear_warning(*prepared, tears).message);
        }
        return ContactStop{last.share, std::move(next.contacts)};
    });
}

}  // namespace lissom
