/// SpatialTree: nearest points and ray hits on a mesh, by a hierarchy of bounding boxes over its
/// triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// A point of a surface.
struct SurfacePoint {
    Index face = kNoIndex;
    /// Vertices of the triangle of the face that contains the point, and its barycentric
    /// coordinates.
    Triangle triangle{kNoIndex, kNoIndex, kNoIndex};
    Vec3 barycentric = Vec3::Zero();
    Vec3 position = Vec3::Zero();
    /// Distance from the query point, or along the ray in units of length.
    double distance = 0.0;
    /// The vertex of the triangle that is nearest to `position`; of equals the smallest.
    Index vertex = kNoIndex;
    /// Unit normal of the triangle; zero for a triangle without area.
    Vec3 normal = Vec3::Zero();
};

class SpatialTree {
  public:
    /// Copies the present shape of `mesh`, which may change or die afterwards.
    /// Errors: mesh_empty without faces; memory_limit; cancelled.
    explicit SpatialTree(const Mesh& mesh, const Context& context = {});

    /// The point of the surface nearest to `point`; of equally near triangles the one of the
    /// smallest face.
    /// Errors: not_finite.
    SurfacePoint nearest(const Vec3& point) const;
    /// As `nearest`, or nothing where the surface is farther than `limit`.
    std::optional<SurfacePoint> nearest_within(const Vec3& point, double limit) const;

    /// The first hit of a ray, on either side of the surface; of equally far triangles the one of
    /// the smallest face. `direction` need not have unit length. Rays through edges and vertices do
    /// not slip through (Woop, Benthin and Wald 2013).
    /// Errors: invalid_argument for a direction without length; not_finite.
    std::optional<SurfacePoint> pick(const Vec3& origin, const Vec3& direction) const;

    /// All hits of a ray in ascending distance; equally far ones in the order of their faces.
    /// Errors: as `pick`.
    std::vector<SurfacePoint> pick_all(const Vec3& origin, const Vec3& direction) const;

    /// Mesh::revision of the shape it was built for.
    std::uint64_t revision() const { return revision_; }
    Box bounds() const;
    std::size_t memory_bytes() const;

  private:
    /// A leaf has `count` > 0 triangles from `first` on; the children of another node are `first`
    /// and the one after.
    struct Node {
        Box box;
        Index first = 0, count = 0;
    };
    struct Ray;
    struct Hit {
        Index triangle = kNoIndex;
        Vec3 barycentric = Vec3::Zero();
        double distance = 0.0;
    };

    void build(const Context& context);
    Index split(const Node& node, std::vector<Index>& order, const std::vector<Box>& boxes,
                bool halve) const;
    std::optional<Hit> nearest_triangle(const Vec3& point, double limit) const;
    std::optional<Hit> hit_triangle(Index triangle, const Ray& ray) const;
    template <typename Visit>
    void visit_along(const Ray& ray, const double& limit, const Visit& visit) const;
    SurfacePoint surface_point(const Hit& hit) const;

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<Index> faces_;
    /// Triangles in the order of the leaves.
    std::vector<Index> order_;
    std::vector<Node> nodes_;
    std::uint64_t revision_ = 0;
    MemoryCharge charge_;
};

}  // namespace lissom
