#include "kernel/mesh/edit/smooth.h"

#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

Mesh noisy_sphere() {
    Mesh mesh = make_sphere({.segments = 16});
    test::Random random(11);
    for (Vec3& p : mesh.edit_positions()) p *= random.uniform(0.97, 1.03);
    return mesh;
}

double roughness(const Mesh& mesh) {
    double sum = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        Vec3 mean = Vec3::Zero();
        for (const Index n : mesh.topology().neighbors(v)) mean += mesh.position(n);
        sum += (mean / mesh.topology().valence(v) - mesh.position(v)).squaredNorm();
    }
    return std::sqrt(sum / mesh.vertex_count());
}

}  // namespace

TEST_CASE("smoothing takes noise away, with either weights") {
    for (const SmoothWeights weights : {SmoothWeights::uniform, SmoothWeights::cotangent}) {
        Mesh mesh = noisy_sphere();
        const double before = roughness(mesh);
        smooth(mesh, {.iterations = 5, .weights = weights});
        CHECK(roughness(mesh) < 0.5 * before);
    }
}

TEST_CASE("keeping the volume keeps most of it") {
    Mesh shrunk = noisy_sphere(), kept = noisy_sphere();
    const double before = volume(shrunk);
    smooth(shrunk, {.iterations = 20});
    smooth(kept, {.iterations = 20, .keep_volume = true});
    CHECK(volume(shrunk) < 0.93 * before);
    CHECK(volume(kept) > 0.99 * before);
    CHECK(roughness(kept) < 0.5 * roughness(noisy_sphere()));
}

TEST_CASE("fixed boundaries stay to the bit, others stay on their loop") {
    Mesh flat = make_grid();
    for (Vec3& p : flat.edit_positions()) p.y() = 0.1 * std::sin(7 * p.x() + 3 * p.z());
    Mesh fixed = flat, along = flat;
    smooth(fixed);
    smooth(along, {.boundary = SmoothBoundary::along});
    double moved = 0.0;
    for (const Index v : flat.topology().boundary_loops()[0]) {
        CHECK(fixed.position(v) == flat.position(v));
        moved += (along.position(v) - flat.position(v)).norm();
    }
    CHECK(moved > 0.01);
}

TEST_CASE("a plane with a fixed boundary stays a plane") {
    Mesh grid = make_grid();
    smooth(grid, {.iterations = 50, .strength = 1.0});
    for (const Vec3& p : grid.positions()) CHECK(std::abs(p.y()) < 1e-15);
}

TEST_CASE("outside the region nothing moves") {
    Mesh mesh = noisy_sphere();
    const Mesh before = mesh;
    const Region half = select_plane(mesh, Vec3::Zero(), Vec3(1, 2, 3));
    smooth(mesh, {.region = half});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CHECK((mesh.position(v) == before.position(v)) == !half.contains(v));
    }
}

TEST_CASE("results do not depend on threads, frame or scale") {
    Mesh one = make_cactus({.vertices = 9000}), many = one;
    smooth(one, {.iterations = 3});
    ContextOptions options;
    options.threads = 4;
    smooth(many, {.iterations = 3}, Context(options));
    CHECK(hash(one) == hash(many));

    test::Random random(12);
    const Affine map = test::similarity(random, 1e3);
    Mesh image = test::moved(noisy_sphere(), map), mesh = noisy_sphere();
    smooth(mesh, {.weights = SmoothWeights::cotangent});
    smooth(image, {.weights = SmoothWeights::cotangent});
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        CHECK((image.position(v) - map(mesh.position(v))).norm() < 1e-8);
    }
}

TEST_CASE("custom normals turn with the surface") {
    Mesh mesh = noisy_sphere();
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (const Vec3& n : vertex_normals(mesh)) {
        normals.values.insert(normals.values.end(), {n.x(), n.y(), n.z()});
    }
    mesh.attributes().add(std::move(normals));
    smooth(mesh);
    const std::vector<Vec3> expected = vertex_normals(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const auto n = mesh.attributes().find("normal")->at(v);
        CHECK((Vec3(n[0], n[1], n[2]) - expected[v]).norm() < 1e-12);
    }
}

TEST_CASE("options out of range, foreign regions and a cancel change nothing") {
    Mesh mesh = noisy_sphere();
    const std::uint64_t before = hash(mesh);
    const auto code = [&](const SmoothOptions& options, const Context& context = {}) {
        return test::error_of([&] { smooth(mesh, options, context); }).code();
    };
    CHECK(code({.iterations = -1}) == ErrorCode::invalid_argument);
    CHECK(code({.strength = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code({.strength = 1.1}) == ErrorCode::invalid_argument);
    CHECK(code({.strength = test::kNaN}) == ErrorCode::invalid_argument);
    CHECK(code({.region = Region::all(make_box().shared_topology())}) ==
          ErrorCode::topology_mismatch);
    const Context context;
    context.cancel();
    CHECK(code({}, context) == ErrorCode::cancelled);
    CHECK(hash(mesh) == before);
    smooth(mesh, {.iterations = 0});
    CHECK(hash(mesh) == before);
}
