#include "kernel/deform/contact/contact_avoid.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
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

// Pushes that are tried, from firm to soft; see Separation::solve.
constexpr std::array kSoftness = {0.02, 0.2, 0.6};
// A push that increases the stretch of an edge by more than this factor crumples the surface.
constexpr double kMostCrumple = 2.0;

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

    // The greatest factor by which a push increases the stretch of an edge of the region: the
    // factor by which it is longer or shorter than at rest.
    double crumple(const DeformFrame& pushed, const DeformFrame& plain) const {
        const RestShape& rest = *rest_of(*prepared_);
        const Topology& topology = *rest.region().topology();
        const std::vector<Index>& vertices = rest.region().vertices();
        std::vector<Index> row(at(topology.vertex_count()), kNoIndex);
        for (std::size_t i = 0; i < vertices.size(); ++i) row[at(vertices[i])] = index_of(i);
        double most = 1.0;
        for (const Index v : vertices) {
            for (const Index w : topology.neighbors(v)) {
                const Index a = row[at(v)], b = row[at(w)];
                if (b < a) continue;  // once, and within the region
                const double length = edge(rest.positions, a, b);
                if (!(length > 0.0)) continue;
                most = std::max(most, stretch(edge(pushed.positions, a, b) / length) /
                                          stretch(edge(plain.positions, a, b) / length));
            }
        }
        return most;
    }

    // Makes `frame` the round with the fewest contacts, if that leaves few enough.
    void go(DeformFrame& frame, AvoidedContacts& result) {
        const DeformFrame plain = frame;
        Separation separation(*prepared_, plain, context_);
        Mesh shape = mesh_;
        write_rest(*rest_of(*prepared_), shape);
        const SpatialTree rest(shape, context_);
        DeformFrame pushed = plain;
        std::vector<FacePair> contacts = result.contacts;
        while (result.rounds < kMostRounds && !contacts.empty()) {
            write_frame(*rest_of(*prepared_), pushed, shape);
            const auto penetrations = find_penetrations(shape, rest, contacts, context_);
            if (penetrations.empty() || !separation.add(penetrations, context_)) return;
            ++result.rounds;
            if (!push(separation, plain, pushed)) return;
            contacts = contacts_of(pushed);
            if (contacts.size() >= result.contacts.size()) continue;
            if (static_cast<double>(contacts.size()) > kMostLeft * result.before) continue;
            result.contacts = contacts;
            frame = pushed;
        }
    }

  private:
    static double edge(std::span<const Vec3> positions, Index a, Index b) {
        return (positions[at(a)] - positions[at(b)]).norm();
    }
    static double stretch(double factor) {
        constexpr double kLeast = 1e-9;
        return std::max(factor, 1.0 / std::max(factor, kLeast));
    }

    // Makes `pushed` the displaced frame. A thin part may crumple under a push: then a softer one
    // is tried. Returns false if all of them crumple it.
    bool push(Separation& separation, const DeformFrame& plain, DeformFrame& pushed) const {
        for (const double softness : kSoftness) {
            separation.solve(softness, context_);
            pushed = plain;
            separation.displace(pushed);
            if (crumple(pushed, plain) <= kMostCrumple) return true;
        }
        return false;
    }

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
        require_whole_surface(state.options(), "avoiding contacts");
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
