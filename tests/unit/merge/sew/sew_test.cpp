// Sewing two meshes along the target's loop.

#include "kernel/merge/sew/sew.h"

#include <algorithm>
#include <cstring>

#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

bool same_bits(const Vec3& a, const Vec3& b) {
    return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

// Sphere of quads, cut at a height along its edges.
SewScene cut_sphere() {
    SewScene scene =
        cut_in_two(make_sphere({.segments = 12}), [](const Vec3& p) { return p.y() < 0.3; });
    add_join(scene, 0, 0, Vec3(1.0, 0.2, 0.3));
    return scene;
}

}  // namespace

TEST_CASE("sew: parts of a sphere cut along its edges become the same sphere again") {
    const Mesh whole = make_sphere({.segments = 12});
    const SewScene scene = cut_sphere();
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0, .flip = false});
    CHECK(sewn.mesh.topology().is_closed());
    CHECK(sewn.mesh.vertex_count() == whole.vertex_count());
    CHECK(sewn.mesh.face_count() == whole.face_count());
    CHECK(volume(sewn.mesh) == doctest::Approx(volume(whole)).epsilon(1e-12));
    CHECK(sewn.report.inserted_into_target == 0);
    CHECK(sewn.report.inserted_into_source == 0);
}

TEST_CASE("sew: tubes with loops of very different counts give one manifold tube") {
    for (const auto& counts : {std::pair<Index, Index>{3, 200},
                               {200, 3},
                               {3, 3},
                               {17, 40},
                               {24, 24},
                               {40, 17},
                               {5, 6}}) {
        const Index n = counts.first, m = counts.second;
        CAPTURE(n);
        CAPTURE(m);
        const SewScene scene = two_tubes(n, m);
        const Sewn sewn = sew(scene.target, scene.source, scene.joins);
        CHECK(sewn.mesh.topology().boundary_loops().size() == 2);
        CHECK(euler_characteristic(sewn.mesh.topology()) == 0);
        CHECK(sewn.mesh.topology().component_count() == 1);
        CHECK(sewn.report.after.vertices == static_cast<Index>(sewn.seams[0].size()));
    }
}

TEST_CASE("sew: without smoothing the target's vertices come first and keep their bits") {
    const SewScene scene = two_tubes(24, 31);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0});
    for (Index v = 0; v < scene.target.vertex_count(); ++v) {
        REQUIRE(same_bits(sewn.mesh.position(v), scene.target.position(v)));
    }
    CHECK(area(sewn.mesh) ==
          doctest::Approx(area(scene.target) + area(scene.source)).epsilon(0.01));
}

namespace {

// A tube with a knee above two tubes of unlike size.
SewScene forked() {
    SewScene scene{make_tube(20, -2.0, 2.0), make_tube(26, 0.0, 3.0), {}};
    Mesh above = make_tube(14, 3.0, 2.0, 1.3);
    append(scene.target, above);
    const auto& loops = scene.target.topology().boundary_loops();
    const auto loop_at = [&](double y) {
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (std::abs(scene.target.position(loops[l][0]).y() - y) < 1e-9) return l;
        }
        return loops.size();
    };
    const Vec3 side(1.0, 0.0, 1e-3);
    add_join(scene, loop_at(0.0), boundary_towards(scene.source, -1.0), side);
    add_join(scene, loop_at(3.0), boundary_towards(scene.source, 1.0), side);
    return scene;
}

Mesh mapped(Mesh mesh, const Affine& map) {
    transform(mesh, map);
    return mesh;
}

}  // namespace

TEST_CASE("sew: several joins at once, conforming and by bands") {
    const SewScene scene = forked();
    for (const SeamKind kind : {SeamKind::conform, SeamKind::band}) {
        const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.kind = kind});
        CHECK(sewn.seams.size() == 2);
        CHECK(sewn.mesh.topology().component_count() == 1);
        CHECK(sewn.mesh.topology().boundary_loops().size() == 2);
        CHECK(euler_characteristic(sewn.mesh.topology()) == 0);
    }
}

TEST_CASE("sew: a handle on one target raises the genus") {
    // A tube bent into an arch over a plate with two holes would be the like; here both ends of one
    // tube meet both ends of another.
    SewScene scene{make_tube(20, 0.0, 3.0), make_tube(26, 0.0, 3.0, 2.0), {}};
    flip(scene.source);
    add_join(scene, boundary_towards(scene.target, -1.0), boundary_towards(scene.source, -1.0),
             Vec3(1.0, 0.0, 1e-3));
    add_join(scene, boundary_towards(scene.target, 1.0), boundary_towards(scene.source, 1.0),
             Vec3(1.0, 0.0, 1e-3));
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0});
    CHECK(sewn.mesh.topology().is_closed());
    CHECK(genus(sewn.mesh.topology()) == 1);
}

