// Pastes from end to end on generated shapes.
#include "kernel/merge/paste/paste.h"

#include <optional>
#include <string>

#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/merge/thesis_parts.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

void check_sound(const PasteResult& result) {
    CAPTURE(result.merged.report.verdict);
    CHECK(result.merged.mesh.topology().is_closed());
    CHECK(result.merged.mesh.topology().component_count() == 1);
    CHECK(result.report.euler_characteristic == result.report.expected_characteristic);
    for (const Vec3& p : result.merged.mesh.positions()) CHECK(p.allFinite());
}

}  // namespace

TEST_CASE("paste: a horn comes to stand where it is put, watertight and little distorted") {
    const Mesh horn = horned_ball(), target = egg();
    const std::uint64_t before[] = {hash(horn), hash(target)};
    for (const Vec3& at : {Vec3(0, 2, 0), Vec3(1, 1.2, 0.8), Vec3(0, 0, 1.6)}) {
        Paste paste = horn_on_egg(horn, target, {.at = at, .scale = 0.8});
        const PasteResult plain = paste.merge();
        check_sound(plain);
        paste.optimize();
        const PasteResult best = paste.merge();
        check_sound(best);
        CHECK(best.merged.report.ok);
        CHECK(best.report.near.energy <= plain.report.near.energy);
        CHECK(best.report.near.anisotropy < 1.5);
        double tallest = 0.0;
        for (const Vec3& p : best.merged.mesh.positions()) {
            tallest = std::max(tallest, (p - at).dot(at.normalized()));
        }
        CHECK(tallest > 0.4);
    }
    CHECK(hash(horn) == before[0]);
    CHECK(hash(target) == before[1]);
}

TEST_CASE("paste: texture coordinates, skins, morphs and provenance come along") {
    Mesh horn = horned_ball(), target = egg();
    for (Mesh* mesh : {&horn, &target}) {
        const double joint = mesh == &horn ? 3 : 1;
        Attribute uv{"uv", Domain::corner, 2, ScalarType::float32, {}};
        for (const Index v : mesh->topology().faces().vertices) {
            uv.values.push_back(mesh->position(v).x());
            uv.values.push_back(mesh->position(v).y());
        }
        Attribute joints{"joints", Domain::vertex, 4, ScalarType::uint16, {}};
        Attribute weights{"weights", Domain::vertex, 4, ScalarType::float32, {}};
        for (Index v = 0; v < mesh->vertex_count(); ++v) {
            for (const double j : {joint, 0.0, 0.0, 0.0}) joints.values.push_back(j);
            for (const double w : {0.75, 0.25, 0.0, 0.0}) weights.values.push_back(w);
        }
        for (Attribute* attribute : {&uv, &joints, &weights}) {
            mesh->attributes().add(std::move(*attribute));
        }
    }
    Attribute morph{"morph.1.position", Domain::vertex, 3, ScalarType::float64, {}};
    for (Index v = 0; v < horn.vertex_count(); ++v) {
        for (const double d : {0.0, 0.1, 0.0}) morph.values.push_back(d);
    }
    horn.attributes().add(std::move(morph));
    Paste paste = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.8});
    paste.optimize();
    const PasteResult result = paste.merge();
    check_sound(result);
    const Mesh& mesh = result.merged.mesh;
    REQUIRE(mesh.attributes().find("uv"));
    const Attribute& weights = *mesh.attributes().find("weights");
    const Attribute& delta = *mesh.attributes().find("morph.1.position");
    Index kept = 0, moved = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        double sum = 0.0;
        for (const double w : weights.at(v)) sum += w;
        CHECK(sum == doctest::Approx(1.0));
        const auto from = result.merged.provenance.vertices[v];
        if (from.size() != 1) continue;
        const Vec3 d(delta.at(v)[0], delta.at(v)[1], delta.at(v)[2]);
        if (from.front().element < target.vertex_count()) {
            kept += mesh.position(v) == target.position(from.front().element) ? 1 : 0;
            CHECK(!(d.norm() > 0.0));
        } else {
            ++moved;
            CHECK(d.norm() == doctest::Approx(0.1 * result.report.scale).epsilon(0.25));
        }
    }
    CHECK(kept > target.vertex_count() / 2);
    CHECK(moved > 50);
}

