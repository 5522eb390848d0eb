// What is done to a piece around a seam is what would be done to the whole, to the bit.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "kernel/io/mesh_file.h"
#include "kernel/merge/piece/put_back.h"
#include "kernel/merge/sew/seam_work.h"
#include "kernel/mesh/edit/subdivide.h"
#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

bool same_map(const ElementMap& a, const ElementMap& b) {
    if (a.size() != b.size()) return false;
    for (Index i = 0; i < a.size(); ++i) {
        const bool same = std::equal(
            a[i].begin(), a[i].end(), b[i].begin(), b[i].end(), [](const auto& s, const auto& t) {
                return s.element == t.element && std::abs(s.weight - t.weight) < 1e-12;
            });
        if (!same) return false;
    }
    return true;
}

// Texture coordinates of vertices, normals of vertices, labels, and a region that crosses the loop.
void dress(Mesh& mesh, double shift) {
    Attribute uv{"uv", Domain::vertex, 2, ScalarType::float64, {}};
    Attribute normal{"normal", Domain::vertex, 3, ScalarType::float64, {}};
    std::vector<Index> half;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3 p = mesh.position(v), n = vertex_normals(mesh)[at(v)];
        uv.values.insert(uv.values.end(), {p.x() + shift, p.y()});
        normal.values.insert(normal.values.end(), n.data(), n.data() + 3);
        if (p.x() > 0.0) half.push_back(v);
    }
    FaceLabels labels{{"left", "right"}, {}};
    for (Index f = 0; f < mesh.face_count(); ++f) {
        labels.of_face.push_back(mesh.position(mesh.topology().face(f)[0]).x() > 0.0 ? 1 : 0);
    }
    mesh.attributes().add(std::move(uv));
    mesh.attributes().add(std::move(normal));
    mesh.attributes().labels().emplace("material", std::move(labels));
    mesh.set_region("half", Region(mesh.shared_topology(), half));
}

void check_same(const SewScene& scene, const SewOptions& options) {
    const Mesh mesh = unconnected(scene.target, scene.source, {});
    const BothSides both{mesh, scene.target.vertex_count(), scene.target.face_count()};
    const Sewn whole = sewn_whole(both, scene.joins, options, {});
    const std::optional<Sewn> piece = sewn_piece(both, scene.joins, options, {});
    REQUIRE(piece);
    CHECK(hash(piece->mesh) == hash(whole.mesh));
    CHECK(same_map(piece->map.vertices, whole.map.vertices));
    CHECK(same_map(piece->map.corners, whole.map.corners));
    CHECK(same_map(piece->map.faces, whole.map.faces));
    CHECK(piece->place.vertices == whole.place.vertices);
    CHECK(piece->place.faces == whole.place.faces);
    CHECK(piece->side_of_face == whole.side_of_face);
    CHECK(piece->seams == whole.seams);
    CHECK(piece->first_source_vertex == whole.first_source_vertex);
    CHECK(piece->report.flipped == whole.report.flipped);
    CHECK(piece->report.smoothed == whole.report.smoothed);
    CHECK(piece->report.collar_added == whole.report.collar_added);
    CHECK(piece->report.after.max_dihedral == whole.report.after.max_dihedral);
}

// Long tubes that meet at an angle.
SewScene long_tubes(Index target, Index source) {
    SewScene scene{make_tube(target, -9.0, 9.0, 1.0, 60), make_tube(source, 0.0, 9.0, 1.0, 60), {}};
    add_join(scene, boundary_towards(scene.target, 1.0), boundary_towards(scene.source, -1.0),
             Vec3(1.0, 0.0, 1e-3));
    for (Vec3& p : scene.source.edit_positions()) p.x() += 0.4 * std::max(0.0, p.y());
    bring_together(scene.target, scene.source, scene.joins[0]);
    return scene;
}

}  // namespace

TEST_CASE("sew: on the faces around a seam as on the whole") {
    for (const auto& sides : {std::pair(16, 16), std::pair(12, 31), std::pair(40, 9)}) {
        SewScene scene = long_tubes(sides.first, sides.second);
        dress(scene.target, 0.0);
        dress(scene.source, 3.0);
        for (const bool collar : {false, true}) {
            CAPTURE(sides.first);
            CAPTURE(collar);
            SewOptions options;
            options.collar = collar;
            check_same(scene, options);
        }
        check_same(scene, {.kind = SeamKind::band});
        check_same(scene, {.smooth = 0, .flip = false});
    }
}

TEST_CASE("sew: on the faces around the neck of a real mesh as on the whole") {
    const auto path = data_file("models/camel_isoblend.obj");
    if (!path) return;
    Mesh mesh = load_mesh(*path);
    triangulate(mesh);
    const Vec3 point(0, 0.52, -0.6), normal(0, 0.76, -0.65);
    const auto below = [&](const Vec3& p) { return (p - point).dot(normal) < 0.0; };
    SewScene scene{cut_in_two(mesh, below).target, cut_in_two(subdivide(mesh), below).source, {}};
    add_join(scene, 0, 0, Vec3(0.1, 1.0, 0.2).cross(normal));
    check_same(scene, {.collar = true});
}

TEST_CASE("sew: a piece that is most of the meshes is not taken out") {
    const SewScene scene = two_tubes(12, 12);
    const Mesh mesh = unconnected(scene.target, scene.source, {});
    const BothSides both{mesh, scene.target.vertex_count(), scene.target.face_count()};
    CHECK(!sewn_piece(both, scene.joins, {}, {}));
}

TEST_CASE("piece: what changed near its rim is seen") {
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {40, 40}});
    triangulate(mesh);
    const Index middle = mesh.face_count() / 2;
    const auto piece = piece_around(mesh, {&middle, 1}, 8, {});
    REQUIRE(piece);
    Places place;
    for (Index v = 0; v < piece->mesh.vertex_count(); ++v) place.vertices.push_back(v);
    for (Index f = 0; f < piece->mesh.face_count(); ++f) place.faces.push_back(f);
    const auto kept = [&](const Mesh& now) {
        return keeps_rim(mesh, *piece,
                         {now, place, piece->mesh.vertex_count(), piece->mesh.face_count()});
    };
    CHECK(kept(piece->mesh));
    // Far from the rim anything may move, beside it nothing.
    Index inner = kNoIndex, outer = kNoIndex;
    const Vec3 center = mesh.position(mesh.topology().face(middle)[0]);
    for (Index v = 0; v < piece->mesh.vertex_count(); ++v) {
        const auto away = [&](Index w) { return (piece->mesh.position(w) - center).norm(); };
        if (inner == kNoIndex || away(v) < away(inner)) inner = v;
        if (outer == kNoIndex || away(v) > away(outer)) outer = v;
    }
    for (const Index v : {inner, outer}) {
        Mesh moved = piece->mesh;
        moved.set_position(v, moved.position(v) + Vec3(0, 0.1, 0));
        CHECK(kept(moved) == (v == inner));
    }
    const PutBack back =
        put_back(mesh, {mesh.vertex_count(), mesh.face_count()}, *piece,
                 {piece->mesh, place, piece->mesh.vertex_count(), piece->mesh.face_count()}, {});
    CHECK(hash(back.mesh) == hash(mesh));
}
