// Surfaces that cannot be laid out, or only with care.

#include "kernel/mesh/fill/minimum_area.h"
#include "tests/unit/mesh/parameterize/parameterize_support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

Parameterization all_of(const Mesh& mesh, const ParameterizeOptions& options = {}) {
    return parameterize(mesh, Region::all(mesh.shared_topology()), options);
}

// A ring around a tall thin spike that leans over the ring, which is not part of it.
Mesh ring_around_spike() {
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {40, 40}});
    for (Vec3& p : mesh.edit_positions()) {
        const double r = std::hypot(p.x(), p.z());
        const double height = 1.2 * std::exp(-20.0 * r * r);
        p += Vec3(0.5 * height, height, 0.0);
    }
    return mesh;
}

}  // namespace

TEST_CASE("closed surfaces, handles, parts and corners are refused with what to do") {
    const Error closed = error_of([] { all_of(make_sphere({})); });
    CHECK(closed.code() == ErrorCode::not_a_disk);
    CHECK(closed.message().find("is closed") != std::string::npos);

    const Mesh torus = make_torus({});
    const Region pierced = Region(torus.shared_topology(), {100}).grown(2).inverted();
    const Error handle = error_of([&] { parameterize(torus, pierced); });
    CHECK(handle.code() == ErrorCode::not_a_disk);
    CHECK(handle.message().find("1 handle") != std::string::npos);

    const Mesh grid = make_grid({});
    const Region corners = select_box(grid, {Vec3(-1, -1, -1), Vec3(-0.2, 1, 1)})
                               .united(select_box(grid, {Vec3(0.2, -1, -1), Vec3(1, 1, 1)}));
    const Error parts = error_of([&] { parameterize(grid, corners); });
    CHECK(parts.code() == ErrorCode::not_a_disk);
    CHECK(parts.message().find("2 parts") != std::string::npos);
    CHECK(parts.elements().kind == ElementKind::vertex);
    CHECK(parts.elements().count == 2);

    // Two quads of the grid that meet at vertex 12.
    const Error bow_tie = error_of([&] { parameterize(grid, std::vector<Index>{0, 11}); });
    CHECK(bow_tie.code() == ErrorCode::nonmanifold_vertex);
    CHECK(bow_tie.elements().ids == std::vector<Index>{12});
}

TEST_CASE("regions without faces and of other meshes are refused") {
    const Mesh grid = make_grid({});
    CHECK(error_of([&] {
              parameterize(grid, Region(grid.shared_topology(), {1, 2}));
          }).code() == ErrorCode::region_empty);
    CHECK(error_of([&] {
              parameterize(grid, Region::all(make_grid({}).shared_topology()));
          }).code() == ErrorCode::topology_mismatch);
    CHECK(error_of([&] {
              parameterize(grid, std::vector<Index>{7, 100});
          }).code() == ErrorCode::out_of_range);
}

