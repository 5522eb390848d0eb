#include "kernel/mesh/parameterize/parameterize.h"

#include <cmath>
#include <numeric>

#include "kernel/mesh/parameterize/uv_attribute.h"
#include "tests/unit/mesh/parameterize/parameterize_support.h"

using namespace lissom;
using namespace lissom::test;
using doctest::Approx;

namespace {

constexpr ParameterizeMethod kMethods[] = {ParameterizeMethod::lscm, ParameterizeMethod::arap,
                                           ParameterizeMethod::tutte};

// The xz plane seen from +y.
std::vector<Vec2> seen_from_above(const Mesh& mesh, const Parameterization& map) {
    std::vector<Vec2> points;
    for (const Index v : map.vertex) {
        points.emplace_back(mesh.position(v).z(), mesh.position(v).x());
    }
    return points;
}

void check_one_to_one(const Parameterization& map) {
    CHECK(map.flipped.empty());
    CHECK(map.flipped_fill == 0);
    CHECK(map.boundary_crossings == 0);
}

}  // namespace

TEST_CASE("a flat region is laid out as it is: up to scale by lscm, exactly by arap") {
    for (const Mesh& mesh : {make_grid({}), uneven_grid(), grid_with_holes()}) {
        for (const bool close_holes : {true, false}) {
            const Parameterization conformal =
                laid_out(mesh, ParameterizeMethod::lscm, close_holes);
            CHECK(deviation(conformal.uv, seen_from_above(mesh, conformal), false) < 1e-7);
            const Parameterization rigid = laid_out(mesh, ParameterizeMethod::arap, close_holes);
            CHECK(rigid.method == ParameterizeMethod::arap);
            CHECK(deviation(rigid.uv, seen_from_above(mesh, rigid), true) < 1e-7);
            CHECK(rigid.min_scale == Approx(1.0).epsilon(1e-6));
            CHECK(rigid.max_scale == Approx(1.0).epsilon(1e-6));
            check_one_to_one(rigid);
        }
    }
}

TEST_CASE("the map depends neither on the place of the mesh, nor on its rotation or scale") {
    const Mesh mesh = bumpy_cap();
    Random random(3);
    for (const ParameterizeMethod method : kMethods) {
        const Parameterization map = laid_out(mesh, method);
        for (const double scale : {1e-3, 1.0, 1e4}) {
            const Parameterization other = laid_out(moved(mesh, similarity(random, scale)), method);
            REQUIRE(other.uv.size() == map.uv.size());
            for (std::size_t i = 0; i < map.uv.size(); ++i) {
                CHECK((other.uv[i] / scale - map.uv[i]).norm() < 1e-7);
            }
            CHECK(other.max_scale == Approx(map.max_scale).epsilon(1e-6));
            CHECK(other.iterations == map.iterations);
        }
    }
}

TEST_CASE("a mesh far from the origin is laid out as near it") {
    const Mesh mesh = bumpy_cap();
    const Mesh far = moved(mesh, translation(Vec3(1e6, -2e6, 1e6)));
    for (const ParameterizeMethod method : kMethods) {
        const Parameterization map = laid_out(mesh, method), other = laid_out(far, method);
        for (std::size_t i = 0; i < map.uv.size(); ++i) {
            CHECK((other.uv[i] - map.uv[i]).norm() < 1e-5);
        }
    }
}

TEST_CASE("a cap of a sphere is laid out by the stereographic projection") {
    const Mesh sphere = make_sphere({.segments = 30, .kind = SphereKind::triangles});
    const Mesh cap = extract(sphere, select_plane(sphere, {0, 0.3, 0}, {0, 1, 0})).mesh;
    const Parameterization map = laid_out(cap, ParameterizeMethod::lscm);
    std::vector<Vec2> wanted;
    for (const Index v : map.vertex) {
        const Vec3& p = cap.position(v);
        wanted.emplace_back(p.z() / (1.0 + p.y()), p.x() / (1.0 + p.y()));
    }
    CHECK(deviation(map.uv, wanted, false) < 0.03);
}

