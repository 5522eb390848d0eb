// A paste works on a piece of the target, and leaves what a paste onto all of it would.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "kernel/merge/paste/part/target_piece.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/merge/thesis_parts.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

void add_coordinates(Mesh& mesh) {
    Attribute uv{"uv", Domain::vertex, 2, ScalarType::float64, {}};
    std::vector<Index> half;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        uv.values.push_back(mesh.position(v).x());
        uv.values.push_back(mesh.position(v).y());
        if (mesh.position(v).z() > 0.0) half.push_back(v);
    }
    mesh.attributes().add(std::move(uv));
    mesh.set_region("half", Region(mesh.shared_topology(), half));
}

// Where a part alone has a skin, its weights go on over all of the target: that is pasted whole.
void add_skin(Mesh& mesh) {
    Attribute joints{"joints", Domain::vertex, 4, ScalarType::uint16, {}};
    Attribute weights{"weights", Domain::vertex, 4, ScalarType::float32, {}};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        for (const double j : {1.0, 0.0, 0.0, 0.0}) joints.values.push_back(j);
        for (const double w : {1.0, 0.0, 0.0, 0.0}) weights.values.push_back(w);
    }
    mesh.attributes().add(std::move(joints));
    mesh.attributes().add(std::move(weights));
}

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

}  // namespace

TEST_CASE("paste: onto a piece of the target as onto all of it") {
    Mesh horn = horned_ball(), target = egg(40);
    add_coordinates(horn);
    add_coordinates(target);
    Mesh skinned = horn;
    add_skin(skinned);
    for (const Vec3& at : {Vec3(0, 2, 0), Vec3(1, 1.2, 0.8), Vec3(0, 0, 1.6)}) {
        for (const bool optimized : {false, true}) {
            CAPTURE(optimized);
            const PastePlacement placement{.at = at, .angle = 0.4, .scale = 0.5};
            const auto pasted = [&](const Mesh& source) {
                Paste paste = horn_on_egg(source, target, placement);
                if (optimized) paste.optimize();
                return paste.merge();
            };
            const PasteResult piece = pasted(horn);
            PasteResult whole = pasted(skinned);
            REQUIRE(whole.merged.mesh.attributes().find("joints"));
            whole.merged.mesh.attributes().remove("joints");
            whole.merged.mesh.attributes().remove("weights");
            CHECK(hash(piece.merged.mesh) == hash(whole.merged.mesh));
            CHECK(same_map(piece.merged.provenance.vertices, whole.merged.provenance.vertices));
            CHECK(same_map(piece.merged.provenance.corners, whole.merged.provenance.corners));
            CHECK(same_map(piece.merged.provenance.faces, whole.merged.provenance.faces));
            CHECK(piece.merged.side_of_face == whole.merged.side_of_face);
            CHECK(piece.merged.seams == whole.merged.seams);
            CHECK(piece.merged.report.verdict == whole.merged.report.verdict);
            CHECK(piece.merged.report.intersections == whole.merged.report.intersections);
            CHECK(piece.report.near.energy == whole.report.near.energy);
        }
    }
}

TEST_CASE("paste: the piece of a target is small, and what is near in space belongs to it") {
    // A flat box: what is under the part runs near below it.
    Mesh target = make_sphere({1.0, 40, SphereKind::triangles});
    for (Vec3& p : target.edit_positions()) p.y() *= 0.005;
    const auto chart_at = [&](double radius) {
        const std::vector<Index> faces =
            disk_around(target, SpatialTree(target).nearest({0, 0.005, 0}), radius, {});
        return target_chart(target, faces, ParameterizeMethod::arap, {});
    };
    const PasteChart chart = chart_at(0.2);
    const TargetPiece piece(target, chart, {});
    REQUIRE(!piece.is_whole());
    CHECK(2 * piece.mesh().face_count() < target.face_count());
    const auto positions = piece.mesh().positions();
    CHECK(std::any_of(positions.begin(), positions.end(), [](const Vec3& p) {
        return p.y() < -0.002 && std::hypot(p.x(), p.z()) < 0.1;
    }));
    for (std::size_t k = 0; k < chart.map.vertex.size(); ++k) {
        CHECK(piece.mesh().position(piece.chart_vertices()[k]) ==
              target.position(chart.map.vertex[k]));
    }
}

namespace {

const PastePlacement kHere{.at = {1, 1.2, 0.8}, .angle = 0.4, .scale = 0.6};
const PastePlacement kThere{.at = {1.1, 1.0, 0.8}, .angle = 0.6, .scale = 0.55};

Paste horn_in_region(const Mesh& horn, const Mesh& target) {
    return Paste(horn, target, around_horn(horn), std::nullopt,
                 select_sphere(target, kHere.at, 1.5), kHere);
}

}  // namespace

