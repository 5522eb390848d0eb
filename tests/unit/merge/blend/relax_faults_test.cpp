// Places near a seam that fold back are smoothed, and no others.
#include "kernel/merge/blend/relax_faults.h"

#include <doctest/doctest.h>

#include <vector>

#include "kernel/merge/loop/band_pinch.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/merge_once.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Two tubes that were sewn.
Sewn joined_tubes() {
    const Mesh lower = open_tube(24, 12);
    Mesh upper = open_tube(24, 12);
    for (Vec3& p : upper.edit_positions()) p.y() += 2.2;
    MergeResult merged = merge(upper, lower);
    Sewn sewn;
    sewn.mesh = std::move(merged.mesh);
    sewn.seams = std::move(merged.seams);
    sewn.side_of_face = std::move(merged.side_of_face);
    return sewn;
}

// Folds the surface over beside a vertex of the seam: the next ring is drawn across it.
Index fold_beside_seam(Sewn& sewn) {
    const Index v = sewn.seams[0][3];
    for (const Index n : sewn.mesh.topology().neighbors(v)) {
        if (sewn.mesh.position(n).y() < sewn.mesh.position(v).y() - 0.05) {
            sewn.mesh.set_position(n, sewn.mesh.position(v) + Vec3(0.0, 0.25, 0.0));
            return n;
        }
    }
    return kNoIndex;
}

double folded_length(const Sewn& sewn) {
    const BandSide side{&sewn.mesh, {}, sewn.seams[0]};
    return band_quality(side, side, side, side, 1.0, true).folded;
}

}  // namespace

TEST_CASE("folds beside a seam are smoothed out, and far vertices stay to the bit") {
    Sewn sewn = joined_tubes();
    REQUIRE(fold_beside_seam(sewn) != kNoIndex);
    REQUIRE(folded_length(sewn) > 0.0);
    const Mesh before = sewn.mesh;
    REQUIRE(relax_faults(sewn, {}, 2, {}));
    CHECK(folded_length(sewn) == 0.0);
    Index moved = 0;
    for (Index v = 0; v < before.vertex_count(); ++v) {
        moved += sewn.mesh.position(v) == before.position(v) ? 0 : 1;
    }
    CHECK(moved > 0);
    CHECK(3 * moved < before.vertex_count());
}

TEST_CASE("a thorn beside a seam is smoothed away, one that the source had is not") {
    Sewn sewn = joined_tubes();
    const std::vector<Vec3> smooth{sewn.mesh.positions().begin(), sewn.mesh.positions().end()};
    const Vec3 seam = sewn.mesh.position(sewn.seams[0][0]);
    Index thorn = kNoIndex;
    for (Index v = 0; v < sewn.mesh.vertex_count() && thorn == kNoIndex; ++v) {
        const double above = sewn.mesh.position(v).y() - seam.y();
        if (above > 0.05 && above < 0.45) thorn = v;
    }
    REQUIRE(thorn != kNoIndex);
    const Vec3 place = sewn.mesh.position(thorn);
    sewn.mesh.set_position(thorn, {1.3 * place.x(), place.y(), 1.3 * place.z()});
    const std::vector<Vec3> thorny{sewn.mesh.positions().begin(), sewn.mesh.positions().end()};
    const std::vector<double> near(thorny.size(), 0.0);
    CHECK(!relax_faults(sewn, {{}, {}, thorny}, 1, {}));
    REQUIRE(pinches({sewn.mesh, smooth, near, 1.0}).size() == 1);
    REQUIRE(relax_faults(sewn, {{}, {}, smooth}, 1, {}));
    CHECK(pinches({sewn.mesh, smooth, near, 1.0}).empty());
    CHECK((sewn.mesh.position(thorn) - place).norm() < 0.1);
}

TEST_CASE("a seam without folds is not smoothed, nor are vertices that are firm") {
    Sewn sewn = joined_tubes();
    const Mesh before = sewn.mesh;
    CHECK(!relax_faults(sewn, {}, 4, {}));
    CHECK(hash(sewn.mesh) == hash(before));
    fold_beside_seam(sewn);
    std::vector<Index> firm;
    for (Index v = 0; v < before.vertex_count(); ++v) firm.push_back(v);
    const Mesh folded = sewn.mesh;
    relax_faults(sewn, {{}, firm, {}}, 4, {});
    // Two rings beside the seam are its own; beyond them firm vertices stay.
    for (Index v = 0; v < folded.vertex_count(); ++v) {
        const double away =
            std::abs(folded.position(v).y() - folded.position(sewn.seams[0][0]).y());
        if (away > 1.0) CHECK(sewn.mesh.position(v) == folded.position(v));
    }
}
