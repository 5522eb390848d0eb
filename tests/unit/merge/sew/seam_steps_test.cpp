// No step that is done to a seam makes it worse: umbrella, flips, fairing, transitions, collars.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>

#include "kernel/merge/blend/fair_seam.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/merge/sew/seam_scenes.h"
#include "tests/unit/mesh/mesh_support.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

constexpr double kStepDegree = kPi / 180.0;

// Two tubes that meet at an angle, so that there is something to smooth.
SewScene bent_tubes(Index target, Index source) {
    SewScene scene = two_tubes(target, source);
    for (Vec3& p : scene.source.edit_positions()) p.x() += 0.4 * std::max(0.0, p.y());
    bring_together(scene.target, scene.source, scene.joins[0]);
    return scene;
}

// Quads in two triangles whose diagonals meet at every other vertex of a row, so that the faces on
// both sides of each column are mirror images.
Mesh with_mirrored_diagonals(const Mesh& tube) {
    FaceList faces;
    for (Index f = 0; f < tube.face_count(); ++f) {
        const std::span<const Index> q = tube.topology().face(f);
        const std::size_t first = f % 2;
        faces.add({q[first], q[first + 1], q[first + 2]});
        faces.add({q[first + 2], q[(first + 3) % 4], q[first]});
    }
    return {{tube.positions().begin(), tube.positions().end()}, std::move(faces)};
}

Sewn sewn_tubes(const SewScene& scene, const SewOptions& options) {
    return sew(scene.target, scene.source, scene.joins, options);
}

void check_no_worse(const SeamQuality& before, const SeamQuality& after) {
    CHECK(after.max_dihedral <= before.max_dihedral + 1e-5);
    CHECK(after.max_near <= before.max_near + 1e-5);
}

// The smallest angle of the triangles of one side that touch the seam, in degrees.
double smallest_at_seam(const Sewn& sewn, SeamSide side) {
    const std::set<Index> on(sewn.seams[0].begin(), sewn.seams[0].end());
    double smallest = 180.0;
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        const std::span<const Index> face = sewn.mesh.topology().face(f);
        if (sewn.side_of_face[f] != side || face.size() != 3) continue;
        if (std::none_of(face.begin(), face.end(), [&](Index v) { return on.contains(v); })) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 at = sewn.mesh.position(face[k]);
            const Vec3 u = (sewn.mesh.position(face[(k + 1) % 3]) - at).normalized();
            const Vec3 w = (sewn.mesh.position(face[(k + 2) % 3]) - at).normalized();
            smallest = std::min(smallest, std::acos(std::clamp(u.dot(w), -1.0, 1.0)) / kStepDegree);
        }
    }
    return smallest;
}

void add_position_attribute(Mesh& mesh, Domain domain) {
    Attribute attribute{domain == Domain::corner ? "uv" : "place",
                        domain,
                        domain == Domain::corner ? 2 : 3,
                        ScalarType::float64,
                        {}};
    const auto add = [&](const Vec3& p) {
        for (Index k = 0; k < attribute.width; ++k) attribute.values.push_back(p[k]);
    };
    if (domain == Domain::vertex) {
        for (const Vec3& p : mesh.positions()) add(p);
    } else {
        for (const Index v : mesh.topology().faces().vertices) add(mesh.position(v));
    }
    mesh.attributes().add(std::move(attribute));
}

}  // namespace

TEST_CASE("a seam smoothed more often is never worse, between loops of like and unlike density") {
    for (const auto& counts : {std::pair<Index, Index>{8, 120}, {120, 8}, {24, 31}}) {
        CAPTURE(counts.first);
        CAPTURE(counts.second);
        const SewScene scene = bent_tubes(counts.first, counts.second);
        for (const bool collar : {false, true}) {
            SeamQuality last;
            for (const Index smooth : {0, 1, 3, 10}) {
                const Sewn sewn = sewn_tubes(scene, {.smooth = smooth, .collar = collar});
                if (smooth > 0) check_no_worse(last, sewn.report.after);
                check_no_worse(sewn.report.before, sewn.report.after);
                CHECK(sewn.report.smoothed <= smooth);
                CHECK(self_intersections(sewn.mesh).empty());
                last = sewn.report.after;
            }
        }
    }
}

