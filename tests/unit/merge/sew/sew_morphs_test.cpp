// What merging does to the surface beside a seam, and what morph targets become by it.
#include <algorithm>
#include <cmath>

#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/merge_side.h"
#include "kernel/merge/paste/erase/erase_feature.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/query/region_select.h"
#include "tests/unit/merge/blend/fairing_scenes.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/mesh/morph_support.h"
#include "tests/unit/shapes.h"

using namespace lissom;

namespace {

// The same tube with a square section.
Mesh squared(Mesh tube) {
    for (Vec3& p : tube.edit_positions()) {
        const double side = std::max(std::abs(p.x()), std::abs(p.z()));
        p.x() /= side;
        p.z() /= side;
    }
    return tube;
}

// Two square tubes whose loops have unlike numbers of vertices, with the corners among them: what
// lies between two vertices of a loop lies on the other.
test::SewScene tubes(Index target, Index source) {
    test::SewScene scene{squared(test::make_tube(target, -2.0, 2.0)),
                         squared(test::make_tube(source, 0.0, 2.0)),
                         {}};
    test::add_join(scene, test::boundary_towards(scene.target, 1.0),
                   test::boundary_towards(scene.source, -1.0), Vec3(1.0, 0.0, 1e-3));
    test::add_telling_targets(scene.target);
    test::add_telling_targets(scene.source);
    return scene;
}

Sewn bumpy() {
    Sewn sewn = test::revolution(48, 12, [](double angle, double z) {
        return 1.0 + 0.4 * std::max(0.0, z) + 0.03 * std::sin(8 * angle) * std::sin(8 * z);
    });
    test::add_telling_targets(sewn.mesh);
    return sewn;
}

}  // namespace

TEST_CASE("morph targets go through seam steps as positions do: umbrella, collars, flips") {
    for (const auto& sides : {std::pair(16, 16), std::pair(8, 24), std::pair(24, 8)}) {
        const int target = sides.first, source = sides.second;
        const test::SewScene scene = tubes(target, source);
        for (const bool guard : {true, false}) {
            for (const bool collar : {false, true}) {
                CAPTURE(target);
                CAPTURE(guard);
                CAPTURE(collar);
                const Sewn sewn = sew(scene.target, scene.source, scene.joins,
                                      {.smooth = 5, .snap = 0.0, .guard = guard, .collar = collar});
                if (!guard) CHECK(sewn.report.smoothed == 5);
                // A collar looks for what is nearest 1e-8 of an edge aside, which on the thin faces
                // between unlike loops is 1e-5 of the target.
                CHECK(test::departure(sewn.mesh) < (collar ? 1e-5 : 1e-9));
            }
        }
    }
}

TEST_CASE("morph targets go through a faired seam and a transition as positions do") {
    Sewn faired = bumpy(), blended = bumpy();
    const Mesh before = faired.mesh;
    fair_seam(faired.mesh, faired.seams);
    CHECK(test::max_move(before, faired.mesh) > 0.01);
    CHECK(test::departure(faired.mesh) < 1e-9);
    const std::vector<TransitionWidths> widths(1, {0.6, 0.6});
    CHECK(blend_transition(blended, widths).kept > 0.0);
    CHECK(test::max_move(before, blended.mesh) > 0.001);
    CHECK(test::departure(blended.mesh) < 1e-9);
}

TEST_CASE("targets on corners do not tear a seam, though one side alone has them") {
    for (const bool target_has : {true, false}) {
        for (const auto& sides : {std::pair(16, 16), std::pair(8, 24), std::pair(24, 8)}) {
            test::SewScene scene = tubes(sides.first, sides.second);
            test::drop_morphs(target_has ? scene.source : scene.target);
            const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 5});
            const Attribute& morph = *sewn.mesh.attributes().find("morph.4.position");
            REQUIRE(morph.domain == Domain::corner);
            const std::vector<Vec3> mean = test::target(sewn.mesh, 4);
            const std::vector<Index>& corners = sewn.mesh.topology().faces().vertices;
            const std::vector<Index>& seam = sewn.seams[0];
            for (Index c = 0; c < count_of(corners); ++c) {
                if (std::find(seam.begin(), seam.end(), corners[at(c)]) == seam.end()) continue;
                const auto value = morph.at(c);
                const Vec3 adds(value[0], value[1], value[2]);
                CHECK((adds - mean[at(corners[at(c)])]).norm() < 1e-9);
                CHECK(adds.norm() > 0.01);
            }
        }
    }
}

TEST_CASE("morph targets go through a refined and a trimmed side as positions do") {
    Mesh tube = test::round_tube(20, 8);
    test::add_telling_targets(tube);
    MergeSide side = make_side(tube, {boundaries(tube)[0]}, "source");
    refine_loop(side, 0, {});
    trim_jagged(side, -1.0, {});
    CHECK(side.trimmed[0]);
    CHECK(test::departure(side.mesh) < 1e-9);
}

TEST_CASE("morph targets go over the patch of an erased feature as positions do") {
    Mesh ball = make_sphere({.segments = 20});
    test::add_telling_targets(ball);
    const ErasedFeature erased =
        erase_feature(ball, select_sphere(ball, Vec3::UnitY(), 0.3), {}, {});
    CHECK(erased.report.patch.vertex_count > 0);
    CHECK(test::departure(erased.mesh) < 1e-9);
}
