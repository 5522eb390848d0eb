#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "tests/unit/merge/real_pairs.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

double mean_radius(const Mesh& mesh, const std::vector<Index>& loop) {
    Vec3 center = Vec3::Zero();
    for (const Index v : loop) center += mesh.position(v) / static_cast<double>(loop.size());
    double radius = 0.0;
    for (const Index v : loop) radius += (mesh.position(v) - center).norm();
    return radius / static_cast<double>(loop.size());
}

}  // namespace

TEST_CASE("real pairs: faired or blended, the seam shows less than it did, and near it too") {
    for (const test::RealPair& pair : test::real_pairs()) {
        const auto source = test::load_part(pair.source), target = test::load_part(pair.target);
        if (!source || !target) return;
        CAPTURE(pair.name);
        const Mesh* targets[] = {&target->mesh};
        Merger merge(source->mesh, targets, {test::join_of(pair, *source, *target)});
        MergeResult merged = merge.solve();
        const SeamQuality before = seam_quality(merged.mesh, merged.seams);

        Mesh faired = merged.mesh;
        fair_seam(faired, merged.seams);
        const SeamQuality fair = seam_quality(faired, merged.seams);
        CHECK(fair.max_dihedral < pair.dihedral * kDegree);
        CHECK(fair.max_near < before.max_near + kDegree);

        const double width = 0.9 * mean_radius(merged.mesh, merged.seams[0]);
        Sewn sewn{std::move(merged.mesh), {}, merged.side_of_face, merged.seams, {}};
        const std::vector<TransitionWidths> widths{{width, width}};
        const TransitionReport report = blend_transition(sewn, widths);
        const SeamQuality blended = seam_quality(sewn.mesh, sewn.seams);
        CHECK(blended.max_dihedral < (pair.dihedral + 2.0) * kDegree);
        CHECK(blended.max_near < before.max_near + kDegree);
        CHECK(report.target[0].unmapped == 0);
        CHECK(report.source[0].unmapped == 0);
    }
}
