#include "kernel/hair/operators/strand_attach.h"

#include <utility>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_roots.h"
#include "kernel/hair/scalp/root_uvs.h"

namespace lissom {
namespace {

constexpr Index kAttachGrain = 256;

// The place of the head nearest to the root of a strand.
Root nearest_root(const Strands& strands, Index s, const Scalp& scalp) {
    const Vec3 root = strands.root(s).cast<double>() / scalp.unit();
    Root result;
    if (!root.allFinite()) return result;
    const SurfacePoint foot = scalp.tree().nearest(root);
    result.face = foot.face;
    result.triangle = foot.triangle;
    result.barycentric = foot.barycentric;
    result.position = foot.position;
    return result;
}

void move_root(StrandEdit strand, const Vec3& place) {
    if (!strand.allFinite()) return;
    const Eigen::Vector3f root = place.cast<float>(), apart = root - strand.col(0);
    strand.colwise() += apart;
    strand.col(0) = root;
}

}  // namespace

void attach(Strands& strands, const Mesh& head, const Scalp& scalp, const AttachOptions& options,
            const Context& context) {
    if (scalp.region().topology() != head.shared_topology()) {
        throw Error(ErrorCode::topology_mismatch, "the scalp was made for another head");
    }
    Progress progress(context, "attach strands");
    std::vector<Root> places(at(strands.size()));
    context.parallel_for(0, strands.size(), kAttachGrain, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) places[at(s)] = nearest_root(strands, s, scalp);
    });
    std::vector<Root> known;
    StrandRoots roots = roots_on(head, places);
    for (const Root& place : places) {
        if (place.face != kNoIndex) known.push_back(place);
    }
    const std::vector<Eigen::Vector2f> uvs = root_uvs(head, scalp, known);
    auto uv = uvs.begin();
    for (const Root& place : places) {
        roots.uvs.push_back(place.face != kNoIndex ? *uv++ : Eigen::Vector2f::Zero());
    }
    strands.set_roots(std::move(roots));
    if (!options.snap) return;
    for (Index s = 0; s < strands.size(); ++s) {
        const Root& place = places[at(s)];
        if (place.face == kNoIndex) continue;
        move_root(strands.edit_strand(s), scalp.unit() * place.position);
    }
}

}  // namespace lissom
