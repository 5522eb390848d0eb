#include "kernel/deform/system/gradients.h"

#include <random>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

using namespace lissom;

namespace {

struct Stencils {
    Patch patch;
    Rings rings;
    RingGeometry geometry;
    GradientStencils gradients;

    // All vertices are free and need a gradient.
    explicit Stencils(const Mesh& mesh, const DeformOptions& options = {})
        : patch(build_patch(mesh, Region::all(mesh.shared_topology()), 1)),
          rings(build_rings(patch.vertex_count, patch.split_triangles)),
          geometry(ring_geometry(rings, patch.split_triangles, patch.rest)) {
        const auto n = static_cast<std::size_t>(patch.vertex_count);
        const KnownMask known{std::vector<char>(n, 0), std::vector<char>(n, 0),
                              std::vector<char>(n, 1)};
        gradients = make_gradients(patch, rings, geometry, known, Vec3(0.3, 0.0, 0.1), options);
    }
};

Affine some_affine_map() {
    Affine map;
    map.linear << 1.2, 0.3, -0.4, 0.1, 0.7, 0.5, -0.6, 0.2, 1.5;
    map.translation = {3.0, -2.0, 1.0};
    return map;
}

// Greatest error of M_i against the affine map that moved all vertices.
double affine_error(const Stencils& s) {
    const Affine map = some_affine_map();
    std::vector<Vec3> moved;
    for (const Vec3& p : s.gradients.displaced_rest) moved.push_back(map(p));
    double greatest = 0.0;
    for (Index i = 0; i < s.rings.size(); ++i) {
        REQUIRE(s.gradients.defined[i]);
        greatest = std::max(greatest, (s.gradients.gather(s.rings, moved, i) - map.linear).norm());
    }
    return greatest;
}

}  // namespace

TEST_CASE("gradients: Eq 2.5 finds an affine map exactly, on a curved surface") {
    const Stencils s(make_torus());
    CHECK(s.gradients.displaced.empty());
    CHECK(affine_error(s) < 1e-9);
}

TEST_CASE("gradients: degenerate vertices of a plane are displaced until all have one") {
    const Stencils s(make_grid());
    CHECK(affine_error(s) < 1e-9);
    const auto displaced = static_cast<Index>(s.gradients.displaced.size());
    CHECK(displaced > 20);
    // Only some move: neighbours of a displaced vertex are degenerate no more.
    CHECK(displaced < 80);
}

TEST_CASE("gradients: displacement follows Eq 2.9") {
    DeformOptions options;
    options.displacement = 0.2;
    const Stencils s(make_grid({{1.0, 1.0}, {10, 10}}), options);
    int checked = 0;
    for (const Index i : s.gradients.displaced) {
        if (i >= s.patch.real_count || s.patch.on_boundary[i]) continue;
        double length = 0.0;
        for (const Index j : s.rings.ring(i)) length += (s.patch.rest[i] - s.patch.rest[j]).norm();
        const Vec3 expected = 0.2 * length / s.rings.count(i) * Vec3::UnitY();
        CHECK((s.gradients.displaced_rest[i] - s.patch.rest[i] - expected).norm() < 1e-12);
        ++checked;
    }
    CHECK(checked > 10);
}

TEST_CASE("gradients: a corner of valence 2 gets a virtual vertex and then a gradient") {
    // Two triangles: the corners 1 and 3 have valence 2.
    FaceList faces;
    faces.add({0, 1, 2});
    faces.add({0, 2, 3});
    const Mesh mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, faces);
    const Stencils s(mesh);
    CHECK(s.patch.real_count == 4);
    CHECK(s.patch.vertex_count > 4);
    CHECK(affine_error(s) < 1e-9);
}

TEST_CASE("gradients: the threshold decides what counts as degenerate") {
    // A shallow bump: flat by a strict measure, curved by a lax one.
    Mesh bump = make_grid({{1.0, 1.0}, {12, 12}});
    for (Vec3& p : bump.edit_positions()) p.y() = 0.05 * (p.x() * p.x() + p.z() * p.z());
    DeformOptions strict, lax;
    strict.degenerate_threshold = 1e2;
    lax.degenerate_threshold = 1e7;
    CHECK(Stencils(bump, strict).gradients.displaced.size() >
          Stencils(bump, lax).gradients.displaced.size());
}