TEST_CASE("paste: a feature may have a handle") {
    // A ring on a foot that widens like a funnel.
    Mesh torus = make_torus();
    const Mesh target = egg();
    const Vec3 foot(1.35, 0, 0);
    const Region region = select_sphere(torus, foot, 0.2).inverted();
    const Region feature = select_sphere(torus, foot, 0.6).inverted();
    for (Vec3& p : torus.edit_positions()) {
        const double near = std::max(0.0, 0.6 - (p - foot).norm());
        p += Vec3(near, 6.0 * near * p.y(), 6.0 * near * p.z());
    }
    Paste paste(torus, target, region, feature, std::nullopt, {.at = {0, 2, 0}, .scale = 0.5});
    paste.optimize();
    const PasteResult result = paste.merge();
    check_sound(result);
    CHECK(genus(result.merged.mesh.topology()) == 1);
}

TEST_CASE(
    "paste: an arch that was marked by its two feet comes along with the surface between them") {
    const Mesh plate = test::arched_plate();
    for (const Mesh& target : {egg(), egg(30)}) {
        Paste paste(plate, target, test::around_arch(plate), std::nullopt, std::nullopt,
                    {.at = {0, 2, 0}, .scale = 0.5});
        paste.optimize();
        const PasteResult result = paste.merge();
        check_sound(result);
        CHECK(result.report.joined);
        CHECK(genus(result.merged.mesh.topology()) == 1);
        CHECK(bounds(result.merged.mesh).max.y() > 2.3);
    }
}

