// Features that are removed from generated shapes.
#include "kernel/merge/paste/erase/erase_feature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "kernel/mesh/measure/measures.h"
#include "tests/unit/merge/paste/paste_shapes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

bool outside(const ErasedFeature& erased, Index v) {
    return erased.map.vertices.main_source(v) != kNoIndex;
}

// What is farthest from the unit sphere, of the vertices that are new or old.
double max_offset(const ErasedFeature& erased, bool old) {
    double most = 0.0;
    for (Index v = 0; v < erased.mesh.vertex_count(); ++v) {
        if (outside(erased, v) != old) continue;
        most = std::max(most, std::abs(erased.mesh.position(v).norm() - 1.0));
    }
    return most;
}

// Texture coordinates that are the positions, in corners, and a color in vertices.
void add_values(Mesh& mesh) {
    const Topology& topology = mesh.topology();
    Attribute uv{"uv", Domain::corner, 2, ScalarType::float64, {}};
    for (Index f = 0; f < mesh.face_count(); ++f) {
        for (const Index v : topology.face(f)) {
            uv.values.push_back(mesh.position(v).x());
            uv.values.push_back(mesh.position(v).z());
        }
    }
    Attribute color{"color", Domain::vertex, 3, ScalarType::float64, {}};
    for (const Vec3& p : mesh.positions()) {
        color.values.insert(color.values.end(), {0.5 + 0.2 * p.x(), 0.5, 0.5 + 0.2 * p.z()});
    }
    mesh.attributes().add(std::move(uv));
    mesh.attributes().add(std::move(color));
    FaceLabels labels;
    labels.of_face.assign(at(mesh.face_count()), labels.add("skin"));
    mesh.attributes().labels()["material"] = std::move(labels);
}

}  // namespace

TEST_CASE("erase: a horn goes, and the ball is round where it was") {
    Mesh ball = horned_ball();
    const std::uint64_t before = hash(ball);
    const ErasedFeature erased = erase_feature(ball, around_horn(ball, 0.75));
    CHECK(hash(ball) == before);
    CHECK(erased.mesh.topology().is_closed());
    CHECK(euler_characteristic(erased.mesh.topology()) == 2);
    CHECK(erased.report.removed_faces > 100);
    CHECK(erased.report.patch.vertex_count > 20);
    CHECK(max_offset(erased, false) < 0.03);
}

TEST_CASE("erase: a patch continues the curvature around it where that is even") {
    const Mesh ball = make_sphere({1.0, 24, SphereKind::triangles});
    const Region cap = select_sphere(ball, {0, 1, 0}, 0.9);
    EraseOptions plate;
    plate.continuity = FairContinuity::tangents;
    const ErasedFeature round = erase_feature(ball, cap), flat = erase_feature(ball, cap, plate);
    CHECK(round.report.continuity == FairContinuity::curvature);
    CHECK(flat.report.continuity == FairContinuity::tangents);
    CHECK(max_offset(round, false) < 0.03);
    CHECK(max_offset(round, false) < 0.5 * max_offset(flat, false));
    CHECK(round.report.max_dihedral < flat.report.max_dihedral);
    // Around a horn it is not.
    const Mesh horn = horned_ball();
    CHECK(erase_feature(horn, around_horn(horn, 0.6)).report.continuity ==
          FairContinuity::tangents);
}

TEST_CASE("erase: on a coarse column the patch is a dome, and says how much it turns") {
    const Mesh column = make_cylinder({.radius = 1.0, .height = 6.0, .segments = 14, .rings = 8});
    const Region top = select_plane(column, {0, 1, 0}, {0, 1, 0});
    const ErasedFeature erased = erase_feature(column, top);
    double rim = 0.0, highest = 0.0;
    for (Index v = 0; v < erased.report.patch.first_vertex; ++v) {
        rim = std::max(rim, erased.mesh.position(v).y());
    }
    for (Index v = erased.report.patch.first_vertex; v < erased.mesh.vertex_count(); ++v) {
        const Vec3& p = erased.mesh.position(v);
        highest = std::max(highest, p.y());
        CHECK(std::hypot(p.x(), p.z()) < 1.0);
    }
    CHECK(highest - rim > 0.7);
    CHECK(highest - rim < 1.1);
    // A lid would turn by 90 degrees; a ball as coarse as the column by 26.
    CHECK(erased.report.max_dihedral < 35.0 * kDegree);
    CHECK(erased.report.max_around == doctest::Approx(2.0 * kPi / 14.0));
    CHECK(erased.report.ok == (erased.report.max_dihedral <= 30.0 * kDegree));
    CHECK(erased.report.density > 1.0);
    CHECK(erased.mesh.topology().is_closed());
}

