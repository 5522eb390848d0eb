/// SpatialTree: nearest points and ray hits on a mesh, by a hierarchy of bounding boxes over its
/// triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/box_tree.h"
#include "kernel/mesh/topology.h"

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
    /// The vertex of the triangle nearest to `position`; the smallest of ties.
    Index vertex = kNoIndex;
    /// Unit normal of the triangle; zero for a triangle without area.
    Vec3 normal = Vec3::Zero();
};

/// Selection of the hits of a ray.
struct RayOptions {
    /// Greatest distance, in units of length.
    double limit = std::numeric_limits<double>::infinity();
    /// Whether triangles count that the ray meets from behind.
    bool back_faces = true;
};

/// Options of occlusion between a point and an eye.
struct HideOptions {
    /// Distance of the eye.
    double eye = std::numeric_limits<double>::infinity();
    /// Whether triangles hide it that the eye sees from behind.
    bool back_faces = true;
    /// Triangles as near to the point as this do not hide it, for instance adjacent ones at a
    /// vertex; at least the rounding error.
    double touching = 0.0;
    /// Triangles as near to it as this on the way to the eye do not hide it either.
    double slack = 0.0;
};

class SpatialTree {
  public:
    /// Copies the present shape of `mesh`, which may change or die afterwards.
    /// Errors: mesh_empty without faces; memory_limit; cancelled.
    explicit SpatialTree(const Mesh& mesh, const Context& context = {});
    /// A tree of triangles that need not form a mesh: each counts as a face of its own. It has no
    /// topology, and `refit` refuses it. Errors: as before.
    SpatialTree(std::vector<Vec3> positions, std::vector<Triangle> triangles,
                const Context& context = {});

    /// Takes the present shape of `mesh`, which must have the topology of the mesh that the tree
    /// was built for. Queries give the same answers as those of a new tree; the time is linear and
    /// a small part of building one, but see `wear`. Errors: topology_mismatch; memory_limit;
    /// cancelled. The tree is then as it was.
    void refit(const Mesh& mesh, const Context& context = {});
    /// Returns how much more a query is expected to cost than when the tree was built: 1 for a new
    /// tree. Building it again is worth the time if this is far above 1 and many queries follow.
    double wear() const { return boxes_.wear(); }

    /// Returns the point of the surface nearest to `point`; of equally near triangles the one of
    /// the smallest face. Errors: not_finite.
    SurfacePoint nearest(const Vec3& point) const;
    /// Returns the result of `nearest`, or nothing if the surface is farther than `limit`.
    std::optional<SurfacePoint> nearest_within(const Vec3& point, double limit) const;

    /// Returns the first hit of a ray, on either side of the surface; of equally far triangles the
    /// one of the smallest face. `direction` need not have unit length. Rays through edges and
    /// vertices do not slip through (Woop, Benthin and Wald 2013). Errors: invalid_argument for a
    /// direction without length; not_finite.
    std::optional<SurfacePoint> pick(const Vec3& origin, const Vec3& direction,
                                     const RayOptions& options = {}) const;

    /// Returns whether the surface lies between `point` and an eye in the direction `towards`. A
    /// point of the surface is not hidden by its own triangles, for any view. Errors: as `pick`.
    bool hides(const Vec3& point, const Vec3& towards, const HideOptions& options = {}) const;

    /// Returns all hits of a ray in ascending distance; equally far ones in the order of their
    /// faces. Errors: as `pick`.
    std::vector<SurfacePoint> pick_all(const Vec3& origin, const Vec3& direction) const;

    /// Mesh::revision of the shape it has.
    std::uint64_t revision() const { return revision_; }
    Box bounds() const { return boxes_.bounds(); }

    /// The shape that the tree is of: its triangles, the faces they are part of, and their boxes.
    /// The topology is null, or must not be asked for, for a tree of triangles alone.
    const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }
    const Topology& topology() const { return *topology_; }
    std::span<const Vec3> positions() const { return positions_; }
    std::span<const Triangle> triangles() const { return triangles_; }
    std::span<const Index> faces() const { return faces_; }
    const BoxTree& boxes() const { return boxes_; }
    std::size_t memory_bytes() const;

  private:
    struct Line;
    struct Hit {
        Index triangle = kNoIndex;
        Vec3 barycentric = Vec3::Zero();
        double distance = 0.0;
    };

    void build(const Context& context);
    Box box_of(Index triangle) const;
    std::optional<Hit> nearest_triangle(const Vec3& point, double limit) const;
    std::optional<Hit> hit_triangle(Index triangle, const Line& ray) const;
    template <typename Visit>
    void visit_along(const Line& ray, const double& limit, const Visit& visit) const;
    Vec3 area_normal(Index triangle) const;
    SurfacePoint surface_point(const Hit& hit) const;

    std::vector<Vec3> positions_;
    std::vector<Triangle> triangles_;
    std::vector<Index> faces_;
    BoxTree boxes_;
    std::shared_ptr<const Topology> topology_;
    std::uint64_t revision_ = 0;
    MemoryCharge charge_;
};

}  // namespace lissom