TEST_CASE("fairing and transitions between loops of unlike density do not fold") {
    for (const auto& counts : {std::pair<Index, Index>{8, 300}, {300, 8}, {16, 90}}) {
        CAPTURE(counts.first);
        const SewScene scene = bent_tubes(counts.first, counts.second);
        const Sewn sewn = sewn_tubes(scene, {.smooth = 0});
        Mesh faired = sewn.mesh;
        fair_seam(faired, sewn.seams);
        check_no_worse(sewn.report.before, seam_quality(faired, sewn.seams));
        CHECK(self_intersections(faired).empty());
        for (const double width : {0.3, 0.9}) {
            Sewn blended = sewn;
            const std::vector<TransitionWidths> widths{{width, width}};
            const TransitionReport report = blend_transition(blended, widths);
            check_no_worse(sewn.report.before, seam_quality(blended.mesh, blended.seams));
            CHECK(self_intersections(blended.mesh).empty());
            CHECK(report.kept >= 0.0);
            CHECK(report.kept <= 1.0);
        }
    }
}

TEST_CASE("a transition turns no seam more than smoothing left it, up to angles that do not show") {
    for (const auto& counts : {std::pair<Index, Index>{8, 300}, {300, 8}, {16, 90}, {24, 31}}) {
        CAPTURE(counts.first);
        SewScene scene = bent_tubes(counts.first, counts.second);
        for (Vec3& p : scene.source.edit_positions()) p *= 1.0 + 0.1 * std::sin(9.0 * p.y());
        bring_together(scene.target, scene.source, scene.joins[0]);
        const Sewn sewn = sewn_tubes(scene, {.smooth = 10});
        const double faint = 10.0 * kStepDegree, faint_seam = 20.0 * kStepDegree;
        for (const double width : {0.3, 0.9}) {
            Sewn blended = sewn;
            const std::vector<TransitionWidths> widths{{width, width}};
            blend_transition(blended, widths);
            const SeamQuality before = seam_quality(sewn.mesh, sewn.seams),
                              after = seam_quality(blended.mesh, blended.seams);
            CHECK(after.max_dihedral <= std::max(before.max_dihedral, faint_seam) + 1e-5);
            CHECK(after.max_near <= std::max(before.max_near, faint) + 1e-5);
        }
    }
}

TEST_CASE("a collar leaves no slivers beside a seam with a sparse side, and keeps the surface") {
    for (const auto& counts : {std::pair<Index, Index>{8, 300}, {16, 120}, {300, 8}, {22, 80}}) {
        CAPTURE(counts.first);
        CAPTURE(counts.second);
        const SewScene scene = two_tubes(counts.first, counts.second);
        const Sewn plain = sewn_tubes(scene, {.smooth = 0});
        const Sewn sewn = sewn_tubes(scene, {.smooth = 0, .collar = true});
        const SeamSide sparse = counts.first < counts.second ? SeamSide::target : SeamSide::source;
        CHECK(smallest_at_seam(plain, sparse) < 8.0);
        CHECK(smallest_at_seam(sewn, sparse) > 15.0);
        CHECK(sewn.report.collar_removed > 0);
        CHECK(sewn.report.collar_added > sewn.report.collar_removed);
        check_no_worse(plain.report.before, sewn.report.after);
        CHECK(euler_characteristic(sewn.mesh.topology()) == 0);
        CHECK(self_intersections(sewn.mesh).empty());
        // The edges of a prism of up to 16 sides are sharp; those of one with 22 are not.
        const SpatialTree surface(plain.mesh);
        for (const Vec3& p : sewn.mesh.positions()) {
            CHECK(surface.nearest(p).distance < (counts.first == 22 ? 0.01 : 1e-9));
        }
        // Seams keep their vertices.
        REQUIRE(sewn.seams[0].size() == plain.seams[0].size());
        for (std::size_t k = 0; k < sewn.seams[0].size(); ++k) {
            CHECK(sewn.mesh.position(sewn.seams[0][k]) == plain.mesh.position(plain.seams[0][k]));
        }
    }
}