TEST_CASE("erase: a patch that stays steep is told") {
    // Without new vertices it is a lid.
    const Mesh column = make_cylinder({.radius = 1.0, .height = 6.0, .segments = 32, .rings = 24});
    EraseOptions lid;
    lid.maximum_vertices = 0;
    const EraseReport flat =
        erase_feature(column, select_plane(column, {0, 1, 0}, {0, 1, 0}), lid).report;
    CHECK(!flat.ok);
    CHECK(flat.max_dihedral > 70.0 * kDegree);
    CHECK(flat.verdict.starts_with("not good: the patch turns by "));
    CHECK(erase_feature(column, select_plane(column, {0, 1, 0}, {0, 1, 0})).report.ok);
    // Where the surface is even all is well.
    const Mesh ball = horned_ball();
    const EraseReport round = erase_feature(ball, around_horn(ball, 0.75)).report;
    CHECK(round.ok);
    CHECK(round.density == 1.0);
    CHECK(round.verdict.starts_with("good: the patch turns by at most "));
}

TEST_CASE("erase: what lies outside the cut stays to the bit, with all its values") {
    Mesh ball = horned_ball();
    add_values(ball);
    const ErasedFeature erased = erase_feature(ball, around_horn(ball, 0.75));
    Index last = kNoIndex, kept = 0;
    for (Index v = 0; v < erased.mesh.vertex_count(); ++v) {
        if (!outside(erased, v)) continue;
        const Index from = erased.map.vertices.main_source(v);
        CHECK(from > last);
        last = from;
        ++kept;
        CHECK(erased.mesh.position(v) == ball.position(from));
        const auto a = erased.mesh.attributes().find("color")->at(v);
        const auto b = ball.attributes().find("color")->at(from);
        CHECK(std::equal(a.begin(), a.end(), b.begin()));
    }
    CHECK(kept == ball.vertex_count() - erased.report.removed_vertices);
    for (Index f = 0; f < erased.report.patch.first_face; ++f) {
        const Index from = erased.map.faces.main_source(f);
        for (std::size_t k = 0; k < erased.mesh.topology().face(f).size(); ++k) {
            const Index corner = erased.mesh.topology().first_corner(f) + index_of(k);
            const auto a = erased.mesh.attributes().find("uv")->at(corner);
            const auto b =
                ball.attributes().find("uv")->at(ball.topology().first_corner(from) + index_of(k));
            CHECK(std::equal(a.begin(), a.end(), b.begin()));
        }
    }
}

TEST_CASE("erase: labels, colors and texture coordinates go on over the patch") {
    Mesh ball = horned_ball();
    add_values(ball);
    const ErasedFeature erased = erase_feature(ball, around_horn(ball, 0.75));
    const Mesh& mesh = erased.mesh;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (outside(erased, v)) continue;
        const auto color = mesh.attributes().find("color")->at(v);
        CHECK(color[0] == doctest::Approx(0.5 + 0.2 * mesh.position(v).x()).epsilon(0.05));
        CHECK(color[1] == doctest::Approx(0.5));
    }
    for (Index f = erased.report.patch.first_face; f < mesh.face_count(); ++f) {
        CHECK(mesh.attributes().labels().at("material").of_face[at(f)] == 0);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto uv =
                mesh.attributes().find("uv")->at(mesh.topology().first_corner(f) + index_of(k));
            const Vec3& p = mesh.position(mesh.topology().face(f)[k]);
            CHECK(std::abs(uv[0] - p.x()) < 0.05);
            CHECK(std::abs(uv[1] - p.z()) < 0.05);
        }
    }
}

