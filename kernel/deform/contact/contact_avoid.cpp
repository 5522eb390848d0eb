#include "kernel/deform/contact/contact_avoid.h"

#include <memory>
#include <optional>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/contact/kept_contacts.h"
#include "kernel/deform/contact/penetration.h"
#include "kernel/deform/contact/separation.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

constexpr int kMostRounds = 3;

// A push is taken if it leaves at most this share of the contacts. Parts that have run right
// through one another have no way out: they would be crushed for little.
constexpr double kMostLeft = 2.0 / 3.0;

// Pushes the contacts of one frame apart.
class Avoiding {
  public:
    Avoiding(std::shared_ptr<const Preparation> prepared, const Mesh& mesh, ContactSearch& search,
             const Context& context)
        : prepared_(std::move(prepared)), mesh_(mesh), search_(search), context_(context) {}

    std::vector<FacePair> contacts_of(const DeformFrame& frame) const {
        return lissom::contacts_of(search_, *rest_of(*prepared_), *constraints_of(*prepared_),
                                   frame, context_);
    }

    // Makes `frame` the round with the fewest contacts, if that leaves few enough.
    void go(DeformFrame& frame, AvoidedContacts& result) {
        const DeformFrame plain = frame;
        Separation separation(*prepared_, plain, context_);
        Mesh shape = mesh_;
        write_rest(*rest_of(*prepared_), shape);
        const SpatialTree rest(shape, context_);
        std::vector<FacePair> contacts = result.contacts;
        DeformFrame pushed = plain;
        for (int round = 1; round <= kMostRounds && !contacts.empty(); ++round) {
            write_frame(*rest_of(*prepared_), pushed, shape);
            const auto penetrations = find_penetrations(shape, rest, contacts, context_);
            if (penetrations.empty() || !separation.add(penetrations, context_)) return;
            separation.solve(context_);
            pushed = plain;
            separation.displace(pushed);
            contacts = contacts_of(pushed);
            result.rounds = round;
            if (contacts.size() >= result.contacts.size()) continue;
            if (static_cast<double>(contacts.size()) > kMostLeft * result.before) continue;
            result.contacts = contacts;
            frame = pushed;
        }
    }

  private:
    std::shared_ptr<const Preparation> prepared_;
    const Mesh& mesh_;
    ContactSearch& search_;
    const Context& context_;
};

}  // namespace

AvoidedContacts solve_avoiding_contacts(Deformer& deformer, const Mesh& mesh,
                                        const Context& given) {
    require_same_topology(mesh, deformer.region().topology(), "the deformer");
    auto& state = DeformerAccess::state(deformer);
    const Context& context = state.chosen(given);
    return with_memory_errors([&] {
        require_implicit(state.options(), "avoiding contacts");
        const auto prepared = state.prepare(context);
        ContactSearch& search = contact_search(state.contacts, state.rest, mesh, context);
        DeformFrame frame =
            solve_frame(prepared, state.poses, state.scratch, FrameQuality::full, context);
        Avoiding avoiding(prepared, mesh, search, context);
        AvoidedContacts result;
        result.contacts = avoiding.contacts_of(frame);
        result.before = count_of(result.contacts);
        // A frame at rest has no preparation.
        if (result.before > 0 && frame.preparation) avoiding.go(frame, result);
        state.show(std::move(frame));
        return result;
    });
}

}  // namespace lissom
