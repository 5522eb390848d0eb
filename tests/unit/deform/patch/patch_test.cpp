// A patch: virtual vertices opposite boundary vertices of valence 2.
#include "kernel/deform/patch/patch.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

namespace {

// A star of one face: every second corner is an ear. Radii vary by `noise`.
Mesh star(Index corners, double noise) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> vary(1.0 - noise, 1.0 + noise);
    std::vector<Vec3> positions;
    FaceList faces;
    std::vector<Index> face;
    for (Index k = 0; k < corners; ++k) {
        const double angle = 2.0 * kPi * k / corners, radius = (k % 2 ? 0.9 : 1.0) * vary(random);
        positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        face.push_back(k);
    }
    faces.add(face);
    return Mesh(std::move(positions), faces);
}

// Looks at all triangles for every edge.
WeightedTriangles split_by_search(const Patch& patch) {
    WeightedTriangles triangles = patch.triangles;
    const Rings rings = build_rings(patch.real_count, triangles);
    Index next = patch.real_count;
    for (Index v = 0; v < patch.real_count; ++v) {
        if (!patch.in_region[v] || !patch.on_boundary[v] || rings.count(v) != 2) continue;
        const std::size_t count = triangles.size();
        for (std::size_t i = 0; i < count; ++i) {
            Triangle first = triangles.triangle[i], second = first;
            const auto a = std::find(first.begin(), first.end(), rings.ring(v)[0]);
            const auto b = std::find(second.begin(), second.end(), rings.ring(v)[1]);
            if (a == first.end() || b == second.end()) continue;
            *a = *b = next;
            triangles.triangle[i] = first;
            triangles.add(second, triangles.weight[i], triangles.face[i]);
        }
        if (triangles.size() > count) ++next;
    }
    return triangles;
}

Patch patch_of(const Mesh& mesh) {
    return build_patch(mesh, Region::all(mesh.shared_topology()), 1);
}

}  // namespace

TEST_CASE("patch: virtual vertices split the triangles that a search of all finds, in its order") {
    for (const Mesh& mesh :
         {star(9, 0.0), star(40, 0.05), star(301, 0.3), make_bar({1, 2, 3, 6}), make_grid()}) {
        const Patch patch = patch_of(mesh);
        const WeightedTriangles expected = split_by_search(patch);
        CHECK(patch.split_triangles.triangle == expected.triangle);
        CHECK(patch.split_triangles.weight == expected.weight);
        CHECK(patch.split_triangles.face == expected.face);
    }
    CHECK(patch_of(star(40, 0.0)).vertex_count > 55);
}
