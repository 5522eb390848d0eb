#include "kernel/mesh/measure/region_normals.h"

#include "kernel/mesh/edit/triangulate.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

namespace {

Mesh shaken(Mesh mesh, std::uint32_t seed) {
    test::Random random(seed);
    const double step = 0.3 * mean_edge_length(mesh);
    for (Vec3& p : mesh.edit_positions()) p += step * random.direction();
    return mesh;
}

std::vector<Vec3> positions_in(const Mesh& mesh, const Region& region) {
    std::vector<Vec3> result;
    for (const Index v : region.vertices()) result.push_back(mesh.position(v));
    return result;
}

double worst_difference(const Mesh& mesh, const Region& region, RegionNormals& rule) {
    const std::vector<Vec3>& normals = rule.evaluate(positions_in(mesh, region));
    const std::vector<Vec3> expected = vertex_normals(mesh);
    double worst = 0.0;
    for (Index row = 0; row < region.size(); ++row) {
        const Index v = region.vertices()[at(row)];
        worst = std::max(worst, (normals[at(row)] - expected[at(v)]).norm());
    }
    return worst;
}

RegionNormals rule_of(const Mesh& mesh, const Region& region, const Context& context = {}) {
    return {region, [&](Index v) { return mesh.position(v); }, context};
}

// A star of five points and one pentagon in it: corners beyond a straight angle.
Mesh make_star() {
    std::vector<Vec3> positions;
    for (int i = 0; i < 10; ++i) {
        const double radius = i % 2 == 0 ? 2.0 : 0.7;
        positions.emplace_back(radius * std::cos(i * kPi / 5), radius * std::sin(i * kPi / 5),
                               0.1 * i);
    }
    FaceList faces;
    faces.add({0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    return {positions, faces};
}

}  // namespace

TEST_CASE("normals of a region are those of its mesh, frame after frame") {
    for (const Mesh& shape :
         {make_sphere({.segments = 20}), make_cactus(), make_bar({}), make_star()}) {
        const Region all = Region::all(shape.shared_topology());
        RegionNormals rule = rule_of(shape, all);
        for (const std::uint32_t seed : {1u, 2u}) {
            CHECK(worst_difference(shaken(shape, seed), all, rule) < 1e-13);
        }
        CHECK(worst_difference(shape, all, rule) < 1e-13);
    }
}

TEST_CASE("normals of a region are those of its mesh at every size") {
    for (const Mesh& shape : {make_sphere({.segments = 8}), make_star()}) {
        for (const double size : {1e-300, 1e-160, 1e-70, 1e70, 1e100, 1e200, 1e307}) {
            CAPTURE(size);
            Mesh scaled = shape;
            for (Vec3& p : scaled.edit_positions()) p *= size;
            const Region all = Region::all(scaled.shared_topology());
            RegionNormals rule = rule_of(scaled, all);
            const std::vector<Vec3>& normals = rule.evaluate(positions_in(scaled, all));
            const std::vector<Vec3> expected = vertex_normals(shape);
            for (std::size_t v = 0; v < normals.size(); ++v) {
                CHECK((normals[v] - expected[v]).norm() < 1e-12);
            }
        }
    }
}

TEST_CASE("normals at the outline of a region count the faces outside") {
    const Mesh mesh = shaken(make_sphere({.segments = 20}), 5);
    std::vector<Index> upper;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (mesh.position(v).y() > 0.2) upper.push_back(v);
    }
    const Region region(mesh.shared_topology(), upper);
    RegionNormals rule = rule_of(mesh, region);
    CHECK(worst_difference(mesh, region, rule) < 1e-13);
}

TEST_CASE("normals without a face, or with flat ones alone, are zero") {
    Mesh mesh = make_grid({.size = {1, 1}, .segments = {2, 2}});
    for (Vec3& p : mesh.edit_positions()) p = Vec3(p.x(), 0, 0);
    const Region all = Region::all(mesh.shared_topology());
    RegionNormals rule = rule_of(mesh, all);
    for (const Vec3& n : rule.evaluate(mesh.positions())) CHECK(n.isZero(0.0));
}

TEST_CASE("normals do not depend on the number of threads") {
    const Mesh mesh = shaken(make_sphere({.segments = 80}), 9);
    const Region all = Region::all(mesh.shared_topology());
    const auto with = [&](int threads) {
        ContextOptions options;
        options.threads = threads;
        RegionNormals rule = rule_of(mesh, all);
        return rule.evaluate(mesh.positions(), Context(options));
    };
    CHECK(with(1) == with(4));
}

TEST_CASE("normals refuse another number of positions, and a limit of memory that is too small") {
    const Mesh mesh = make_sphere({.segments = 20});
    const Region all = Region::all(mesh.shared_topology());
    RegionNormals rule = rule_of(mesh, all);
    const std::vector<Vec3> few(3);
    CHECK_THROWS_AS(rule.evaluate(few), Error);
    ContextOptions options;
    options.memory_limit = 1000;
    const Context small(options);
    CHECK_THROWS_AS(rule_of(mesh, all, small), Error);
    CHECK(small.memory()->used() == 0);
}
