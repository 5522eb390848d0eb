#include "kernel/merge/blend/fair_seam.h"

#include "kernel/merge/blend/seam_core.h"
#include "tests/unit/merge/blend/fairing_scenes.h"

using namespace lissom;

namespace {

Sewn sphere(SphereKind kind) {
    Mesh mesh = make_sphere({.segments = 16, .kind = kind});
    const Region top = select_plane(mesh, {0, 0, 0.3}, {0, 0.2, 1});
    return test::sewn(std::move(mesh), top);
}

std::vector<Index> fair(Sewn& sewn, const SeamFairing& options = {}) {
    return fair_seam(sewn.mesh, sewn.seams, options);
}

}  // namespace

TEST_CASE("a crease at the seam goes, with any number of rings") {
    for (const Index rings : {3, 4, 6, 9}) {
        Sewn cone = test::creased();
        const double before = test::seam_dihedral(cone.mesh, cone.seams);
        CHECK(before > 30.0);
        fair(cone, {.rings = rings});
        CHECK(test::seam_dihedral(cone.mesh, cone.seams) < 0.2 * before);
    }
}

TEST_CASE("a ragged ring between smooth sides becomes smooth") {
    test::Random random(3);
    Sewn cone = test::creased(0.2), ragged = cone;
    for (const Index v : ragged.seams[0]) {
        ragged.mesh.edit_positions()[v] += 0.02 * random.direction();
    }
    const double before = test::seam_dihedral(ragged.mesh, ragged.seams);
    fair(ragged);
    CHECK(test::seam_dihedral(ragged.mesh, ragged.seams) < 0.25 * before);
    fair(cone);
    // Both end at nearly the same surface.
    for (const Index v : cone.seams[0]) {
        CHECK(std::abs(cone.mesh.position(v).head<2>().norm() -
                       ragged.mesh.position(v).head<2>().norm()) < 0.006);
    }
}

TEST_CASE("a smooth surface stays as it is, of triangles or quads") {
    for (const SphereKind kind : {SphereKind::triangles, SphereKind::quads}) {
        Sewn ball = sphere(kind);
        const double h = mean_edge_length(ball.mesh);
        fair(ball);
        for (const Vec3& p : ball.mesh.positions()) CHECK(std::abs(p.norm() - 1.0) < 0.03 * h);
    }
    Mesh grid = make_grid({.segments = {20, 20}});
    const Region middle = select_sphere(grid, Vec3::Zero(), 0.2);
    Sewn flat = test::sewn(std::move(grid), middle);
    fair(flat);
    for (const Vec3& p : flat.mesh.positions()) CHECK(std::abs(p.y()) < 1e-14);
}

TEST_CASE("only the band moves, and it is what is returned") {
    Sewn cone = test::creased();
    const Mesh before = cone.mesh;
    const std::vector<Index> band = fair(cone, {.rings = 5});
    CHECK(band.size() == 64 * 11);
    CHECK(test::moved_vertices(before, cone.mesh) == band);
    const std::vector<Index> rings = seam_rings(before.topology(), cone.seams, 5);
    for (Index v = 0; v < before.vertex_count(); ++v) {
        CHECK((rings[v] != kNoIndex) == std::binary_search(band.begin(), band.end(), v));
    }
}

TEST_CASE("details outside the core stay, with those at the seam gone") {
    const auto bumpy = [](double angle, double z) {
        return 1.0 + 0.02 * std::sin(16 * angle) * std::cos(16 * z);
    };
    Sewn tube = test::revolution(96, 16, bumpy);
    const Mesh before = tube.mesh;
    const std::vector<Index> rings = seam_rings(before.topology(), tube.seams, 8);
    const std::vector<Index> band = fair(tube, {.rings = 8, .umbrella = 0});
    for (const Index v : band) {
        const double moved = (tube.mesh.position(v) - before.position(v)).norm();
        if (rings[v] > 3) CHECK(moved < 0.25 * 0.02);
    }
}

TEST_CASE("the result follows a similarity of the input") {
    test::Random random(5);
    for (const double scale : {1e-3, 1.0, 1e4}) {
        Sewn cone = test::creased(), image = cone;
        const Affine map = test::similarity(random, scale);
        image.mesh = test::moved(cone.mesh, map);
        fair(cone);
        fair(image);
        CHECK(test::max_move(test::moved(cone.mesh, map), image.mesh) < 1e-9 * scale);
    }
}

TEST_CASE("a fairing does not depend on how vertices and faces are numbered") {
    Sewn cone = test::revolution(32, 10, [](double angle, double z) {
        return 1.0 + 0.5 * std::max(0.0, z) + 0.05 * std::sin(3.0 * angle + 2.0 * z);
    });
    const Index n = cone.mesh.vertex_count();
    std::vector<std::vector<Index>> orders = {test::shuffled_numbers(n, 1),
                                              test::shuffled_numbers(n, 2)};
    // Those of the seam first.
    std::vector<Index>& first = orders.emplace_back(static_cast<std::size_t>(n));
    for (Index v = 0; v < n; ++v) first[v] = (v - cone.seams[0].front() + n) % n;
    std::vector<Sewn> images;
    for (const std::vector<Index>& to : orders) images.push_back(test::renumbered(cone, to));
    fair(cone);
    for (std::size_t i = 0; i < orders.size(); ++i) {
        fair(images[i]);
        CHECK(test::max_move(cone.mesh, images[i].mesh, orders[i]) < 1e-9);
    }
}

TEST_CASE("the result does not depend on the number of threads") {
    Sewn one = test::creased(), many = one;
    fair(one);
    ContextOptions options;
    options.threads = 4;
    fair_seam(many.mesh, many.seams, {}, Context(options));
    CHECK(hash(one.mesh) == hash(many.mesh));
}

