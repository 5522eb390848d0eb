// The volume of solids that are twisted and bent.
#include <cmath>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/deform/stats.h"
#include "kernel/deform/volume/thickness.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

Scene bar_scene(double length = 6.0, Index across = 6) {
    BarOptions options;
    options.length = length;
    options.across = across;
    options.along = static_cast<Index>(length) * across;
    return make_scene(make_bar(options));
}

double volume_at(const Scene& scene, const std::vector<Vec3>& x) {
    Mesh mesh = scene.mesh;
    mesh.set_positions(x);
    return volume(mesh) / volume(scene.mesh);
}

std::vector<Vec3> twisted(const Scene& scene, double degrees, const DeformOptions& options) {
    Edit edit = make_edit(scene, options);
    edit.deformer.rotate(edit.high, Vec3::UnitY(), degrees * kDegree);
    return edit.deformer.solve();
}

DeformOptions keeping(double share) {
    DeformOptions options;
    options.volume = share;
    return options;
}

// The part between the handles becomes an arc of its length about x.
std::vector<Vec3> bent(const Scene& scene, double degrees, const DeformOptions& options) {
    double from = -1e300, to = 1e300;
    for (const Index v : scene.low) from = std::max(from, scene.mesh.position(v).y());
    for (const Index v : scene.high) to = std::min(to, scene.mesh.position(v).y());
    const double angle = degrees * kDegree, radius = (to - from) / angle;
    const Vec3 end(0.0, from + radius * std::sin(angle), radius * (1.0 - std::cos(angle)));
    const Vec3 joint(0.0, to, 0.0);
    Edit edit = make_edit(scene, options);
    edit.deformer.set_transform(edit.high,
                                translation(end - joint) * rotation(Vec3::UnitX(), angle, joint));
    return edit.deformer.solve();
}

}  // namespace

TEST_CASE("volume: twisted and bent bars keep theirs") {
    const Scene scene = bar_scene();
    CHECK(volume_at(scene, twisted(scene, 150.0, {})) < 0.9);
    CHECK(volume_at(scene, twisted(scene, 150.0, keeping(1.0))) > 0.98);
    CHECK(volume_at(scene, twisted(scene, 360.0, keeping(1.0))) > 0.94);
    const double bend_volume = volume_at(scene, bent(scene, 135.0, keeping(1.0)));
    CHECK(bend_volume > 0.98);
    CHECK(bend_volume < 1.02);
}

TEST_CASE("volume: a greater share keeps more of it") {
    const Scene scene = bar_scene();
    double before = 0.0;
    for (const double share : {0.0, 0.02, 0.1, 0.3, 1.0}) {
        const double now = volume_at(scene, twisted(scene, 150.0, keeping(share)));
        CHECK(now > before);
        before = now;
    }
}

TEST_CASE("volume: the slider costs no factorisation, and zero is the result without") {
    const Scene scene = bar_scene(6.0, 4);
    Edit plain = make_edit(scene), slid = make_edit(scene);
    for (Edit* edit : {&plain, &slid}) {
        edit->deformer.rotate(edit->high, Vec3::UnitY(), 100.0 * kDegree);
        edit->deformer.solve();
    }
    keep_volume(slid.deformer, 1.0);
    const std::vector<Vec3> kept = slid.deformer.solve();
    CHECK(max_distance(kept, plain.deformer.positions()) > 0.01);
    CHECK(kept == twisted(scene, 100.0, keeping(1.0)));
    keep_volume(slid.deformer, 0.0);
    CHECK(slid.deformer.solve() == plain.deformer.positions());
    CHECK(stats_of(slid.deformer).factorizations == 1);
}

TEST_CASE("volume: rest is rest to the bit, and a rigid motion of all handles is exact") {
    const Scene scene = bar_scene(6.0, 4);
    Edit edit = make_edit(scene, keeping(1.0));
    const std::vector<Vec3> rest(scene.mesh.positions().begin(), scene.mesh.positions().end());
    CHECK(edit.deformer.solve() == rest);
    const Affine move = rotation({1.0, 2.0, -1.0}, 2.0, {0.3, 0.1, 0.0});
    edit.deformer.set_transform(edit.low, move);
    edit.deformer.set_transform(edit.high, move);
    CHECK(max_distance(edit.deformer.solve(), mapped(rest, move)) < 1e-9);
}