TEST_CASE("a collar between loops of which one side is all seam is whole") {
    // The triangle has no vertex but those that meet the target's, and no side but the seam.
    const Mesh ball = make_sphere({.segments = 40});
    const Mesh target = cut(ball, CutPlane{{0, 0.6, 0}, {0, 1, 0}}).kept.mesh;
    FaceList one;
    one.add({0, 1, 2});
    const Mesh triangle({{0, 0, 0}, {1, 0, 0}, {0.2, 1, 0}}, std::move(one));
    const Mesh* targets[] = {&target};
    const MergeResult result =
        Merger(triangle, targets, {Join{boundaries(triangle)[0], boundaries(target)[0]}}).solve();
    CHECK(result.report.seam.collar_added > 0);
    CHECK(result.mesh.topology().is_closed());
}

TEST_CASE("with collars a merge is the same wherever its source lies, symmetric as it may be") {
    // The collar is on the source, whose faces are mirror images of each other: what is nearest to
    // the middle of an edge across the plane between them is a tie.
    for (const auto& counts : {std::pair<Index, Index>{90, 14}, {96, 24}, {120, 20}, {160, 32}}) {
        CAPTURE(counts.second);
        SewScene scene = two_tubes(counts.first, counts.second);
        for (Vec3& p : scene.source.edit_positions()) p *= 1.0 + 0.2 * std::sin(4.0 * p.y());
        scene.source = with_mirrored_diagonals(scene.source);
        const auto merged_from = [&](const Mesh& source) {
            const auto key = [&](const Mesh& mesh, double sign) {
                const auto& loop = mesh.topology().boundary_loops()[boundary_towards(mesh, sign)];
                return *std::max_element(loop.begin(), loop.end(), [&](Index a, Index b) {
                    return mesh.position(a).x() < mesh.position(b).x();
                });
            };
            MergeOptions options;
            options.subdivide = false;
            const Mesh* targets[] = {&scene.target};
            return Merger(source, targets,
                          {Join{boundaries(source)[boundary_towards(scene.source, -1.0)],
                                boundaries(scene.target)[boundary_towards(scene.target, 1.0)],
                                0,
                                {{key(scene.source, -1.0), key(scene.target, 1.0)}}}},
                          options)
                .solve();
        };
        const MergeResult first = merged_from(scene.source);
        REQUIRE(first.report.seam.collar_added > 0);
        Random random(3);
        for (int trial = 0; trial < 8; ++trial) {
            const MergeResult other =
                merged_from(moved(scene.source, similarity(random, trial % 2 == 0 ? 0.01 : 50.0)));
            REQUIRE(other.mesh.topology().faces().vertices ==
                    first.mesh.topology().faces().vertices);
            for (Index f = 0; f < first.mesh.face_count(); ++f) {
                CHECK(other.provenance.faces.main_source(f) ==
                      first.provenance.faces.main_source(f));
            }
            for (Index v = 0; v < first.mesh.vertex_count(); ++v) {
                CHECK((other.mesh.position(v) - first.mesh.position(v)).norm() < 1e-9);
            }
        }
    }
}

TEST_CASE("a collar makes no more triangles of needles than edges that grow through them need") {
    // One ring of needles stands on the seam: their edges of the next ring are as short as its own.
    for (const Index needles : {100, 200, 400}) {
        CAPTURE(needles);
        SewScene scene{make_tube(24, -2.0, 2.0), make_tube(needles, 0.0, 2.0, 1.0, 1), {}};
        add_join(scene, boundary_towards(scene.target, 1.0), boundary_towards(scene.source, -1.0),
                 Vec3(1.0, 0.0, 1e-3));
        const Sewn sewn = sewn_tubes(scene, {.smooth = 0, .collar = true});
        CHECK(sewn.report.collar_added < 30 * needles);
    }
}