TEST_CASE("sew: a similarity of both meshes gives the same faces and moves the result") {
    const SewScene scene = two_tubes(24, 31);
    for (const SeamKind kind : {SeamKind::conform, SeamKind::band}) {
        const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.kind = kind});
        for (const double scale : {1e-3, 1.0, 1e3}) {
            const Affine map = translation(Vec3(3, -2, 5) * scale) *
                               rotation(Vec3(1, 2, 3), 1.0, Vec3::Zero()) *
                               scaling(Vec3::Constant(scale), Vec3::Zero());
            const Sewn moved = sew(mapped(scene.target, map), mapped(scene.source, map),
                                   scene.joins, {.kind = kind});
            REQUIRE(moved.mesh.topology().faces().vertices ==
                    sewn.mesh.topology().faces().vertices);
            for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
                CHECK((moved.mesh.position(v) - map(sewn.mesh.position(v))).norm() < 1e-9 * scale);
            }
        }
    }
}

TEST_CASE("sew: smoothing and flips stay within two rings of the seam") {
    const SewScene scene = two_tubes(24, 31);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins);
    const Region near = Region(sewn.mesh.shared_topology(), sewn.seams[0]).grown(2);
    const Index targets = scene.target.vertex_count();
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        const Index from = sewn.map.vertices.main_source(v);
        const Vec3 old =
            from < targets ? scene.target.position(from) : scene.source.position(from - targets);
        if (!near.contains(v)) REQUIRE(same_bits(sewn.mesh.position(v), old));
    }
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        const std::span<const Index> face = sewn.mesh.topology().face(f);
        const bool far =
            std::none_of(face.begin(), face.end(), [&](Index v) { return near.contains(v); });
        if (far) REQUIRE(face.size() == 4);
    }
}

TEST_CASE("sew: ears at the same place on both sides do not make an edge with four faces") {
    // Fans whose boundary faces are ears: one triangle each between three loop vertices.
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({0, 2, 3});
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    SewScene scene{Mesh(square, faces), Mesh(square, faces), {}};
    flip(scene.source);
    LoopPair join{{0, 1, 2, 3}, {0, 1, 2, 3}, {}, {}};
    for (Index k = 0; k < 4; ++k) {
        join.on_target.push_back({k, 0.0});
        join.on_source.push_back({k, 0.0});
    }
    scene.joins = {join};
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0});
    CHECK(sewn.mesh.topology().is_closed());
    CHECK(euler_characteristic(sewn.mesh.topology()) == 2);
}

TEST_CASE("sew: short edges of the source's loop are collapsed, the target keeps its vertices") {
    SewScene scene = two_tubes(12, 30);
    // Every third vertex of the source slides close to its neighbour.
    LoopPair& join = scene.joins[0];
    const std::vector<double> target = loop_fractions(points_of(scene.target, join.target));
    std::vector<double> source;
    for (std::size_t i = 0; i < join.source.size(); ++i) {
        source.push_back((static_cast<double>(i) - (i % 3 == 2 ? 0.95 : 0.0)) / 30.0);
    }
    for (std::size_t i = 0; i < source.size(); ++i) join.on_target[i] = place_at(target, source[i]);
    for (std::size_t j = 0; j < target.size(); ++j) join.on_source[j] = place_at(source, target[j]);
    bring_together(scene.target, scene.source, join);
    const Sewn sewn = sew(scene.target, scene.source, scene.joins, {.smooth = 0});
    CHECK(sewn.report.collapsed > 0);
    const auto met = std::count_if(join.on_target.begin(), join.on_target.end(),
                                   [](const LoopPoint& place) { return place.t == 0.0; });
    CHECK(sewn.mesh.vertex_count() + sewn.report.snapped + sewn.report.collapsed + met ==
          scene.target.vertex_count() + scene.source.vertex_count());
    CHECK(euler_characteristic(sewn.mesh.topology()) == 0);
    for (Index v = 0; v < scene.target.vertex_count(); ++v) {
        REQUIRE(same_bits(sewn.mesh.position(v), scene.target.position(v)));
    }
    const std::vector<Vec3> seam = points_of(sewn.mesh, sewn.seams[0]);
    for (std::size_t k = 0; k < seam.size(); ++k) {
        CHECK((seam[(k + 1) % seam.size()] - seam[k]).norm() > 0.4 * sewn.report.before.mean_edge);
    }
}