TEST_CASE("paste: a crease is at most what is allowed, and takes distortion away") {
    // A tube on a ball: it would have to turn by a right angle to go on in its surface.
    Mesh tube = make_sphere({1.0, 24, SphereKind::triangles});
    for (Vec3& p : tube.edit_positions()) p = Vec3(0.4 * p.x(), 3.0 * p.y(), 0.4 * p.z());
    const Mesh target = egg();
    double last = 0.0;
    for (const double degrees : {60.0, 30.0, 0.0}) {
        PasteOptions options;
        options.crease = degrees * kDegree;
        Paste paste(tube, target, select_plane(tube, {0, -1.0, 0}, {0, 1, 0}),
                    select_plane(tube, {0, 1.0, 0}, {0, 1, 0}), std::nullopt,
                    {.at = {0, 2, 0}, .scale = 0.8}, options);
        paste.optimize();
        const PasteResult result = paste.merge();
        check_sound(result);
        CAPTURE(degrees);
        CHECK(result.merged.report.seam.after.max_dihedral < (degrees + 25.0) * kDegree);
        CHECK(result.report.near.energy > last);
        last = result.report.near.energy;
    }
    PasteOptions wrong;
    wrong.crease = -1.0;
    CHECK(error_of([&] {
              horn_on_egg(horned_ball(), target, {.at = {0, 2, 0}}, wrong);
          }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("paste: a move that does not fit keeps the last good place") {
    const Mesh horn = horned_ball(), target = egg();
    const Region top = select_plane(target, {0, 0.2, 0}, {0, 1, 0});
    Paste paste(horn, target, around_horn(horn), std::nullopt, top,
                {.at = {0, 2, 0}, .scale = 0.6});
    paste.optimize();
    const std::vector<Index> loop = paste.loop().vertices();
    const Error outside = error_of([&] { paste.move({.at = {0, -2, 0}, .scale = 0.6}); });
    CHECK(outside.code() == ErrorCode::boundary_conflict);
    CHECK(!outside.elements().ids.empty());
    const Error large = error_of([&] { paste.move({.at = {0, 2, 0}, .scale = 9.0}); });
    CHECK(large.code() == ErrorCode::boundary_conflict);
    CHECK(paste.loop().vertices() == loop);
    CHECK(paste.placement().scale == 0.6);
    check_sound(paste.merge());
    paste.move({.at = {0.6, 1.7, 0.3}, .angle = 1.0, .scale = 0.6});
    check_sound(paste.merge());
}

TEST_CASE("paste: bad input is refused by name, with ids, and the meshes stay as they are") {
    const Mesh horn = horned_ball(), target = egg(), other = make_torus();
    const Region ring = around_horn(horn);
    const std::uint64_t before[] = {hash(horn), hash(target), hash(other)};
    struct Bad {
        std::string what;
        Region region;
        std::optional<Region> feature, onto;
        const Mesh& onto_mesh;
        PastePlacement placement;
        ErrorCode code;
    };
    const PastePlacement top{.at = {0, 2, 0}, .scale = 0.6};
    const Region cap = select_plane(target, {0, 0.2, 0}, {0, 1, 0});
    // Half a torus is a band.
    const Region band = select_plane(other, {0, 0, 0}, {1, 0, 0});
    const Bad cases[] = {
        {"the feature touches the outline",
         ring,
         ring,
         {},
         target,
         top,
         ErrorCode::boundary_conflict},
        {"the region of another mesh",
         select_sphere(other, {1, 0, 0}, 0.3),
         {},
         {},
         target,
         top,
         ErrorCode::topology_mismatch},
        {"the feature of another mesh", ring, cap, {}, target, top, ErrorCode::topology_mismatch},
        {"the target's region of another mesh",
         ring,
         {},
         ring,
         target,
         top,
         ErrorCode::topology_mismatch},
        {"a target's region with a hole",
         ring,
         {},
         band,
         other,
         {.at = {1, 0.4, 0}, .scale = 0.1},
         ErrorCode::not_a_disk},
        {"a target's region with a handle",
         ring,
         {},
         Region::all(other.shared_topology()),
         other,
         {.at = {1, 0.4, 0}, .scale = 0.1},
         ErrorCode::not_a_disk},
        {"the target is smaller than the part",
         ring,
         {},
         cap,
         target,
         {.at = {0, 2, 0}, .scale = 9.0},
         ErrorCode::boundary_conflict},
        {"the point lies outside the target's region",
         ring,
         {},
         cap,
         target,
         {.at = {0, -2, 0}, .scale = 0.6},
         ErrorCode::boundary_conflict},
        {"no size",
         ring,
         {},
         {},
         target,
         {.at = {0, 2, 0}, .scale = 0.0},
         ErrorCode::invalid_argument},
    };
    for (const Bad& bad : cases) {
        CAPTURE(bad.what);
        const Error error = error_of(
            [&] { Paste(horn, bad.onto_mesh, bad.region, bad.feature, bad.onto, bad.placement); });
        CAPTURE(error.message());
        CHECK(error.code() == bad.code);
        CHECK(error.message().size() > 20);
        const bool of_elements =
            bad.code == ErrorCode::boundary_conflict || bad.code == ErrorCode::not_a_disk;
        CHECK(error.elements().ids.empty() != of_elements);
    }
    CHECK(hash(horn) == before[0]);
    CHECK(hash(target) == before[1]);
    CHECK(hash(other) == before[2]);
}

TEST_CASE("paste: rounds of nearest points are kept where they distort less, and maps have none") {
    const Mesh horn = horned_ball(), target = egg();
    Index rounds = 0;
    for (const Vec3& at : {Vec3(0, 2, 0), Vec3(1, 1.2, 0.8), Vec3(0, 0, 1.6)}) {
        PasteOptions by_map, by_points;
        by_map.loop = by_points.loop = PasteBoundary::mesh;
        by_map.correspondence = PasteCorrespondence::map;
        PasteMergeOptions plain;
        plain.compare = false;
        Paste map = horn_on_egg(horn, target, {.at = at, .angle = 0.3, .scale = 0.8}, by_map);
        Paste points = horn_on_egg(horn, target, {.at = at, .angle = 0.3, .scale = 0.8}, by_points);
        map.optimize();
        points.optimize();
        CHECK(map.search().closest_rounds == 0);
        const double from_map = map.merge(plain).report.near.energy;
        const double from_points = points.merge(plain).report.near.energy;
        if (points.search().closest_rounds == 0) {
            CHECK(from_points == from_map);
        } else {
            CHECK(from_points < from_map);
            CHECK(points.search().energy.back() < map.search().energy.back());
        }
        rounds += points.search().closest_rounds;
    }
    CHECK(rounds > 0);
}

TEST_CASE("paste: the size can be locked; nearest points and the thesis's way work too") {
    const Mesh horn = horned_ball(), target = egg();
    Paste paste = horn_on_egg(horn, target, {.at = {0, 2, 0}, .scale = 0.7});
    CHECK(paste.merge({.lock_scale = true}).report.scale == 0.7);
    PasteOptions closest;
    closest.correspondence = PasteCorrespondence::closest;
    Paste near = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.7}, closest);
    near.optimize();
    const std::vector<double>& misfit = near.search().misfit;
    CHECK(misfit.back() <= misfit.front());
    check_sound(near.merge());
    PasteOptions thesis;
    thesis.thesis = test::thesis();
    Paste literal = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.7}, thesis);
    literal.optimize();
    check_sound(literal.merge());
}

