#include "kernel/merge/sew/sew.h"

#include <vector>

#include "kernel/merge/sew/seam_loop.h"
#include "kernel/merge/sew/seam_skin.h"
#include "kernel/merge/sew/seam_work.h"

namespace lissom {
namespace {

// Dihedral angles up to this may arise from flips.
constexpr double kAllowedDihedral = 20.0 * kPi / 180.0;

void require_options(const SewOptions& options) {
    if (options.smooth < 0) {
        throw Error(ErrorCode::invalid_argument, "smooth must not be negative");
    }
    if (!(options.snap >= 0.0 && options.snap <= 1.0)) {
        throw Error(ErrorCode::invalid_argument, "snap must lie between 0 and 1");
    }
}

std::vector<Index> loop_vertices(std::span<const LoopPair> joins, Index first_source) {
    std::vector<Index> vertices;
    for (const LoopPair& join : joins) {
        vertices.insert(vertices.end(), join.target.begin(), join.target.end());
        for (const Index v : join.source) vertices.push_back(v + first_source);
    }
    return vertices;
}

}  // namespace

Sewn sew(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins,
         const SewOptions& options, const Context& context) {
    require_options(options);
    require_joins(target.topology(), source.topology(), joins);
    require_same_joints(target, source, joins);
    Progress progress(context, "sew");
    const Mesh both = unconnected(target, source, context);
    const std::vector<Index> loops = loop_vertices(joins, target.vertex_count());
    SeamWork work{both,
                  target.vertex_count(),
                  target.face_count(),
                  SeamPatch(both, target.face_count(), loops),
                  {},
                  {},
                  {},
                  {}};
    for (const LoopPair& join : joins) {
        context.checkpoint();
        if (options.kind == SeamKind::band) {
            sew_band(work, join, context);
        } else {
            sew_conforming(work, join, options);
        }
    }
    work.patch.close(work.seams);
    if (options.flip) work.report.flipped = work.patch.flip_edges(kAllowedDihedral);
    Sewn sewn = finish(work, options, context);
    if (const auto skinned = skinned_side(target, source)) extend_skin(sewn, *skinned, context);
    return sewn;
}

}  // namespace lissom