TEST_CASE("lscm keeps the angles of a surface that is ten times as dense on one side") {
    Mesh sphere = make_sphere({.segments = 40, .kind = SphereKind::triangles});
    for (Vec3& p : sphere.edit_positions()) p = (p + Vec3(0.8, 0, 0)).normalized();
    const Mesh cap = extract(sphere, select_plane(sphere, {0, 0.3, 0}, {0, 1, 0})).mesh;
    const Parameterization map = laid_out(cap, ParameterizeMethod::lscm);
    check_one_to_one(map);
    for (const auto& [a, b, c] : map.surface_triangles()) {
        const Vec3 p = cap.position(map.vertex[b]) - cap.position(map.vertex[a]);
        const Vec3 q = cap.position(map.vertex[c]) - cap.position(map.vertex[a]);
        const Vec2 u = map.uv[b] - map.uv[a], v = map.uv[c] - map.uv[a];
        const double on_surface = std::acos(p.normalized().dot(q.normalized()));
        CHECK(std::abs(std::acos(u.normalized().dot(v.normalized())) - on_surface) < 0.06);
    }
}

TEST_CASE("the energy of arap never increases, and it stretches less than the map it begins with") {
    for (const Mesh& mesh : {bumpy_cap(), bumpy_cap(-0.4), uneven_grid(), grid_with_holes()}) {
        const Parameterization conformal = laid_out(mesh, ParameterizeMethod::lscm);
        const Parameterization rigid = laid_out(mesh, ParameterizeMethod::arap);
        CHECK(rigid.energy.size() <= 21);
        for (std::size_t i = 1; i < rigid.energy.size(); ++i) {
            CHECK(rigid.energy[i] <= rigid.energy[i - 1] * (1.0 + 1e-12) + 1e-20);
        }
        CHECK(rigid.method == ParameterizeMethod::arap);
        CHECK(rigid.max_scale / rigid.min_scale <=
              conformal.max_scale / conformal.min_scale + 1e-6);
        check_one_to_one(rigid);
    }
}

TEST_CASE("arap without iterations is lscm") {
    const Mesh mesh = bumpy_cap();
    ParameterizeOptions options;
    options.maximum_iterations = 0;
    const Parameterization map = parameterize(mesh, Region::all(mesh.shared_topology()), options);
    CHECK(map.method == ParameterizeMethod::lscm);
    CHECK(map.energy.size() == 1);
    CHECK(map.uv == laid_out(mesh, ParameterizeMethod::lscm).uv);
}

TEST_CASE("a part of a cylinder is unrolled without stretch") {
    const Mesh tube = make_cylinder({.segments = 40, .rings = 12, .caps = false});
    const Mesh sheet = extract(tube, select_plane(tube, {0.3, 0, 0}, {-1, 0, 0})).mesh;
    const Parameterization map = laid_out(sheet, ParameterizeMethod::arap);
    CHECK(map.method == ParameterizeMethod::arap);
    CHECK(map.min_scale == Approx(1.0).epsilon(1e-6));
    CHECK(map.max_scale == Approx(1.0).epsilon(1e-6));
    check_one_to_one(map);
}

TEST_CASE("a map onto a disk is one to one, with its outline on a circle") {
    for (const Mesh& mesh : {bumpy_cap(), bumpy_cap(-0.8), uneven_grid(), grid_with_holes(),
                             make_grid({.size = {1, 40}, .segments = {3, 60}})}) {
        const Parameterization map = laid_out(mesh, ParameterizeMethod::tutte);
        check_one_to_one(map);
        const double radius = map.uv[at(map.loops[0][0])].norm();
        for (const Index v : map.loops[0]) {
            CHECK(map.uv[at(v)].norm() == Approx(radius).epsilon(0.02));
        }
    }
}

TEST_CASE("lscm and tutte keep the area, and the outline is around the origin") {
    const Mesh mesh = bumpy_cap();
    for (const ParameterizeMethod method : {ParameterizeMethod::lscm, ParameterizeMethod::tutte}) {
        const Parameterization map = laid_out(mesh, method);
        double sum = 0.0;
        for (const auto& [a, b, c] : map.surface_triangles()) {
            const Vec2 u = map.uv[b] - map.uv[a], v = map.uv[c] - map.uv[a];
            sum += 0.5 * (u.x() * v.y() - u.y() * v.x());
        }
        CHECK(sum == Approx(area(mesh)));
        const Vec2& first = map.uv[map.loops[0][0]];
        CHECK(first.x() > 0.0);
        CHECK(std::abs(first.y()) < 1e-12);
    }
}

