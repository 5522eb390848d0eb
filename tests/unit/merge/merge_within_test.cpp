#include "kernel/merge/merge_within.h"

#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

// Two tubes of radius 1 around the y axis, from -1 to 1 and from 2 to 4.
Mesh tubes() {
    const Mesh tube = make_cylinder({.radius = 1.0, .segments = 12, .rings = 4, .caps = false});
    Mesh mesh = tube, other = tube;
    Affine map;
    map.translation = {0, 3, 0};
    transform(other, map);
    append(mesh, other);
    return mesh;
}

ErrorCode refusal_of(const Mesh& mesh, std::vector<Join> joins) {
    try {
        merge_within(mesh, joins);
    } catch (const Error& error) {
        return error.code();
    }
    FAIL("nothing was refused");
    return ErrorCode::internal;
}

}  // namespace

TEST_CASE("merge within: boundaries of one mesh are joined and their seams measured") {
    const Mesh mesh = tubes();
    const std::vector<Path> rims = boundaries(mesh);
    const Join joins[] = {{rims[2], rims[1]}};
    const MergeResult result = merge_within(mesh, joins);
    CHECK(result.report.ok);
    CHECK(result.report.joins.size() == 1);
    CHECK(result.report.seam.after.max_dihedral < 0.6);
    CHECK(result.report.intersections.empty());
    CHECK(result.seams.size() == 2);
    CHECK(result.mesh.face_count() == mesh.face_count() + 24);
    CHECK(result.mesh.topology().component_count() == 1);
    CHECK(result.provenance.faces.size() == result.mesh.face_count());
    CHECK(result.provenance.corners.size() == result.mesh.topology().corner_count());
    for (Index f = 0; f < result.mesh.face_count(); ++f) {
        const bool added = f >= mesh.face_count();
        CHECK((result.side_of_face[f] == SeamSide::source) == added);
        CHECK(result.provenance.faces.main_source(f) < mesh.face_count());
    }
    CHECK(std::equal(mesh.positions().begin(), mesh.positions().end(),
                     result.mesh.positions().begin()));
}

TEST_CASE("merge within: needles between boundaries of unlike counts are no fault of a bridge") {
    for (const auto& sides : {std::pair(8, 200), std::pair(200, 8), std::pair(12, 600)}) {
        const int few = sides.first, many = sides.second;
        CAPTURE(few);
        Mesh mesh = make_cylinder({.segments = few, .rings = 2, .caps = false});
        Mesh other = make_cylinder({.segments = many, .rings = 2, .caps = false});
        Affine map;
        map.translation = {0, 3, 0};
        transform(other, map);
        append(mesh, other);
        const std::vector<Path> rims = boundaries(mesh);
        const Join joins[] = {{rims[2], rims[1]}};
        const MergeResult result = merge_within(mesh, joins);
        CAPTURE(result.report.verdict);
        CHECK(result.report.ok);
        CHECK(result.report.seam.after.smallest_angle < 2.0 * kDegree);
    }
}

TEST_CASE("merge within: what cannot be joined is refused") {
    const Mesh mesh = tubes();
    const std::vector<Path> rims = boundaries(mesh);
    CHECK(refusal_of(mesh, {}) == ErrorCode::invalid_argument);
    CHECK(refusal_of(mesh, {{rims[0], rims[0]}}) == ErrorCode::boundary_conflict);
    CHECK(refusal_of(mesh, {{rims[0], rims[3]}, {rims[3], rims[1]}}) ==
          ErrorCode::boundary_conflict);
    CHECK(refusal_of(mesh, {{rims[2], rims[1], 1}}) == ErrorCode::invalid_argument);
    CHECK(refusal_of(mesh, {{boundaries(tubes())[0], rims[1]}}) == ErrorCode::topology_mismatch);
    const Path line(mesh.shared_topology(), {0, 1, 2}, false);
    CHECK(refusal_of(mesh, {{line, rims[1]}}) == ErrorCode::not_a_boundary);
}