TEST_CASE("paste: a part that takes the place of its target, or is larger than asked, is told") {
    const Mesh horn = horned_ball(), ball = make_sphere({1.0, 24, SphereKind::triangles});
    const auto pasted_at = [&](double scale) {
        Paste paste = horn_on_egg(horn, ball, {.at = {0, 1, 0}, .scale = scale});
        return paste.merge();
    };
    const auto kept = [](const PasteResult& made) {
        return made.merged.report.joins[0].band.target_volume;
    };
    CHECK(kept(pasted_at(0.2)) > 0.97);
    CHECK(kept(pasted_at(0.4)) < kept(pasted_at(0.2)));
    const PasteResult most = pasted_at(2.0);
    CHECK(most.merged.mesh.topology().is_closed());
    CHECK(kept(most) < 0.5);
    CHECK_FALSE(most.merged.report.ok);
    CHECK(most.merged.report.verdict.find("takes the place of") != std::string::npos);
}

TEST_CASE("paste: meshes that are both inside out are judged as the same right side out") {
    Mesh horn = horned_ball(), target = egg();
    const auto band_of = [&] {
        Paste paste = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.8});
        const PasteResult result = paste.merge();
        CHECK(result.merged.report.ok);
        return result.merged.report.joins.at(0).band;
    };
    const BandQuality outward = band_of();
    flip(horn);
    flip(target);
    const BandQuality inward = band_of();
    CHECK(inward.source_volume == doctest::Approx(outward.source_volume).epsilon(0.05));
    CHECK(inward.roughness == doctest::Approx(outward.roughness).epsilon(0.05));
    CHECK(inward.max_bend == doctest::Approx(outward.max_bend).epsilon(0.1));
}

TEST_CASE("paste: of a part and a target that look to different sides the inverted one is told") {
    const auto warnings = [](bool turn_source, bool turn_target) {
        Mesh horn = horned_ball(), target = egg();
        if (turn_source) flip(horn);
        if (turn_target) flip(target);
        Paste paste = horn_on_egg(horn, target, {.at = {1, 1.2, 0.8}, .scale = 0.8});
        std::string all;
        for (const std::string& warning : paste.merge().merged.report.warnings) all += warning;
        return all;
    };
    const auto says = [](const std::string& text, const char* word) {
        return text.find(word) != std::string::npos;
    };
    CHECK_FALSE(says(warnings(false, false), "inside out"));
    CHECK_FALSE(says(warnings(true, true), "inside out"));
    const std::string target = warnings(false, true), source = warnings(true, false);
    CHECK(says(target, "the target is inside out"));
    CHECK(says(target, "flip"));
    CHECK(says(source, "the source is inside out"));
}