TEST_CASE("edges grow evenly through a collar") {
    const SewScene scene = two_tubes(8, 300);
    const Sewn sewn = sewn_tubes(scene, {.smooth = 0, .collar = true});
    const Topology& topology = sewn.mesh.topology();
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        const std::span<const Index> face = topology.face(f);
        if (sewn.side_of_face[f] != SeamSide::target || face.size() != 3) continue;
        double low = 1e9, high = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double length =
                (sewn.mesh.position(face[k]) - sewn.mesh.position(face[(k + 1) % 3])).norm();
            low = std::min(low, length);
            high = std::max(high, length);
        }
        CHECK(high < 4.0 * low);
    }
}

TEST_CASE(
    "without a collar, or between loops of equal density, nothing beside the seam is made anew") {
    const SewScene scene = two_tubes(8, 300);
    const Sewn sewn = sewn_tubes(scene, {.smooth = 0});
    CHECK(sewn.report.collar_added == 0);
    for (Index v = 0; v < scene.target.vertex_count(); ++v) {
        CHECK(sewn.mesh.position(v) == scene.target.position(v));
    }
    const SewScene equal = two_tubes(24, 24);
    CHECK(sewn_tubes(equal, {.collar = true}).report.collar_added == 0);
}

TEST_CASE("collars keep elements beyond them, and what they carry is where it was") {
    SewScene scene = two_tubes(16, 200);
    add_position_attribute(scene.target, Domain::vertex);
    add_position_attribute(scene.source, Domain::vertex);
    add_position_attribute(scene.target, Domain::corner);
    add_position_attribute(scene.source, Domain::corner);
    FaceLabels material{{"even", "odd"}, {}};
    for (Index f = 0; f < scene.target.face_count(); ++f) material.of_face.push_back(f % 2);
    scene.target.attributes().labels().emplace("material", material);
    const Sewn sewn = sewn_tubes(scene, {.smooth = 0, .collar = true});
    REQUIRE(sewn.report.collar_added > 0);
    const Attribute& place = *sewn.mesh.attributes().find("place");
    const Attribute& uv = *sewn.mesh.attributes().find("uv");
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        const Vec3 p(place.at(v)[0], place.at(v)[1], place.at(v)[2]);
        // The source's loop was brought from its circle onto the target's polygon.
        CHECK((p - sewn.mesh.position(v)).norm() < 0.02);
    }
    const Topology& topology = sewn.mesh.topology();
    for (Index f = 0; f < topology.face_count(); ++f) {
        for (Index k = 0; k < static_cast<Index>(topology.face(f).size()); ++k) {
            const Vec3& p = sewn.mesh.position(topology.face(f)[k]);
            const auto at = uv.at(topology.first_corner(f) + k);
            CHECK(std::abs(at[0] - p.x()) < 0.02);
            CHECK(std::abs(at[1] - p.y()) < 0.02);
        }
    }
    // Labels keep their borders: every face lies in one of its label.
    const FaceLabels& labels = sewn.mesh.attributes().labels().at("material");
    for (Index f = 0; f < topology.face_count(); ++f) {
        const Index origin = sewn.map.faces.main_source(f);
        if (sewn.side_of_face[f] == SeamSide::source) continue;
        CHECK(labels.of_face[f] == origin % 2);
        Vec3 middle = Vec3::Zero();
        for (const Index v : topology.face(f)) {
            middle += sewn.mesh.position(v) / static_cast<double>(topology.face(f).size());
        }
        Vec3 low = Vec3::Constant(1e9), high = -low;
        for (const Index v : scene.target.topology().face(origin)) {
            low = low.cwiseMin(scene.target.position(v));
            high = high.cwiseMax(scene.target.position(v));
        }
        CHECK((middle - low).minCoeff() > -1e-9);
        CHECK((high - middle).minCoeff() > -1e-9);
    }
    // The target's vertices come before the source's, and so do its faces.
    const Index targets = scene.target.vertex_count();
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        const auto sources = sewn.map.vertices[v];
        if (sources.size() == 1)
            CHECK((sources[0].element >= targets) == (v >= sewn.first_source_vertex));
    }
    CHECK(std::is_sorted(sewn.side_of_face.begin(), sewn.side_of_face.end()));
}