TEST_CASE("the result names vertices and faces of the mesh, and the longest boundary first") {
    const Mesh mesh = grid_with_holes();
    const Region region = select_box(mesh, {Vec3(-0.9, -1, -0.9), Vec3(2, 1, 2)});
    const Parameterization map = parameterize(mesh, region);
    CHECK(map.vertex == region.vertices());
    CHECK(map.uv.size() == map.vertex.size());
    CHECK(map.loops.size() == 3);
    CHECK(map.loops[0].size() > map.loops[1].size() + map.loops[2].size());
    CHECK(map.triangles.size() == map.face.size() + map.fill_triangles().size());
    CHECK(map.fill_triangles().size() == map.loops[1].size() + map.loops[2].size() - 4);
    for (std::size_t t = 0; t < map.face.size(); ++t) {
        const std::span<const Index> face = mesh.topology().face(map.face[t]);
        for (const Index v : map.triangles[t]) {
            CHECK(std::find(face.begin(), face.end(), map.vertex[v]) != face.end());
        }
    }
}

TEST_CASE("polygons are laid out by their triangles") {
    FaceList faces;
    faces.add({0, 1, 2, 3, 4, 5});
    faces.add({1, 0, 6, 7});
    const Mesh mesh(
        {{1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 1, 0}, {1, -1, 0}, {2, -1, 0}},
        std::move(faces));
    const Parameterization map = laid_out(mesh, ParameterizeMethod::arap);
    CHECK(map.face == std::vector<Index>{0, 0, 0, 0, 1, 1});
    CHECK(map.max_scale == Approx(1.0));
    CHECK(map.loops.size() == 1);
}

TEST_CASE("a single triangle is laid out as it is") {
    FaceList faces;
    faces.add({0, 1, 2});
    const Mesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}, std::move(faces));
    for (const ParameterizeMethod method : {ParameterizeMethod::lscm, ParameterizeMethod::arap}) {
        const Parameterization map = laid_out(mesh, method);
        CHECK((map.uv[1] - map.uv[0]).norm() == Approx(3.0));
        CHECK((map.uv[2] - map.uv[1]).norm() == Approx(5.0));
        check_one_to_one(map);
    }
    check_one_to_one(laid_out(mesh, ParameterizeMethod::tutte));
}

TEST_CASE("the map is the same every time and for any number of threads") {
    const Mesh mesh = bumpy_cap(-0.2, 40);
    ContextOptions options;
    options.threads = 4;
    const Region all = Region::all(mesh.shared_topology());
    for (const ParameterizeMethod method : kMethods) {
        const Parameterization map = laid_out(mesh, method);
        CHECK(laid_out(mesh, method).uv == map.uv);
        CHECK(parameterize(mesh, all, {.method = method}, Context(options)).uv == map.uv);
    }
}

TEST_CASE("faces too thin to be laid out are told, with a remedy") {
    // The triangles of a polygon of very many corners are slivers.
    const Index n = 20000;
    std::vector<Vec3> points;
    std::vector<Index> face;
    for (Index i = 0; i < n; ++i) {
        const double angle = 2.0 * kPi * i / n;
        points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        face.push_back(i);
    }
    FaceList faces;
    faces.add(face);
    Mesh mesh(std::move(points), std::move(faces));
    const std::vector<Index> all{0};
    try {
        parameterize(mesh, all, {.method = ParameterizeMethod::lscm});
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::not_positive_definite);
        CHECK(error.message().find("remesh") != std::string::npos);
    }
    const Parameterization map = parameterize(mesh, all, {.method = ParameterizeMethod::tutte});
    CHECK(map.uv.size() == at(n));
    write_uv(mesh, map);
    CHECK(mesh.attributes().find("uv") != nullptr);
}