TEST_CASE("erase: values on one side of a seam go on where the rim crosses it") {
    Mesh ball = horned_ball();
    add_values(ball);
    Attribute& uv = *ball.attributes().find("uv");
    for (Index f = 0; f < ball.face_count(); ++f) {
        double middle = 0.0;
        for (const Index v : ball.topology().face(f)) middle += ball.position(v).x();
        if (middle > 0.3) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            uv.at(ball.topology().first_corner(f) + index_of(k))[0] += 100.0;
        }
    }
    const ErasedFeature erased = erase_feature(ball, around_horn(ball, 0.75));
    for (Index f = erased.report.patch.first_face; f < erased.mesh.face_count(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto value = erased.mesh.attributes().find("uv")->at(
                erased.mesh.topology().first_corner(f) + index_of(k));
            CHECK((value[0] > 99.0 || value[0] < 1.5));
        }
    }
}

TEST_CASE("erase: a handle goes with its feature") {
    Mesh torus = make_torus();
    const Region most = select_sphere(torus, {1.35, 0, 0}, 0.45).inverted();
    CHECK(genus(torus.topology()) == 1);
    const ErasedFeature erased = erase_feature(torus, most);
    CHECK(erased.mesh.topology().is_closed());
    CHECK(genus(erased.mesh.topology()) == 0);
}

TEST_CASE("erase: the cut runs where the surface is even") {
    const Mesh ball = horned_ball(40);
    const Region tip = around_horn(ball, 0.6);
    EraseOptions shortest;
    shortest.bend = 0.0;
    const auto offset = [&](const ErasedFeature& erased) {
        double sum = 0.0;
        for (const Vec3& p : erased.loop.points(ball)) {
            sum += std::abs(p.norm() - 1.0) / erased.loop.size();
        }
        return sum;
    };
    EraseOptions wide;
    wide.ring = shortest.ring = 2.0;
    CHECK(offset(erase_feature(ball, tip, wide)) <
          0.5 * offset(erase_feature(ball, tip, shortest)));
}