TEST_CASE("the collar of a merge follows a similarity of the inputs") {
    const SewScene scene = bent_tubes(12, 130);
    const Sewn sewn = sewn_tubes(scene, {.collar = true});
    for (const double scale : {1e-3, 1e3}) {
        SewScene moved = scene;
        const double c = std::cos(1.0), s = std::sin(1.0);
        const auto map = [&](const Vec3& p) {
            return Vec3(scale * Vec3(c * p.x() - s * p.y() + 3.0, s * p.x() + c * p.y(), p.z()));
        };
        for (Mesh* mesh : {&moved.target, &moved.source}) {
            for (Vec3& p : mesh->edit_positions()) p = map(p);
        }
        const Sewn other = sewn_tubes(moved, {.collar = true});
        REQUIRE(other.mesh.topology().faces().vertices == sewn.mesh.topology().faces().vertices);
        for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
            CHECK((other.mesh.position(v) - map(sewn.mesh.position(v))).norm() < 1e-9 * scale);
        }
    }
}

namespace {

// A dome that is open at z = 0, with a vertex all of whose faces touch the opening, drawn outward;
// behind the dent a small tetrahedron that touches nothing.
Mesh dented_dome(bool with_tetrahedron) {
    const Mesh open = tube(12, 7, [](double angle, double height) {
        const double r = std::sqrt(1.0 - 0.9 * height * height);
        return Vec3(r * std::cos(angle), r * std::sin(angle), -2.0 * height);
    });
    std::vector<Vec3> positions(open.positions().begin(), open.positions().end());
    FaceList faces;
    for (Index f = 0; f < open.face_count(); ++f) {
        const std::span<const Index> face = open.topology().face(f);
        // The first triangle with an edge on the opening.
        if (f != 0) {
            faces.add({face[0], face[2], face[1]});
            continue;
        }
        const auto apex = static_cast<Index>(positions.size());
        Vec3 middle = Vec3::Zero();
        for (const Index v : face) middle += open.position(v) / 3.0;
        positions.push_back(middle + 0.3 * Vec3(middle.x(), middle.y(), 0.0).normalized());
        for (std::size_t k = 0; k < 3; ++k) faces.add({face[(k + 1) % 3], face[k], apex});
    }
    std::vector<Index> end;
    for (Index k = 0; k < 12; ++k) end.push_back(6 * 12 + k);
    std::reverse(end.begin(), end.end());
    faces.add(end);
    Mesh mesh(std::move(positions), std::move(faces));
    if (!with_tetrahedron) return mesh;
    const std::span<const Index> face = open.topology().face(0);
    Vec3 middle = Vec3::Zero();
    for (const Index v : face) middle += open.position(v) / 3.0;
    const Vec3 out = Vec3(middle.x(), middle.y(), 0.0).normalized();
    FaceList small;
    for (const auto& [a, b, c] : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
        small.add({a, b, c});
    }
    const double h = 0.03;
    append(mesh, Mesh({middle + h * out, middle - h * out + h * Vec3::UnitZ(),
                       middle - h * out - h * Vec3::UnitZ() + h * out.cross(Vec3::UnitZ()),
                       middle - h * out - h * Vec3::UnitZ() - h * out.cross(Vec3::UnitZ())},
                      small));
    return mesh;
}

MergeResult merged_domes(const Mesh& target, const MergeOptions& options) {
    Mesh source = dented_dome(false);
    // Wider one way, so that the parts do not fit as they are.
    transform(source, scaling({1.1, 1.0, 1.0}, Vec3::Zero()));
    const Mesh* targets[] = {&target};
    return Merger(source, targets, {Join{boundaries(source)[0], boundaries(target)[0]}}, options)
        .solve();
}

}  // namespace

TEST_CASE("a band takes along vertices that lose all of their faces") {
    MergeOptions options;
    options.seam = SeamKind::band;
    const MergeResult result = merged_domes(dented_dome(false), options);
    CHECK(result.mesh.topology().component_count() == 1);
    CHECK(result.mesh.topology().is_closed());
    for (Index v = 0; v < result.mesh.vertex_count(); ++v) {
        CHECK_FALSE(result.mesh.topology().is_isolated(v));
    }
}

