// A deformer takes what it can from the preparation before; nothing of that shows in its results.

#include <utility>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/preparation.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/interrupter.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// Large enough for an order of its own.
Scene large_tube() {
    return make_scene(open_tube(96, 112, 8.0), 0.05);
}

Edit bent_edit(const Scene& scene, const DeformOptions& options = {}) {
    Edit edit = make_edit(scene, options);
    edit.deformer.set_transform(edit.high, bend(scene, edit.deformer.handle(edit.high).center));
    return edit;
}

// The vertices within `rings` of one half way between the handles.
Region patch_in_middle(const Scene& scene, Index rings) {
    const Vec3 low = scene.mesh.position(scene.low.front()),
               high = scene.mesh.position(scene.high.front());
    const Vec3 half = 0.5 * (low + high);
    Index nearest = 0;
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const auto distance = [&](Index u) { return (scene.mesh.position(u) - half).norm(); };
        if (distance(v) < distance(nearest)) nearest = v;
    }
    return scene.region({nearest}).grown(rings);
}

// The present frame, by a preparation that has seen no other.
std::vector<Vec3> fresh_positions(Deformer& deformer, FrameQuality quality = FrameQuality::full) {
    const DeformSnapshot now = deformer.snapshot();
    const auto prepared = prepare_deformation(now.rest, now.constraints);
    FrameScratch scratch;
    return solve_frame(prepared, now.poses, scratch, quality).positions;
}

// Whether the last preparation assembled and factored a part of the first system only.
bool was_partial(Deformer& deformer) {
    const auto prepared = deformer.prepare();
    const GradientSystem& first = *prepared->implicit()->first;
    const FactorStats stats = first.stats();
    return stats.analyze_seconds == 0.0 && stats.computed_supernodes < stats.supernodes &&
           first.assembled_rows() < count_of(first.free_vertices());
}

}  // namespace

TEST_CASE("next handles: adding and removing one comes to the bits of fresh preparations") {
    const Scene scene = large_tube();
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::poisson, SecondSystem::laplacian}) {
        DeformOptions options;
        options.second = second;
        Edit edit = bent_edit(scene, options);
        Deformer& d = edit.deformer;
        const std::vector<Vec3> before = d.solve();
        CHECK(before == fresh_positions(d));
        const HandleId third = d.add_handle(patch_in_middle(scene, 4));
        CHECK(d.solve() == fresh_positions(d));
        CHECK(was_partial(d));
        d.translate(third, 0.4 * scene.across);
        CHECK(d.solve() == fresh_positions(d));
        CHECK(d.solve(FrameQuality::preview) == fresh_positions(d, FrameQuality::preview));
        d.remove_handle(third);
        CHECK(d.solve() == before);
        CHECK(was_partial(d));
    }
}

TEST_CASE("next handles: a handle that grows ring by ring stays that of fresh preparations") {
    const Scene scene = large_tube();
    Edit edit = bent_edit(scene);
    Deformer& d = edit.deformer;
    const HandleId grown = d.add_handle(patch_in_middle(scene, 0));
    d.translate(grown, 0.2 * scene.across);
    d.solve();
    for (Index rings = 1; rings <= 10; ++rings) {
        CAPTURE(rings);
        set_handle_region(d, grown, patch_in_middle(scene, rings));
        CHECK(d.solve() == fresh_positions(d));
        CHECK(was_partial(d));
    }
    set_handle_region(d, grown, patch_in_middle(scene, 0));
    CHECK(d.solve() == fresh_positions(d));
}

TEST_CASE("next handles: constraints, softness, stiffness and a new rest shape in between") {
    const Scene scene = large_tube();
    Edit edit = bent_edit(scene);
    Deformer& d = edit.deformer;
    d.solve();
    const Index v = scene.between(700);
    d.constrain(VertexConstraint{v, Vec3(scene.mesh.position(v) + 0.1 * scene.across)});
    CHECK(d.solve() == fresh_positions(d));
    CHECK(was_partial(d));
    HandleOptions soft;
    soft.weight = 2.0;
    const HandleId drawn = d.add_handle(patch_in_middle(scene, 2), soft);
    CHECK(d.solve() == fresh_positions(d));
    d.remove_handle(drawn);
    set_stiffness(d, patch_in_middle(scene, 6), 50.0);
    CHECK(d.solve() == fresh_positions(d));
    d.rebase();
    d.translate(edit.high, 0.3 * scene.across);
    CHECK(d.solve() == fresh_positions(d));
}

