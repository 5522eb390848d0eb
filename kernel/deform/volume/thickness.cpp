#include "kernel/deform/volume/thickness.h"

#include <optional>

#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// Rays start this far below the surface, in its radii, so that they pass the vertex's own faces.
constexpr double kStartDepth = 1e-5;

// The cosine of normals above which two surfaces do not lie opposite to one another.
constexpr double kOpposite = -0.3;

// Each quad is there by both diagonals; one of them makes a surface, so that a point opposite has
// one triangle.
std::vector<Triangle> single_surface(const WeightedTriangles& triangles) {
    std::vector<Triangle> result;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const bool of_quad = triangles.weight[t] < 1.0;
        if (!of_quad || t % 2 == 0) result.push_back(triangles.triangle[t]);
    }
    return result;
}

std::optional<ThicknessPair> pair_of(const WorkingPatch& work, const SpatialTree& tree, Index v) {
    const Vec3& normal = work.geometry.normal[at(v)];
    if (normal.isZero(0.0)) return std::nullopt;
    const Vec3 from = work.patch.rest[at(v)] - kStartDepth * work.radius * normal;
    const std::optional<SurfacePoint> hit = tree.pick(from, -normal);
    if (!hit || !(hit->normal.dot(normal) < kOpposite)) return std::nullopt;
    return ThicknessPair{v, hit->triangle, hit->barycentric,
                         Vec3(work.patch.rest[at(v)] - hit->position), work.geometry.area[at(v)]};
}

}  // namespace

Thickness find_thickness(const WorkingPatch& work, const Context& context) {
    const Patch& patch = work.patch;
    Thickness thickness;
    if (patch.triangles.size() == 0) return thickness;
    const SpatialTree tree({patch.rest.begin(), patch.rest.begin() + patch.real_count},
                           single_surface(patch.triangles), context);
    std::vector<std::optional<ThicknessPair>> found(at(patch.mesh_count()));
    constexpr Index kGrain = 256;
    context.parallel_for(0, count_of(patch.of_region), kGrain, [&](Index begin, Index end) {
        for (Index row = begin; row < end; ++row) {
            const Index v = patch.of_region[at(row)];
            found[at(v)] = pair_of(work, tree, v);
        }
    });
    double covered = 0.0, whole = 0.0;
    for (const Index v : patch.of_region) whole += work.geometry.area[at(v)];
    for (const std::optional<ThicknessPair>& pair : found) {
        if (!pair) continue;
        thickness.pairs.push_back(*pair);
        covered += pair->area;
    }
    if (whole > 0.0) thickness.coverage = covered / whole;
    return thickness;
}

}  // namespace lissom
