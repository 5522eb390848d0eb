#include "kernel/mesh/parameterize/uv_attribute.h"

#include "tests/unit/mesh/parameterize/parameterize_support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

TEST_CASE("a map is written to the corners of its faces, at the place of their vertices") {
    Mesh mesh = make_grid({.size = {2, 1}});
    const Parameterization map = laid_out(mesh, ParameterizeMethod::lscm);
    write_uv(mesh, map, "uv2", UvPlacement::as_is);
    const Attribute* uv = mesh.attributes().find("uv2");
    REQUIRE(uv != nullptr);
    CHECK(uv->domain == Domain::corner);
    require_complete_attributes(mesh);
    for (Index c = 0; c < mesh.topology().corner_count(); ++c) {
        const Index v = mesh.topology().faces().vertices[at(c)];
        CHECK(uv->at(c)[0] == map.uv[v].x());
        CHECK(uv->at(c)[1] == map.uv[v].y());
    }
}

TEST_CASE("in the unit square a map is as large as fits, in the middle") {
    Mesh mesh = bumpy_cap();
    write_uv(mesh, laid_out(mesh, ParameterizeMethod::arap));
    Vec2 low = Vec2::Constant(kInfinity), high = -low;
    const Attribute& uv = *mesh.attributes().find("uv");
    for (Index c = 0; c < uv.size(); ++c) {
        low = low.cwiseMin(Vec2(uv.at(c)[0], uv.at(c)[1]));
        high = high.cwiseMax(Vec2(uv.at(c)[0], uv.at(c)[1]));
    }
    CHECK((high - low).maxCoeff() == Approx(1.0));
    CHECK((low + high).isApprox(Vec2(1.0, 1.0)));
}

TEST_CASE("other corners keep their values, or those of their vertices, or have none") {
    const Mesh grid = make_grid({});
    const std::vector<Index> faces{0, 1, 10, 11};
    const Parameterization map = parameterize(grid, faces);
    Mesh bare = grid, at_corners = grid, at_vertices = grid;
    at_corners.attributes().add(
        {"uv", Domain::corner, 2, ScalarType::float64, std::vector<double>(800, 5.0)});
    at_vertices.attributes().add(
        {"uv", Domain::vertex, 2, ScalarType::float64, std::vector<double>(242, 6.0)});
    write_uv(bare, map);
    write_uv(at_corners, map);
    write_uv(at_vertices, map);
    for (Index f = 0; f < grid.face_count(); ++f) {
        const bool laid = std::find(faces.begin(), faces.end(), f) != faces.end();
        const double first = bare.attributes().find("uv")->at(4 * f)[0];
        CHECK(std::isnan(first) == !laid);
        CHECK((at_corners.attributes().find("uv")->at(4 * f)[0] == 5.0) == !laid);
        CHECK((at_vertices.attributes().find("uv")->at(4 * f)[0] == 6.0) == !laid);
    }
    CHECK(at_corners.attributes().find("uv")->type == ScalarType::float64);
}

TEST_CASE("attributes that hold something else, and maps of other meshes, are refused") {
    Mesh mesh = decorated(make_grid({}));
    const Parameterization map = laid_out(mesh, ParameterizeMethod::lscm);
    CHECK(error_of([&] { write_uv(mesh, map, "x"); }).code() == ErrorCode::invalid_argument);
    CHECK(error_of([&] { write_uv(mesh, map, ""); }).code() == ErrorCode::invalid_argument);
    CHECK(is_decorated(mesh));
    Mesh small = make_grid({.segments = {2, 2}});
    CHECK(error_of([&] { write_uv(small, map); }).code() == ErrorCode::topology_mismatch);
    Mesh box = make_box({.segments = {10, 10, 10}});
    const Mesh wide = make_grid({.segments = {11, 10}});
    CHECK(error_of([&] { write_uv(box, parameterize(wide, std::vector<Index>{99})); }).code() ==
          ErrorCode::topology_mismatch);
    CHECK(box.attributes().all().empty());
}