TEST_CASE("next handles: one that holds most of the region has an order of its own") {
    const Scene scene = large_tube();
    Edit edit = bent_edit(scene);
    Deformer& d = edit.deformer;
    const std::vector<Vec3> before = d.solve();
    const HandleId most = d.add_handle(patch_in_middle(scene, 47));
    CHECK(d.solve() == fresh_positions(d));
    CHECK_FALSE(was_partial(d));
    d.remove_handle(most);
    CHECK(d.solve() == before);
}

TEST_CASE("next handles: a preparation that others hold stays as it is") {
    const Scene scene = large_tube();
    Edit edit = bent_edit(scene);
    Deformer& d = edit.deformer;
    const std::vector<Vec3> before = d.solve();
    const auto held = d.prepare();
    const Poses poses = d.snapshot().poses;
    d.add_handle(patch_in_middle(scene, 3));
    CHECK(d.solve() == fresh_positions(d));
    FrameScratch scratch;
    CHECK(solve_frame(held, poses, scratch).positions == before);
}

TEST_CASE("next handles: after an error the deformer is as before, and goes on") {
    const Scene scene = large_tube();
    Edit edit = bent_edit(scene);
    Deformer& d = edit.deformer;
    const std::vector<Vec3> before = d.solve();
    const DeformSnapshot start = d.snapshot();
    SUBCASE("no handle is left") {
        d.remove_handle(edit.low);
        d.remove_handle(edit.high);
        CHECK(error_of([&] { d.solve(); }).code() == ErrorCode::unconstrained);
        CHECK(d.positions() == before);
        d.restore(start);
        d.add_handle(patch_in_middle(scene, 3));
        CHECK(d.solve() == fresh_positions(d));
        CHECK(was_partial(d));
    }
    SUBCASE("cancelled at any moment") {
        int cut = 0;
        for (int stop = 0;; ++stop) {
            d.restore(start);
            d.solve();
            d.add_handle(patch_in_middle(scene, 3));
            const Interrupter interrupter(stop);
            try {
                d.solve(FrameQuality::full, interrupter.context());
                break;
            } catch (const Error& error) {
                REQUIRE(error.code() == ErrorCode::cancelled);
                ++cut;
            }
            CHECK(d.positions() == before);
            stop += 4;
        }
        CHECK(cut > 3);
        CHECK(d.solve() == fresh_positions(d));
    }
}

TEST_CASE("next handles: threads make no difference") {
    const Scene scene = large_tube();
    std::vector<std::vector<Vec3>> results;
    for (const int threads : {1, 2}) {
        ContextOptions options;
        options.threads = threads;
        const Context context(options);
        Edit edit = bent_edit(scene);
        Deformer& d = edit.deformer;
        d.solve(FrameQuality::full, context);
        d.add_handle(patch_in_middle(scene, 5));
        results.push_back(d.solve(FrameQuality::full, context));
    }
    CHECK(results[0] == results[1]);
}

TEST_CASE("next handles: memory is that of one preparation, however many there were") {
    const Scene scene = large_tube();
    const Context context;
    Deformer d(scene.mesh, scene.all(), {}, context);
    d.add_handle(scene.region(scene.low));
    const HandleId high = d.add_handle(scene.region(scene.high));
    d.translate(high, scene.across);
    d.solve(FrameQuality::full, context);
    const std::size_t before = context.memory()->used();
    for (int i = 0; i < 5; ++i) {
        const HandleId third = d.add_handle(patch_in_middle(scene, 3));
        d.solve(FrameQuality::full, context);
        d.remove_handle(third);
        d.solve(FrameQuality::full, context);
    }
    CHECK(context.memory()->used() <= before + before / 50);
}