TEST_CASE("paste: what is kept between moves changes no result") {
    Mesh horn = horned_ball(), target = egg(40);
    add_coordinates(horn);
    add_coordinates(target);
    Paste fresh = horn_in_region(horn, target);
    fresh.optimize();
    fresh.move(kThere);
    const PasteResult expected = fresh.merge();
    Paste used = horn_in_region(horn, target);
    used.optimize();
    for (const bool draft : {true, false}) {
        PasteMergeOptions how;
        how.draft = draft;
        used.merge(how);
    }
    used.move(kThere);
    PasteMergeOptions draft;
    draft.draft = true;
    used.merge(draft);
    const PasteResult moved = used.merge();
    CHECK(hash(moved.merged.mesh) == hash(expected.merged.mesh));
    CHECK(moved.report.near.energy == expected.report.near.energy);
    CHECK(same_map(moved.merged.provenance.corners, expected.merged.provenance.corners));

    // Sought anew, it is what a paste that begins there finds.
    used.optimize();
    Paste there(horn, target, around_horn(horn), std::nullopt, select_sphere(target, kHere.at, 1.5),
                kThere);
    there.optimize();
    CHECK(hash(used.merge().merged.mesh) == hash(there.merge().merged.mesh));
}

namespace {

using Point = std::array<double, 3>;

std::set<Point> points_of(const Mesh& mesh, const std::vector<Index>& vertices) {
    std::set<Point> points;
    for (const Index v : vertices) {
        const Vec3& p = mesh.position(v);
        points.insert({p.x(), p.y(), p.z()});
    }
    return points;
}

std::vector<Index> all_of(const Mesh& mesh) {
    std::vector<Index> vertices(static_cast<std::size_t>(mesh.vertex_count()));
    std::iota(vertices.begin(), vertices.end(), 0);
    return vertices;
}

Vec3 triangle_middle(const Mesh& mesh, Index face) {
    Vec3 sum = Vec3::Zero();
    for (const Index v : mesh.topology().face(face)) sum += mesh.position(v) / 3.0;
    return sum;
}

// Vertices of the merged faces that come from the source.
std::vector<Index> of_source(const MergeResult& merged) {
    std::set<Index> vertices;
    for (Index f = 0; f < merged.mesh.face_count(); ++f) {
        if (merged.side_of_face[static_cast<std::size_t>(f)] != SeamSide::source) continue;
        const auto face = merged.mesh.topology().face(f);
        vertices.insert(face.begin(), face.end());
    }
    return {vertices.begin(), vertices.end()};
}

// The greatest distance of a mesh's vertices from another mesh.
double max_distance(const Mesh& mesh, const Mesh& from) {
    const SpatialTree tree(from);
    double greatest = 0.0;
    for (const Vec3& p : mesh.positions()) {
        greatest = std::max(greatest, tree.nearest(p).distance);
    }
    return greatest;
}

// All of the part's vertices are the merged part's, to the bit, but for those of its boundary that
// sewing drops; what the merged part has more lies in the seam. A seam at which faces turn over is
// smoothed.
void check_part(Paste& paste, const PasteDraftOptions& options = {}) {
    PasteMergeOptions how;
    how.draft = true;
    how.lock_scale = options.lock_scale;
    how.compare = options.compare;
    const PasteDraft draft = paste.draft(options);
    const PasteResult whole = paste.merge(how);
    const Mesh& mesh = whole.merged.mesh;
    const std::set<Point> part = points_of(draft.part, all_of(draft.part));
    const std::set<Point> merged = points_of(mesh, of_source(whole.merged));
    const std::set<Point> rim = points_of(draft.part, draft.rim);
    const std::set<Point> seam = points_of(mesh, whole.merged.seams.front());
    CHECK(part.size() == static_cast<std::size_t>(draft.part.vertex_count()));
    std::vector<Point> fewer, more;
    std::set_difference(part.begin(), part.end(), merged.begin(), merged.end(),
                        std::back_inserter(fewer));
    if (whole.merged.report.seam.smoothed == 0) {
        CHECK(std::includes(rim.begin(), rim.end(), fewer.begin(), fewer.end()));
        CHECK(count_of(fewer) == whole.merged.report.seam.collapsed);
        std::set_difference(merged.begin(), merged.end(), part.begin(), part.end(),
                            std::back_inserter(more));
        CHECK(std::includes(seam.begin(), seam.end(), more.begin(), more.end()));
    } else {
        CHECK(max_distance(draft.part, mesh) < 0.1 * draft.scale);
    }
    CHECK(draft.part.topology().boundary_loops().size() == 1);
    CHECK(draft.scale == whole.report.scale);
    CHECK(draft.smooth == whole.report.smooth);
    CHECK(draft.kept_outline == whole.report.kept_outline);
    CHECK(draft.near.energy == whole.report.near.energy);
    CHECK(draft.laid.energy == whole.report.laid.energy);
}

}  // namespace

