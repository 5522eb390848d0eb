#include "kernel/deform/contact/contacts.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/contact/kept_contacts.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"

namespace lissom {
namespace {

// Vertices this near to their place, as a share of the size, move with a part.
constexpr double kSamePlaceOfPart = 1e-11;
// Greatest difference of the entries of a similarity's M^T M from a multiple of the identity.
constexpr double kSimilarity = 1e-11;

// Puts the vertices of a region to `positions`, in its order.
void place(std::vector<Vec3>& shape, const Region& region, std::span<const Vec3> positions) {
    for (Index row = 0; row < region.size(); ++row) {
        shape[at(region.vertices()[at(row)])] = positions[at(row)];
    }
}

// Whether the mesh lies beside the region as it did when the search was made.
bool fits(const KeptContacts& kept, const RestShape& rest, const Mesh& mesh) {
    if (kept.rest.get() != &rest) return false;
    auto inside = rest.region().vertices().begin();
    const auto end = rest.region().vertices().end();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (inside != end && *inside == v) {
            ++inside;
        } else if (mesh.position(v) != kept.search.rest()[at(v)]) {
            return false;
        }
    }
    return true;
}

bool is_similarity(const Mat3& linear) {
    const Mat3 square = linear.transpose() * linear;
    const double scale = square.trace() / 3.0;
    return scale > 0.0 &&
           (square - scale * Mat3::Identity()).cwiseAbs().maxCoeff() <= kSimilarity * scale;
}

// Finds the parts of a frame that lie as at rest up to a similarity: 0 is what has not moved, and
// h + 1 what moves with handle h, or as it does.
class PartsOfFrame {
  public:
    PartsOfFrame(const RestShape& rest, const DeformFrame& frame, Index vertex_count)
        : rest_(rest), frame_(frame), part_(at(vertex_count), 0) {
        for (Index row = 0; row < rest.region().size(); ++row) {
            const bool stays = frame.positions[at(row)] == rest.positions[at(row)];
            part_[at(rest.region().vertices()[at(row)])] = stays ? 0 : kNoIndex;
        }
    }

    void add(const ConstraintSet& constraints) {
        const auto& poses = frame_.poses.handles;
        const std::size_t count = std::min(constraints.handles.size(), poses.size());
        for (std::size_t h = 0; h < count; ++h) {
            const auto& handle = constraints.handles[h];
            const Affine& moved = poses[h].local_transform;
            if (!handle || moved.is_identity() || !is_similarity(moved.linear)) continue;
            std::size_t same = 0;
            while (!(poses[same].local_transform == moved)) ++same;
            add(*handle, moved, index_of(same) + 1);
        }
    }

    std::vector<Index>& parts() { return part_; }

  private:
    // Vertices that the handle no longer holds, or did not hold in this frame, may lie elsewhere.
    void add(const Handle& handle, const Affine& transform, Index part) {
        const Vec3& origin = rest_.origin();
        const double apart = kSamePlaceOfPart * rest_.size;
        const auto& rows = rest_.region().vertices();
        auto row_at = rows.begin();
        for (const Index v : handle.region.vertices()) {
            row_at = std::lower_bound(row_at, rows.end(), v);
            const std::size_t row = at(index_of(row_at - rows.begin()));
            const Vec3 place = origin + transform(rest_.positions[row] - origin);
            const double off = (frame_.positions[row] - place).cwiseAbs().maxCoeff();
            if (off <= apart) part_[at(v)] = part;
        }
    }

    const RestShape& rest_;
    const DeformFrame& frame_;
    std::vector<Index> part_;
};

}  // namespace

ContactSearch& contact_search(std::shared_ptr<KeptContacts>& kept,
                              const std::shared_ptr<const RestShape>& rest, const Mesh& mesh,
                              const Context& context) {
    require_surroundings(*rest, mesh);
    if (!kept || !fits(*kept, *rest, mesh)) {
        kept.reset();
        Mesh at_rest = mesh;
        write_rest(*rest, at_rest);
        kept = std::make_shared<KeptContacts>(rest, at_rest, context);
    }
    return kept->search;
}

std::vector<FacePair> contacts_of(ContactSearch& search, const RestShape& rest,
                                  const ConstraintSet& constraints, const DeformFrame& frame,
                                  const Context& context) {
    std::vector<Vec3> shape = search.rest();
    place(shape, rest.region(), frame.positions);
    PartsOfFrame parts(rest, frame, count_of(shape));
    parts.add(constraints);
    return search.find(shape, parts.parts(), context);
}

std::vector<FacePair> contacts_of(Deformer& deformer, const Mesh& mesh, const Context& given) {
    require_same_topology(mesh, deformer.region().topology(), "the deformer");
    auto& state = DeformerAccess::state(deformer);
    const Context& context = state.chosen(given);
    return with_memory_errors([&] {
        Progress progress(context, "contacts");
        ContactSearch& search = contact_search(state.contacts, state.rest, mesh, context);
        return contacts_of(search, *state.rest, *state.constraints, *state.shown, context);
    });
}

}  // namespace lissom
