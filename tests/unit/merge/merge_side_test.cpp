#include "kernel/merge/merge_side.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "tests/unit/shapes.h"

using namespace lissom;
using namespace lissom::test;

namespace {

ErrorCode code_of(const Mesh& mesh, const std::vector<Path>& paths) {
    try {
        make_side(mesh, paths, "source");
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

// Positions of a side follow from its map and the mesh that was given.
void check_map(const MergeSide& side, const Mesh& given) {
    REQUIRE(side.map.vertices.size() == side.mesh.vertex_count());
    REQUIRE(side.map.corners.size() == side.mesh.topology().corner_count());
    REQUIRE(side.map.faces.size() == side.mesh.face_count());
    const std::vector<Vec3> expected = blend_positions(given, side.map.vertices);
    for (Index v = 0; v < side.mesh.vertex_count(); ++v) {
        CHECK((side.mesh.position(v) - expected[v]).norm() < 1e-12);
    }
    // A corner comes from corners at the vertices that its vertex comes from.
    const auto& from = given.topology().faces().vertices;
    for (Index c = 0; c < side.mesh.topology().corner_count(); ++c) {
        Vec3 at = Vec3::Zero();
        for (const auto& [corner, weight] : side.map.corners[c]) {
            at += weight * given.position(from[corner]);
        }
        CHECK((at - side.mesh.position(side.mesh.topology().faces().vertices[c])).norm() < 1e-12);
    }
}

}  // namespace

TEST_CASE("what is not an open boundary is refused, and so is one given twice") {
    const Mesh mesh = round_tube(20, 4);
    const std::vector<Path> both = boundaries(mesh);
    CHECK(make_side(mesh, both, "source").loops.size() == 2);
    CHECK(make_side(mesh, {both[0].reversed()}, "source").loops[0] ==
          make_side(mesh, {both[0]}, "source").loops[0]);
    CHECK(code_of(mesh, {both[0], both[0].reversed()}) == ErrorCode::boundary_conflict);
    CHECK(code_of(mesh, {Path(mesh.shared_topology(), {20, 21, 22}, true)}) ==
          ErrorCode::not_a_boundary);
    CHECK(code_of(mesh, {Path(mesh.shared_topology(), {0, 1, 2}, false)}) ==
          ErrorCode::not_a_boundary);
    CHECK(code_of(mesh, {Path({Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, true)}) ==
          ErrorCode::not_a_boundary);
    const Mesh other = round_tube(20, 4);
    CHECK(code_of(other, {both[0]}) == ErrorCode::topology_mismatch);
}

TEST_CASE("a boundary that crosses itself is refused") {
    const Mesh mesh = tube(40, 3, [](double angle, double height) {
        return Vec3(std::sin(angle), std::sin(2.0 * angle + 0.05), 3.0 * height);
    });
    CHECK(code_of(mesh, {boundaries(mesh)[0]}) == ErrorCode::boundary_conflict);
}

TEST_CASE("a boundary is refused wherever it meets itself, and only there, however it lies") {
    // Corners of polygons with long and short edges; the loop begins at any of them.
    const std::vector<Vec3> crossing{{0, 0, 0},    {9, 0, 0},  {9, 3, 0}, {4, 3, 0},
                                     {4.3, -1, 0}, {3, -1, 0}, {3, 3, 0}, {0, 3, 0}};
    const std::vector<Vec3> lying{{0, 0, 0}, {9, 0, 0}, {9, 3, 0}, {6, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    const std::vector<Vec3> near{{0, 0, 0},   {9, 0, 0},   {9, 3, 0},
                                 {6, 0.1, 0}, {2, 0.1, 0}, {0, 3, 0}};
    const auto refused = [](const std::vector<Vec3>& corners, std::size_t begin,
                            const Affine& map) {
        const std::size_t n = corners.size();
        const Mesh mesh = tube(count_of(corners), 3, [&](double angle, double height) {
            const auto k = static_cast<std::size_t>(std::lround(angle / (2.0 * kPi) * double(n)));
            return map(corners[(k + begin) % n] + 5.0 * height * Vec3::UnitZ());
        });
        return code_of(mesh, {boundaries(mesh)[0]}) == ErrorCode::boundary_conflict;
    };
    for (const double angle : {0.0, 0.7, 1.4, 2.5}) {
        for (const double size : {0.01, 1.0, 100.0}) {
            const Affine map = scaling(Vec3::Constant(size), Vec3::Zero()) *
                               rotation(Vec3(1, 2, -1), angle, Vec3::Zero()) *
                               translation(Vec3(30, -20, 10));
            for (std::size_t begin = 0; begin < crossing.size(); ++begin) {
                CHECK(refused(crossing, begin, map));
                CHECK(refused(lying, begin, map));
                CHECK(!refused(near, begin, map));
            }
        }
    }
}

TEST_CASE("a boundary is trimmed where it turns by more than is allowed beyond a regular polygon") {
    for (const Index count : {24, 48}) {
        const Mesh mesh = tube(count, 12, [=](double angle, double height) {
            const bool tooth = std::lround(angle * count / (2.0 * kPi)) % 2 == 1;
            const double low = tooth && height == 0.0 ? 0.08 : 0.0;
            return Vec3(std::cos(angle), std::sin(angle), 3.0 * height + low);
        });
        const Path jagged = boundaries(mesh)[0];
        const auto trimmed = [&](double factor) {
            MergeSide side = make_side(mesh, {jagged}, "source");
            const double beyond = side.turns[0] - 2.0 * kPi / count;
            REQUIRE(beyond > 0.1);
            trim_jagged(side, factor * beyond, {});
            CHECK(side.untrimmed.empty());
            return side.trimmed[0] != 0;
        };
        CHECK(trimmed(0.97));
        CHECK(!trimmed(1.03));
    }
}

TEST_CASE("a mesh that is inside out is turned over") {
    const Mesh outward = round_tube(24, 6);
    Mesh inward = outward;
    flip(inward);
    MergeSide side = make_side(inward, {boundaries(inward)[0]}, "source");
    orient(side, {});
    CHECK(side.flipped);
    CHECK(volume(side.mesh) == doctest::Approx(volume(outward)));
    check_map(side, inward);
    const auto& loops = side.mesh.topology().boundary_loops();
    CHECK(std::is_permutation(side.loops[0].begin(), side.loops[0].end(), loops[0].begin(),
                              loops[0].end()));
    MergeSide same = make_side(outward, {boundaries(outward)[0]}, "source");
    orient(same, {});
    CHECK(!same.flipped);
}

TEST_CASE("a mesh that is inside out is turned over however slender it is") {
    for (const double width : {0.3, 0.03, 0.0005}) {
        CAPTURE(width);
        const Mesh outward = tube(24, 6, [&](double angle, double height) {
            return Vec3(width * std::cos(angle), width * std::sin(angle), height);
        });
        Mesh inward = outward;
        flip(inward);
        for (const bool turned : {false, true}) {
            const Mesh& mesh = turned ? inward : outward;
            MergeSide side = make_side(mesh, {boundaries(mesh)[0]}, "source");
            orient(side, {});
            CHECK(side.flipped == turned);
            CHECK(volume(side.mesh) == doctest::Approx(volume(outward)));
        }
    }
}

TEST_CASE("refinement at a loop: one level there, whole faces elsewhere, the same surface") {
    const Mesh mesh = round_tube(12, 9);
    const std::vector<Path> both = boundaries(mesh);
    MergeSide side = make_side(mesh, both, "source");
    refine_loop(side, 0, {});
    check_map(side, mesh);
    CHECK(side.loops[0].size() == 24);
    CHECK(side.loops[1].size() == 12);
    CHECK(area(side.mesh) == doctest::Approx(area(mesh)));
    CHECK(euler_characteristic(side.mesh.topology()) == 0);
    CHECK(side.mesh.face_count() < 2 * mesh.face_count());
    CHECK(kept_vertices(side.map.vertices, mesh.vertex_count())[17] == 17);
    const Region top(mesh.shared_topology(), both[1].vertices());
    CHECK(side.carried(top).size() == 12);
}
