// Meshes far from the origin of their coordinates.

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_changes.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/models.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// One mesh far from the origin of its coordinates, and the same brought back from there: their
// coordinates differ by exactly `offset`.
struct FarAndNear {
    Scene far, near;
    Vec3 offset;

    FarAndNear(const Scene& scene, const Vec3& sizes)
        : far(scene), near(scene), offset(scene.size * sizes) {
        for (Vec3& p : far.mesh.edit_positions()) p += offset;
        const auto from = far.mesh.positions();
        const auto to = near.mesh.edit_positions();
        for (std::size_t v = 0; v < to.size(); ++v) to[v] = from[v] - offset;
    }

    // Greatest distance of results, in sizes.
    double difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) const {
        return max_distance(mapped(a, translation(-offset)), b) / near.size;
    }
};

// Calls move(deformer, handle, center) for both, and compares what they give.
template <typename Move>
double difference(const FarAndNear& pair, const Move& move, const DeformOptions& options = {}) {
    Edit far = make_edit(pair.far, options), near = make_edit(pair.near, options);
    move(far.deformer, far.high, pair.offset);
    move(near.deformer, near.high, Vec3(Vec3::Zero()));
    return std::max(pair.difference(far.deformer.solve(FrameQuality::preview),
                                    near.deformer.solve(FrameQuality::preview)),
                    pair.difference(far.deformer.solve(), near.deformer.solve()));
}

Scene far_bar() {
    BarOptions options;
    options.across = 4;
    options.along = 20;
    return make_scene(make_bar(options));
}

const Vec3 kOffsets[] = {{1e6, -1e6, 1e6}, {0.0, 1e6, 0.0}, {3e5, 2e4, -7e5}};

}  // namespace

TEST_CASE("far away: moves about a handle's centre, as after bringing the mesh back") {
    for (const Vec3& offset : kOffsets) {
        const FarAndNear pair(far_bar(), offset);
        const double size = pair.near.size;
        const auto check = [&](const Affine& map) {
            CHECK(difference(pair, [&](Deformer& d, HandleId handle, const Vec3&) {
                      d.set_transform(handle, map, d.handle(handle).center);
                  }) < 1e-9);
        };
        check(rotation({1, 2, 3}, 1.1, Vec3::Zero()));
        check(translation(0.3 * size * Vec3(1, -2, 0.5)));
        check(scaling({1.5, 0.7, 1.2}, Vec3::Zero()));
        check(translation({size, 0, 0}) * rotation({1, 0, 0}, 2.0, Vec3::Zero()) *
              scaling({2, 2, 2}, Vec3::Zero()));
    }
}

TEST_CASE("far away: many moves on end, as a drag makes them, lose nothing more") {
    const FarAndNear pair(far_bar(), kOffsets[0]);
    const auto drag = [&](Deformer& d, HandleId handle, const Vec3&) {
        for (int i = 0; i < 100; ++i) {
            const Vec3 center = d.handle(handle).center;
            const Affine now = transform_about(d, handle, center);
            const Affine step = translation(1e-3 * pair.near.size * Vec3(1, 2, 3)) *
                                rotation({3, 1, 2}, 0.01, now.translation);
            d.set_transform(handle, step * now, center);
        }
    };
    CHECK(difference(pair, drag) < 1e-9);
}

TEST_CASE("far away: matrices of the whole space, as far as they tell where a point goes") {
    for (const Vec3& offset : kOffsets) {
        const FarAndNear pair(far_bar(), offset);
        const Affine map = rotation({1, 2, 3}, 1.1, 0.5 * pair.near.size * Vec3(1, 0, 2));
        const auto move = [&](Deformer& d, HandleId handle, const Vec3& shift) {
            Affine whole = map;
            whole.translation += shift - map.linear * shift;
            d.set_transform(handle, whole);
        };
        CHECK(difference(pair, move) < 1e-9);
    }
}

TEST_CASE("far away: a rotation of the whole space about the handle's centre") {
    for (const Vec3& offset : kOffsets) {
        const FarAndNear pair(far_bar(), offset);
        const auto move = [](Deformer& d, HandleId handle, const Vec3&) {
            d.set_transform(handle, rotation({1, 2, 3}, 1.1, d.handle(handle).center));
        };
        CHECK(difference(pair, move) < 1e-9);
    }
}

TEST_CASE("far away: every second system, vertex constraints, and rest to the bit") {
    const FarAndNear pair(far_bar(), kOffsets[0]);
    const Index tip = pair.near.mesh.vertex_count() / 2;
    const auto move = [&](Deformer& d, HandleId handle, const Vec3& offset) {
        d.constrain(VertexConstraint{tip, Vec3(offset + Vec3(1.5, 0.25, -0.5)), {}});
        d.set_transform(handle, rotation({1, 2, 3}, 1.1, Vec3::Zero()), d.handle(handle).center);
    };
    for (const SecondSystem second :
         {SecondSystem::blend, SecondSystem::laplacian, SecondSystem::poisson}) {
        DeformOptions options;
        options.second = second;
        CHECK(difference(pair, move, options) < 1e-9);
    }
    Edit edit = make_edit(pair.far);
    const Vec3 center = edit.deformer.handle(edit.high).center;
    const Affine turn = rotation({1, 2, 3}, 1.1, Vec3::Zero());
    edit.deformer.set_transform(edit.high, turn, center);
    edit.deformer.solve();
    const Affine back =
        rotation({1, 2, 3}, -1.1, Vec3::Zero()) * transform_about(edit.deformer, edit.high, center);
    edit.deformer.set_transform(edit.high, back, center);
    CHECK(edit.deformer.solve() == rest_positions_of(edit.deformer));
}

TEST_CASE("far away: real meshes") {
    for_each_model([](const Scene& scene) {
        const FarAndNear pair(scene, kOffsets[0]);
        const auto move = [&](Deformer& d, HandleId handle, const Vec3&) {
            d.set_transform(handle, bend(pair.near, Vec3::Zero()), d.handle(handle).center);
        };
        CHECK(difference(pair, move) < 1e-9);
    });
}