TEST_CASE("several seams, on a handle and with bands that overlap") {
    Mesh torus = make_torus();
    test::Random random(7);
    for (Vec3& p : torus.edit_positions()) {
        if (std::abs(p.x()) < 0.2) p += 0.03 * random.direction();
    }
    const Region half = select_plane(torus, Vec3::Zero(), {1, 0, 0});
    Sewn ring = test::sewn(torus, half);
    REQUIRE(ring.seams.size() == 2);
    const double before = test::seam_dihedral(ring.mesh, ring.seams);
    fair(ring);
    CHECK(test::seam_dihedral(ring.mesh, ring.seams) < 0.5 * before);

    // Two seams three rows apart: one band.
    Sewn cone = test::creased();
    std::vector<Index> second = cone.seams[0];
    for (Index& v : second) v += 3 * 64;
    cone.seams.push_back(second);
    const std::vector<Index> band = fair(cone, {.rings = 4});
    CHECK(band.size() == 64 * 12);
    CHECK(test::seam_dihedral(cone.mesh, cone.seams) < 8.0);
}

TEST_CASE("open boundaries in the band stay") {
    Sewn shell =
        test::revolution(32, 3, [](double, double z) { return 1.0 + 0.5 * std::max(0.0, z); });
    const Mesh before = shell.mesh;
    const double crease = test::seam_dihedral(shell.mesh, shell.seams);
    const std::vector<Index> band = fair(shell, {.rings = 10});
    CHECK(band.size() == 32 * 5);
    for (const auto& loop : before.topology().boundary_loops()) {
        for (const Index v : loop) CHECK(shell.mesh.position(v) == before.position(v));
    }
    CHECK(test::seam_dihedral(shell.mesh, shell.seams) < 0.5 * crease);
}

TEST_CASE("the smallest meshes: farthest vertices hold what nothing else holds") {
    FaceList faces;
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
        faces.add({a, b, 3});
        faces.add({b, a, 4});
    }
    Mesh mesh({{1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.8, 0.1}, {0, 0, 1}, {0, 0, -1}},
              std::move(faces));
    const std::vector<std::vector<Index>> seams{{0, 1, 2}};
    const Mesh before = mesh;
    CHECK(fair_seam(mesh, seams) == std::vector<Index>{0, 1, 2});
    CHECK(mesh.position(3) == before.position(3));
    CHECK(mesh.position(4) == before.position(4));
    CHECK(test::max_move(mesh, before) < 2.0);

    // A seam through all vertices has nothing to move between.
    Mesh tetrahedron = test::tetrahedron();
    CHECK(fair_seam(tetrahedron, std::vector<std::vector<Index>>{{0, 1, 2, 3}}).empty());
    CHECK(test::same_shape(tetrahedron, test::tetrahedron()));
}

TEST_CASE("slivers and folded edges at the seam leave the band finite and near") {
    Sewn cone = test::creased(0.3);
    const Mesh before = cone.mesh;
    for (std::size_t i = 0; i < cone.seams[0].size(); i += 2) {
        const std::vector<Index>& seam = cone.seams[0];
        cone.mesh.edit_positions()[seam[i]] = before.position(seam[i + 1]);
    }
    fair(cone);
    CHECK(test::max_move(cone.mesh, before) < 0.3);
}

TEST_CASE("custom normals turn with the band, all others stay to the bit") {
    Sewn cone = test::creased();
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (const Vec3& n : vertex_normals(cone.mesh)) {
        normals.values.insert(normals.values.end(), {n.x(), n.y(), n.z()});
    }
    cone.mesh.attributes().add(std::move(normals));
    const Mesh before = cone.mesh;
    fair(cone);
    const std::vector<Vec3> expected = vertex_normals(cone.mesh);
    const std::vector<Index> rings = seam_rings(before.topology(), cone.seams, 6);
    for (Index v = 0; v < before.vertex_count(); ++v) {
        const auto now = cone.mesh.attributes().find("normal")->at(v);
        const auto old = before.attributes().find("normal")->at(v);
        CHECK((Vec3(now[0], now[1], now[2]) - expected[v]).norm() < 1e-12);
        if (rings[v] == kNoIndex) CHECK(std::equal(now.begin(), now.end(), old.begin()));
    }
}

TEST_CASE("options out of range, unknown vertices and a cancel change nothing") {
    Sewn cone = test::creased();
    const std::uint64_t before = hash(cone.mesh);
    const auto code = [&](const SeamFairing& options) {
        return test::error_of([&] { fair(cone, options); }).code();
    };
    CHECK(code({.rings = 0}) == ErrorCode::invalid_argument);
    CHECK(code({.core = 0}) == ErrorCode::invalid_argument);
    CHECK(code({.rings = 2, .core = 3}) == ErrorCode::invalid_argument);
    CHECK(code({.umbrella = -1}) == ErrorCode::invalid_argument);
    CHECK(code({.passes = 0}) == ErrorCode::invalid_argument);
    const std::vector<std::vector<Index>> foreign{{0, 1, 100000}};
    const Error error = test::error_of([&] { fair_seam(cone.mesh, foreign); });
    CHECK(error.code() == ErrorCode::out_of_range);
    CHECK(error.elements().ids == std::vector<Index>{100000});
    const Context context;
    context.cancel();
    CHECK(test::error_of([&] { fair_seam(cone.mesh, cone.seams, {}, context); }).code() ==
          ErrorCode::cancelled);
    CHECK(hash(cone.mesh) == before);
    CHECK(fair_seam(cone.mesh, {}).empty());
    CHECK(hash(cone.mesh) == before);
    // The least that is allowed.
    CHECK_NOTHROW(fair(cone, {.rings = 1, .core = 1, .umbrella = 0, .passes = 1}));
}
