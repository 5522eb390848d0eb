#include <cmath>

#include "kernel/deform/deformer.h"
#include "tests/unit/deform/models.h"

using namespace lissom;

namespace {

// A cone of n faces around its tip, vertex 0, and a ring of quads below.
Mesh hub(Index n) {
    std::vector<Vec3> points{{0.0, 0.0, 1.0}};
    FaceList faces;
    for (const double z : {0.0, -1.0}) {
        for (Index i = 0; i < n; ++i) {
            const double angle = 2.0 * kPi * i / n;
            points.emplace_back(std::cos(angle), std::sin(angle), z);
        }
    }
    for (Index i = 0; i < n; ++i) {
        const Index next = (i + 1) % n;
        faces.add({0, 1 + i, 1 + next});
        faces.add({1 + i, 1 + n + i, 1 + n + next, 1 + next});
    }
    return {std::move(points), std::move(faces)};
}

Region ring(const Mesh& mesh, Index n, Index which) {
    std::vector<Index> vertices;
    for (Index i = 0; i < n; ++i) vertices.push_back(1 + which * n + i);
    return Region(mesh.shared_topology(), vertices);
}

}  // namespace

TEST_CASE("a vertex of some hundred neighbours bends with its surface") {
    const Index n = 600;
    const Mesh mesh = hub(n);
    Deformer deformer(mesh);
    deformer.pin(ring(mesh, n, 1));
    const HandleId tip = deformer.add_handle(Region(mesh.shared_topology(), {0}));
    deformer.translate(tip, {0.0, 0.0, 0.5});
    const std::vector<Vec3>& positions = deformer.solve();
    CHECK((positions[0] - Vec3(0.0, 0.0, 1.5)).norm() < 1e-9);
    // The ring between stays a circle.
    for (Index i = 1; i <= n; ++i) {
        CHECK(positions[at(i)].head<2>().norm() ==
              doctest::Approx(positions[1].head<2>().norm()).epsilon(1e-6));
    }
}

TEST_CASE("vertices of too many neighbours are refused before memory is taken") {
    const Index n = 30000;
    const Mesh mesh = hub(n);
    Deformer deformer(mesh);
    deformer.pin(ring(mesh, n, 1));
    const HandleId tip = deformer.add_handle(Region(mesh.shared_topology(), {0}));
    deformer.translate(tip, {0.0, 0.0, 0.5});
    const Error error = test::error_of([&] { deformer.solve(); });
    CHECK(error.code() == ErrorCode::unsupported);
    CHECK(error.elements().ids == std::vector<Index>{0});
}

TEST_CASE("pairs of neighbours count against the limit of memory") {
    const Index n = 6000;
    const Mesh mesh = hub(n);
    ContextOptions options;
    options.memory_limit = std::size_t{400} << 20;
    const Context context(options);
    Deformer deformer(mesh, {}, context);
    deformer.pin(ring(mesh, n, 1));
    deformer.add_handle(Region(mesh.shared_topology(), {0}));
    const Error error = test::error_of([&] { deformer.solve(FrameQuality::full, context); });
    CHECK(error.code() == ErrorCode::memory_limit);
}
