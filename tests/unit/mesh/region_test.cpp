#include "kernel/mesh/region.h"

#include <algorithm>
#include <limits>
#include <set>

#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;

namespace {

Region random_region(const Mesh& mesh, test::Random& random) {
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (random.uniform(0, 1) < 0.5) vertices.push_back(v);
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

}  // namespace

TEST_CASE("a region sorts its vertices and drops repeats") {
    const Mesh mesh = make_box();
    const Region region(mesh.shared_topology(), {5, 1, 5, 3, 1});
    CHECK(region.vertices() == std::vector<Index>{1, 3, 5});
    CHECK(region.contains(3));
    CHECK(!region.contains(2));
    CHECK(region.size() == 3);
}

TEST_CASE("vertices that do not exist are named") {
    const Mesh mesh = make_box();
    const Error error = test::error_of([&] { Region(mesh.shared_topology(), {0, 8, -1}); });
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(error.elements().ids == std::vector<Index>{8, -1});
}

TEST_CASE("set operations obey the laws of sets") {
    const Mesh mesh = make_sphere({.segments = 6});
    test::Random random(4);
    const Region all = Region::all(mesh.shared_topology());
    const Region none = Region::none(mesh.shared_topology());
    for (int i = 0; i < 10; ++i) {
        const Region a = random_region(mesh, random), b = random_region(mesh, random),
                     c = random_region(mesh, random);
        CHECK(a.united(b) == b.united(a));
        CHECK(a.intersected(b) == b.intersected(a));
        CHECK(a.united(b.intersected(c)) == a.united(b).intersected(a.united(c)));
        CHECK(a.intersected(b.united(c)) == a.intersected(b).united(a.intersected(c)));
        CHECK(a.united(b).inverted() == a.inverted().intersected(b.inverted()));
        CHECK(a.minus(b) == a.intersected(b.inverted()));
        CHECK(a.inverted().inverted() == a);
        CHECK(a.united(a.inverted()) == all);
        CHECK(a.intersected(a.inverted()) == none);
    }
}

TEST_CASE("growing and shrinking are each other's complement") {
    const Mesh mesh = make_grid({.segments = {20, 20}});
    const Region disc = select_sphere(mesh, Vec3::Zero(), 0.2);
    CHECK(disc.grown(0) == disc);
    CHECK(disc.grown(2) == disc.grown(1).grown(1));
    CHECK(disc.shrunk(2) == disc.inverted().grown(2).inverted());
    CHECK(disc.shrunk(1).grown(1).intersected(disc) == disc.shrunk(1).grown(1));
    CHECK(test::error_of([&] { (void)disc.grown(-1); }).code() == ErrorCode::invalid_argument);
}

TEST_CASE("an open boundary does not count as outside") {
    const Mesh mesh = make_grid();
    const Region all = Region::all(mesh.shared_topology());
    CHECK(all.shrunk(3) == all);
}

TEST_CASE("regions of different topologies do not mix") {
    const Mesh a = make_box(), b = make_box();
    const Region of_a = Region::all(a.shared_topology()), of_b = Region::all(b.shared_topology());
    CHECK(test::error_of([&] { (void)of_a.united(of_b); }).code() == ErrorCode::topology_mismatch);
    CHECK(test::error_of([&] { (void)of_a.minus(of_b); }).code() == ErrorCode::topology_mismatch);
    CHECK(test::error_of([&] { (void)of_a.intersected(of_b); }).code() ==
          ErrorCode::topology_mismatch);
}

TEST_CASE("a region's faces have all their vertices inside") {
    const Mesh mesh = test::patch();
    CHECK(Region(mesh.shared_topology(), {0, 1, 2, 3}).faces() == std::vector<Index>{0, 1});
    CHECK(Region(mesh.shared_topology(), {0, 1, 3}).faces().empty());
    CHECK(Region::all(mesh.shared_topology()).faces().size() == 3);
}

TEST_CASE("the outline runs in the direction of the region's faces") {
    const Mesh mesh = make_grid({.size = {3, 3}, .segments = {3, 3}});
    // The middle quad of the grid.
    const Region middle(mesh.shared_topology(), {5, 6, 9, 10});
    REQUIRE(middle.boundaries().size() == 1);
    CHECK(middle.boundaries()[0] == std::vector<Index>{5, 9, 10, 6});
    const auto& face = mesh.topology().face(4);
    CHECK(std::vector<Index>(face.begin(), face.end()) == std::vector<Index>{5, 9, 10, 6});
}

TEST_CASE("the outline of a whole open mesh is its boundary") {
    for (const Mesh& mesh : {make_grid(), make_cylinder({.caps = false}), test::patch()}) {
        CHECK(Region::all(mesh.shared_topology()).boundaries() == mesh.topology().boundary_loops());
    }
    CHECK(Region::all(make_torus().shared_topology()).boundaries().empty());
}

TEST_CASE("a band has two outlines") {
    const Mesh mesh = make_cylinder({.rings = 8});
    const Region band = select_box(mesh, {Vec3(-1, -0.3, -1), Vec3(1, 0.3, 1)});
    CHECK(band.boundaries().size() == 2);
}

TEST_CASE("where faces touch at a vertex each keeps its own outline") {
    const Mesh mesh = make_grid({.size = {2, 2}, .segments = {2, 2}});
    // Two quads that meet in the middle vertex 4.
    const Region corners(mesh.shared_topology(), {0, 1, 3, 4, 5, 7, 8});
    const auto loops = corners.boundaries();
    REQUIRE(loops.size() == 2);
    CHECK(loops[0] == std::vector<Index>{0, 3, 4, 1});
    CHECK(loops[1] == std::vector<Index>{4, 7, 8, 5});
}

TEST_CASE("outlines are the boundaries of the extracted part") {
    const Mesh mesh = make_sphere({.segments = 8});
    test::Random random(5);
    for (int i = 0; i < 10; ++i) {
        const Region region = random_region(mesh, random).grown(1);
        std::multiset<std::size_t> sizes, expected;
        for (const auto& loop : region.boundaries()) sizes.insert(loop.size());
        const Mesh part = extract(mesh, region).mesh;
        for (const auto& loop : part.topology().boundary_loops()) {
            expected.insert(loop.size());
        }
        CHECK(sizes == expected);
    }
}

TEST_CASE("smoothing removes specks and pinholes and keeps straight edges") {
    const Mesh mesh = make_grid({.segments = {20, 20}});
    const Region half = select_plane(mesh, Vec3(0.01, 0, 0), Vec3(1, 0, 0));
    const Index hole = half.vertices()[half.vertices().size() / 2 + 3];
    const Index speck = half.inverted().vertices()[88];
    const Region pin(mesh.shared_topology(), {hole}), dot(mesh.shared_topology(), {speck});
    const Region rough = half.minus(pin).united(dot);
    CHECK(rough.smoothed() == half);
    CHECK(rough.smoothed(0) == rough);
}

TEST_CASE("smoothing leaves no region empty") {
    const Mesh mesh = make_grid();
    const Region dot(mesh.shared_topology(), {60});
    CHECK(dot.smoothed(10) == dot);
}

TEST_CASE("votes that swing between two outlines end, as if all were held") {
    // A checkerboard on a closed strip: each vote turns it over.
    const Mesh mesh = make_torus();
    std::vector<Index> vertices;
    const auto& topology = mesh.topology();
    std::vector<int> color(static_cast<std::size_t>(mesh.vertex_count()), -1);
    std::vector<Index> front{0};
    color[0] = 0;
    while (!front.empty()) {
        const Index v = front.back();
        front.pop_back();
        for (const Index n : topology.neighbors(v)) {
            if (color[n] >= 0) continue;
            color[n] = 1 - color[v];
            front.push_back(n);
        }
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (color[v] == 0) vertices.push_back(v);
    }
    const Region board(mesh.shared_topology(), vertices);
    const Region once = board.smoothed(1);
    constexpr Index kForEver = std::numeric_limits<Index>::max();
    CHECK(board.smoothed(kForEver) == board.smoothed(kForEver % 2 == 1 ? 1 : 2));
    CHECK(board.smoothed(kForEver - 1) == board.smoothed(2));
    CHECK(once.smoothed(1000001) == once.smoothed(1));
}