TEST_CASE("faces of the target that newly run through others of the target are reported") {
    const Mesh target = dented_dome(true);
    REQUIRE(self_intersections(target).empty());
    MergeOptions options;
    options.seam = SeamKind::band;
    options.smooth = 0;
    options.collar = false;
    const MergeResult result = merged_domes(target, options);
    CHECK_FALSE(result.report.intersections.empty());
    for (const FacePair& pair : result.report.intersections) {
        CHECK(result.side_of_face[pair.first] == SeamSide::target);
        CHECK(result.side_of_face[pair.second] == SeamSide::target);
    }
}

TEST_CASE("a result that is not sound is an error") {
    const SewScene scene = two_tubes(12, 17);
    Sewn sewn = sewn_tubes(scene, {});
    const auto checked = [&](std::span<const LoopPair> joins) {
        require_sound(sewn, scene.target, scene.source, joins);
    };
    CHECK_NOTHROW(checked(scene.joins));
    CHECK(error_of([&] { checked({}); }).code() == ErrorCode::internal);
    std::vector<Vec3> positions(sewn.mesh.positions().begin(), sewn.mesh.positions().end());
    positions.push_back(Vec3::Zero());
    sewn.mesh = Mesh(std::move(positions), sewn.mesh.topology().faces());
    const Error error = error_of([&] { checked(scene.joins); });
    CHECK(error.code() == ErrorCode::internal);
    CHECK(error.elements().ids.size() == 1);
    sewn = sewn_tubes(scene, {});
    append(sewn.mesh, make_torus({}));
    CHECK(error_of([&] { checked(scene.joins); }).message().find("components") !=
          std::string::npos);
    append(sewn.mesh, make_sphere({}));
    CHECK(error_of([&] { checked(scene.joins); }).message().find("Euler") != std::string::npos);
}

TEST_CASE("the turn of a boundary is told where it is not trimmed too") {
    Mesh jagged = round_tube(24, 5), smooth = round_tube(24, 5);
    for (Index k = 0; k < 24; k += 2) jagged.edit_positions()[k].z() -= 0.2;
    const auto lower = [](const Mesh& mesh) {
        for (const Path& path : boundaries(mesh)) {
            if (path.vertices().front() < 24) return path;
        }
        return boundaries(mesh).front();
    };
    const Mesh* targets[] = {&smooth};
    MergeOptions options;
    options.trim = false;
    const MergeResult result =
        Merger(jagged, targets, {Join{lower(jagged), lower(smooth)}}, options).solve();
    CHECK(result.report.joins[0].source_turn > 20.0 * kStepDegree);
    CHECK(result.report.joins[0].target_turn == doctest::Approx(15.0 * kStepDegree));
    CHECK_FALSE(result.report.joins[0].source_trimmed);
}

TEST_CASE("steps without a guard are made whole, and as many as are asked for") {
    // A fan between a dense and a sparse loop folds at once.
    const SewScene scene = bent_tubes(8, 300);
    SewOptions guarded;
    guarded.flip = false;
    guarded.smooth = 4;
    SewOptions plain = guarded;
    plain.guard = false;
    const Sewn kept = sewn_tubes(scene, guarded), folded = sewn_tubes(scene, plain);
    CHECK(folded.report.smoothed == 4);
    CHECK(folded.report.after.max_dihedral > 2.0 * kept.report.after.max_dihedral);
    // One step: half of the way to the mean of the neighbours on the seam, a quarter beside it.
    plain.smooth = 0;
    const Mesh before = sewn_tubes(scene, plain).mesh;
    plain.smooth = 1;
    const Sewn after = sewn_tubes(scene, plain);
    const std::set<Index> on(after.seams[0].begin(), after.seams[0].end());
    Index moved = 0;
    for (Index v = 0; v < before.vertex_count(); ++v) {
        if (after.mesh.position(v) == before.position(v)) continue;
        Vec3 mean = Vec3::Zero();
        for (const Index n : before.topology().neighbors(v)) {
            mean += before.position(n) / before.topology().valence(v);
        }
        const Vec3 to =
            before.position(v) + (on.contains(v) ? 0.5 : 0.25) * (mean - before.position(v));
        CHECK((after.mesh.position(v) - to).norm() < 1e-12);
        ++moved;
    }
    CHECK(moved > 300);
}