TEST_CASE("volume: a moved and scaled mesh gives the moved and scaled result") {
    const Scene scene = bar_scene(6.0, 4);
    const Affine map = translation({20.0, 5.0, -3.0}) *
                       rotation({0.2, 1.0, 0.4}, 1.1, Vec3::Zero()) *
                       scaling(Vec3(0.01, 0.01, 0.01), Vec3::Zero());
    Scene far = scene;
    far.mesh.set_positions(
        mapped({scene.mesh.positions().begin(), scene.mesh.positions().end()}, map));
    const auto error = [&](double share) {
        Edit here = make_edit(scene, keeping(share)), there = make_edit(far, keeping(share));
        const Affine turn = rotation(Vec3::UnitY(), 1.7, {0.2, 0.0, 0.1});
        here.deformer.set_transform(here.high, turn);
        there.deformer.set_transform(there.high, conjugated(turn, map));
        return max_distance(there.deformer.solve(), mapped(here.deformer.solve(), map)) / far.size;
    };
    CHECK(error(1.0) < 1e-9);
}

TEST_CASE("volume: a sheet has no inside, and deforms as without") {
    const Scene scene = make_scene(make_grid({{5.0, 2.0}, {20, 8}}));
    Edit plain = make_edit(scene), kept = make_edit(scene, keeping(1.0));
    for (Edit* edit : {&plain, &kept}) {
        edit->deformer.set_transform(edit->high, bend(scene, Vec3::Zero()));
    }
    CHECK(plain.deformer.solve() == kept.deformer.solve());
}

TEST_CASE("volume: a handle that scales gets the surface that it asks for") {
    const Scene scene = bar_scene(6.0, 4);
    const auto scaled = [&](double share) {
        Edit edit = make_edit(scene, keeping(share));
        const Vec3 center = edit.deformer.handle(edit.high).center;
        edit.deformer.set_transform(edit.high, scaling(Vec3(2.0, 2.0, 2.0), Vec3::Zero()), center);
        return edit.deformer.solve();
    };
    CHECK(max_distance(scaled(0.0), scaled(1.0)) < 0.02 * scene.size);
}

TEST_CASE("volume: undo, rest shapes and resets keep the share") {
    const Scene scene = bar_scene(6.0, 4);
    Edit edit = make_edit(scene);
    keep_volume(edit.deformer, 0.5);
    const DeformSnapshot before = edit.deformer.snapshot();
    keep_volume(edit.deformer, 0.0);
    edit.deformer.restore(before);
    CHECK(kept_volume(edit.deformer) == 0.5);
    edit.deformer.reset();
    CHECK(kept_volume(edit.deformer) == 0.5);
    edit.deformer.rotate(edit.high, Vec3::UnitY(), 1.0);
    edit.deformer.solve();
    edit.deformer.rebase();
    CHECK(kept_volume(edit.deformer) == 0.5);
    CHECK_THROWS_AS(keep_volume(edit.deformer, 1.5), Error);
    CHECK_THROWS_AS(keep_volume(edit.deformer, std::nan("")), Error);
    CHECK(kept_volume(edit.deformer) == 0.5);
}

TEST_CASE("volume: refined, drafted and stiffened results keep theirs as well") {
    const Scene scene = bar_scene();
    DeformOptions options = keeping(1.0);
    options.refine = 2;
    CHECK(volume_at(scene, twisted(scene, 150.0, options)) > 0.97);
    Edit edit = make_edit(scene, keeping(1.0));
    edit.deformer.rotate(edit.high, Vec3::UnitY(), 150.0 * kDegree);
    const std::vector<Vec3> draft = edit.deformer.solve(FrameQuality::draft);
    CHECK(max_distance(draft, edit.deformer.solve()) < 1e-3 * scene.size);
}