TEST_CASE("paste: a part alone is that of a draft of the paste, to the bit") {
    Mesh horn = horned_ball(), target = egg(40);
    add_coordinates(horn);
    for (const bool in_region : {false, true}) {
        for (const bool optimized : {false, true}) {
            Paste paste =
                in_region ? horn_in_region(horn, target) : horn_on_egg(horn, target, kHere);
            if (optimized) paste.optimize();
            check_part(paste);
            paste.slide(kThere);
            check_part(paste);
            paste.move(kThere);
            check_part(paste);
            // Onto another disk, where there is no region.
            if (!in_region) paste.move({.at = {0.0, -1.0, -1.5}, .angle = 1.0, .scale = 0.5});
            check_part(paste);
            check_part(paste, {.lock_scale = true, .compare = false});
        }
    }
}

TEST_CASE(
    "paste: a part alone on polygons, with a skin, along edges, by the thesis, and on a target "
    "that is cleared") {
    const Mesh horn = horned_ball();
    Mesh polygons = make_sphere({1.5, 30, SphereKind::quads});
    for (const bool skinned : {false, true}) {
        Mesh source = horn;
        if (skinned) add_skin(source);
        Paste paste = horn_on_egg(source, polygons, {.at = {0, 1.5, 0}, .scale = 0.5});
        paste.optimize();
        check_part(paste);
    }
    PasteOptions mesh_loop, thesis, clear;
    mesh_loop.loop = PasteBoundary::mesh;
    thesis.thesis = test::thesis();
    clear.clear = true;
    for (const PasteOptions& options : {mesh_loop, thesis, clear}) {
        Paste paste = horn_on_egg(horn, egg(40), kHere, options);
        paste.optimize();
        check_part(paste);
        paste.move(kThere);
        check_part(paste);
    }
}

TEST_CASE("paste: a part alone finds room as the paste does, and stays where it was") {
    const Mesh horn = horned_ball();
    // No vertex of the target as given lies under the part.
    const Mesh coarse = egg(2);
    Paste paste = horn_on_egg(horn, coarse, {.at = triangle_middle(coarse, 0), .scale = 0.1});
    check_part(paste);
    const PasteResult whole = paste.merge();
    CHECK(whole.merged.mesh.topology().is_closed());
    for (const ElementMap::Source& source : whole.merged.provenance.vertices[0]) {
        CHECK(source.element == 0);
    }
    for (Index v = 0; v < coarse.vertex_count(); ++v) {
        CHECK(whole.merged.mesh.position(v) == coarse.position(v));
    }
    const Mesh fine = egg(40);
    Paste good = horn_on_egg(horn, fine, kHere);
    const PasteDraft before = good.draft();
    CHECK_THROWS_AS(good.move({.at = kHere.at, .scale = -1.0}), Error);
    CHECK(points_of(good.draft().part, all_of(before.part)) ==
          points_of(before.part, all_of(before.part)));
}

TEST_CASE("paste: a draft has the boundary of the paste, and is watertight") {
    const Mesh horn = horned_ball(), target = egg(40);
    Paste paste = horn_in_region(horn, target);
    paste.optimize();
    PasteMergeOptions how;
    how.draft = true;
    const PasteResult draft = paste.merge(how), good = paste.merge();
    CHECK(draft.report.draft);
    CHECK(!good.report.draft);
    CHECK(draft.merged.mesh.topology().is_closed());
    CHECK(draft.report.euler_characteristic == 2);
    CHECK(draft.report.near.energy >= good.report.near.energy);
    CHECK(draft.report.search.energy == good.report.search.energy);
    CHECK(draft.report.scale == good.report.scale);
    CHECK(draft.report.kept_outline == good.report.kept_outline);
    CHECK(draft.merged.report.seam.collar_added == 0);
    CHECK(draft.merged.report.seam.smoothed == 0);
    CHECK(draft.merged.report.seam.flipped == 0);
    CHECK(draft.merged.provenance.vertices.size() == 0);
}