TEST_CASE("erase: what cannot be erased is refused, with vertices") {
    const Mesh ball = horned_ball();
    const Error all = error_of([&] { erase_feature(ball, Region::all(ball.shared_topology())); });
    CHECK(all.code() == ErrorCode::region_empty);
    const Error none = error_of([&] { erase_feature(ball, Region::none(ball.shared_topology())); });
    CHECK(none.code() == ErrorCode::region_empty);
    const Error other = error_of([&] {
        const Mesh second = horned_ball();
        erase_feature(ball, Region::all(second.shared_topology()));
    });
    CHECK(other.code() == ErrorCode::topology_mismatch);
    const Mesh torus = make_torus();
    const Error band = error_of([&] {
        erase_feature(torus, select_box(torus, {{-0.3, -9, -9}, {0.3, 9, 0}}));
    });
    CHECK(band.code() == ErrorCode::not_a_disk);
    CHECK(!band.elements().ids.empty());
    const Mesh grid = make_grid({.size = {2, 2}, .segments = {10, 10}});
    const Error border = error_of([&] {
        erase_feature(grid, select_box(grid, {{-1.1, -9, -0.5}, {0.2, 9, 0.5}}));
    });
    CHECK(
        (border.code() == ErrorCode::boundary_conflict || border.code() == ErrorCode::not_a_disk));
    EraseOptions bad;
    bad.ring = -1.0;
    CHECK(error_of([&] { erase_feature(ball, around_horn(ball), bad); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("paste: features of the target are removed first where that is asked for") {
    const Mesh horn = horned_ball();
    Mesh target = egg();
    for (Vec3& p : target.edit_positions()) {
        if (p.y() > 0.0) p.y() += 0.8 * std::exp(-14.0 * (p.x() * p.x() + p.z() * p.z()));
    }
    const PastePlacement placement{.at = {0, 2.4, 0}, .scale = 0.7};
    PasteOptions options;
    options.cleared = select_sphere(target, {0, 2.4, 0}, 0.9);
    Paste paste(horn, target, around_horn(horn), std::nullopt, std::nullopt, placement, options);
    paste.optimize();
    const PasteResult result = paste.merge();
    CHECK(result.merged.mesh.topology().is_closed());
    CHECK(result.report.euler_characteristic == result.report.expected_characteristic);
    // The same as on an egg that never had a horn, but for how it was filled.
    Paste plain(horn, egg(), around_horn(horn), std::nullopt, std::nullopt,
                {.at = {0, 2, 0}, .scale = 0.7});
    plain.optimize();
    const double most[] = {bounds(result.merged.mesh).max.y(),
                           bounds(plain.merge().merged.mesh).max.y()};
    CHECK(most[0] == doctest::Approx(most[1]).epsilon(0.05));
    for (Index v = 0; v < result.merged.mesh.vertex_count(); ++v) {
        for (const ElementMap::Source& s : result.merged.provenance.vertices[v]) {
            CHECK(s.element < target.vertex_count() + horn.vertex_count());
        }
    }
    // Elsewhere, and what cannot be cleared leaves it where it was.
    options.cleared.reset();
    options.clear = true;
    Paste under(horn, target, around_horn(horn), std::nullopt, std::nullopt,
                {.at = {0, 2.8, 0}, .scale = 1.2}, options);
    under.optimize();
    CHECK(under.merge().merged.mesh.topology().is_closed());
    under.move({.at = {1.3, 0, 0}, .scale = 0.7});
    CHECK(under.merge().merged.mesh.topology().is_closed());
    const std::vector<Index> loop = under.loop().vertices();
    error_of([&] { under.move({.at = {0, 2, 0}, .scale = 50.0}); });
    CHECK(under.loop().vertices() == loop);
    CHECK(under.merge().merged.mesh.topology().is_closed());
}

namespace {

double distance_to_line(const Vec3& point, std::span<const Vec3> line) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < line.size(); ++k) {
        const Vec3 from = line[k], along = line[(k + 1) % line.size()] - from;
        const double square = along.squaredNorm();
        const double part =
            square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, (from + part * along - point).norm());
    }
    return least;
}

// How far the seam of a paste runs from the boundary that was told before, at most.
double seam_off_boundary(const Paste& paste, const MergeResult& merged) {
    const std::vector<Vec3> line = paste.image().points();
    double greatest = 0.0;
    for (const Index v : merged.seams[0]) {
        greatest = std::max(greatest, distance_to_line(merged.mesh.position(v), line));
    }
    return greatest;
}

}  // namespace

TEST_CASE("paste: a cleared target is opened along the boundary that was told, at random places") {
    const Mesh horn = horned_ball(16);
    Mesh target = egg(24);
    for (Vec3& p : target.edit_positions()) {
        p += 0.25 * std::sin(6.0 * p.x()) * std::sin(5.0 * p.y()) * std::sin(7.0 * p.z()) *
             p.normalized();
    }
    PasteOptions options;
    options.clear = true;
    Index cleared = 0;
    for (int place = 0; place < 10; ++place) {
        const double angle = 0.7 * place, height = 1.6 - 0.32 * place;
        const PastePlacement placement{.at = {1.5 * std::cos(angle), height, 1.5 * std::sin(angle)},
                                       .scale = 0.5 + 0.05 * (place % 4)};
        CAPTURE(place);
        Paste paste(horn, target, around_horn(horn), std::nullopt, std::nullopt, placement,
                    options);
        paste.optimize(5);
        if (!paste.clearing()) continue;
        ++cleared;
        const PasteResult result = paste.merge();
        CHECK_FALSE(result.report.kept_outline);
        REQUIRE(result.report.clearing);
        CHECK(result.report.clearing->faces == paste.clearing()->faces);
        CHECK(seam_off_boundary(paste, result.merged) < 0.12 * placement.scale);
    }
    CHECK(cleared > 5);
}