TEST_CASE("fewer iterations than none are refused") {
    ParameterizeOptions options;
    options.maximum_iterations = -1;
    CHECK(error_of([&] { all_of(make_grid({}), options); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("a map onto a disk needs holes to be closed") {
    ParameterizeOptions options{.method = ParameterizeMethod::tutte};
    options.close_holes = false;
    const Error error = error_of([&] { all_of(grid_with_holes(), options); });
    CHECK(error.code() == ErrorCode::not_a_disk);
    CHECK(error.elements().count == 2);
}

TEST_CASE("a cancel is heard") {
    const Mesh mesh = bumpy_cap();
    const Context context;
    context.cancel();
    CHECK(error_of([&] {
              parameterize(mesh, Region::all(mesh.shared_topology()), {}, context);
          }).code() == ErrorCode::cancelled);
}

TEST_CASE("triangles of the caller close holes, and must fit") {
    const Mesh mesh = grid_with_holes();
    const Region all = Region::all(mesh.shared_topology());
    const Parameterization closed = parameterize(mesh, all);
    ParameterizeOptions options;
    options.close_holes = false;
    for (const auto& [a, b, c] : closed.fill_triangles()) {
        options.fill.push_back({closed.vertex[a], closed.vertex[b], closed.vertex[c]});
    }
    const Parameterization given = parameterize(mesh, all, options);
    CHECK(given.uv == closed.uv);
    CHECK(given.fill_triangles().size() == closed.fill_triangles().size());

    for (Triangle& t : options.fill) std::swap(t[0], t[1]);
    CHECK(error_of([&] { parameterize(mesh, all, options); }).code() ==
          ErrorCode::nonmanifold_edge);
    options.fill = {{0, 1, 100000}};
    CHECK(error_of([&] { parameterize(mesh, all, options); }).code() == ErrorCode::out_of_range);
    const Region part = select_box(mesh, {Vec3(-1, -1, -1), Vec3(0, 1, -0.7)});
    options.fill = {{0, 1, mesh.vertex_count() - 1}};
    CHECK(error_of([&] { parameterize(mesh, part, options); }).code() ==
          ErrorCode::invalid_argument);
}

TEST_CASE("a ring that is closed by triangles lies one to one in the plane") {
    const Mesh mesh = ring_around_spike();
    std::vector<Index> vertices;
    const Mesh flat = make_grid({.size = {2, 2}, .segments = {40, 40}});
    for (Index v = 0; v < flat.vertex_count(); ++v) {
        const double r = std::hypot(flat.position(v).x(), flat.position(v).z());
        if (r > 0.15 && r < 0.9) vertices.push_back(v);
    }
    const Region ring(mesh.shared_topology(), vertices);
    for (const ParameterizeMethod method : {ParameterizeMethod::lscm, ParameterizeMethod::arap}) {
        ParameterizeOptions options{.method = method};
        const Parameterization closed = parameterize(mesh, ring, options);
        CHECK(closed.method == method);
        CHECK(closed.loops.size() == 2);
        CHECK(closed.flipped.empty());
        CHECK(closed.flipped_fill == 0);
        CHECK(closed.boundary_crossings == 0);
        options.close_holes = false;
        CHECK(parameterize(mesh, ring, options).boundary_crossings > 0);
    }
}

TEST_CASE("faces without an area do no harm") {
    Mesh mesh = make_grid({.size = {2, 2}, .segments = {12, 12}});
    const Index v = 6 * 13 + 6;
    mesh.set_position(v, mesh.position(v + 1));
    mesh.set_position(v + 29, mesh.position(v + 43));
    for (const ParameterizeMethod method :
         {ParameterizeMethod::lscm, ParameterizeMethod::arap, ParameterizeMethod::tutte}) {
        const Parameterization map = all_of(mesh, {.method = method});
        CHECK(!map.degenerate.empty());
        for (const Vec2& p : map.uv) CHECK(p.allFinite());
        for (const Index f : map.flipped) {
            CHECK(std::binary_search(map.degenerate.begin(), map.degenerate.end(), f));
        }
        if (method == ParameterizeMethod::tutte) continue;
        CHECK(map.min_scale == Approx(1.0).epsilon(0.01));
        CHECK(map.max_scale == Approx(1.0).epsilon(0.01));
    }
}

TEST_CASE("faces that are all one point or one line give finite maps or an error") {
    Mesh mesh = make_grid({.segments = {3, 3}});
    for (Vec3& p : mesh.edit_positions()) p = Vec3(p.x(), 0, 0);
    for (const Vec2& p : all_of(mesh).uv) CHECK(p.allFinite());
    for (Vec3& p : mesh.edit_positions()) p = Vec3(1, 2, 3);
    CHECK(error_of([&] { all_of(mesh); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("halves of real models: no flips onto a disk, and arap never worse than what it began") {
    Index disks = 0;
    for (const char* name : {"bunny_3k.off", "camelhead.off", "lion.off", "hemisphere.off"}) {
        const auto mesh = load_off(name);
        if (!mesh) return;
        const Box box = bounds(*mesh);
        for (const int axis : {0, 1, 2}) {
            const Vec3 along = (box.max - box.min)[axis] * Vec3::Unit(axis);
            const Region half = select_plane(*mesh, box.center() + 0.2 * along, along);
            const Parameterization disk =
                parameterize(*mesh, half, {.method = ParameterizeMethod::tutte});
            CHECK(disk.flipped.empty());
            CHECK(disk.boundary_crossings == 0);
            const Parameterization conformal =
                parameterize(*mesh, half, {.method = ParameterizeMethod::lscm});
            const Parameterization rigid = parameterize(*mesh, half);
            CHECK(conformal.flipped.empty());
            CHECK(rigid.flipped.empty());
            CHECK(rigid.boundary_crossings <= conformal.boundary_crossings);
            CHECK(rigid.energy.back() <= rigid.energy.front());
            ++disks;
        }
    }
    CHECK(disks == 12);
}
