/// Correspondence of a paste: both surfaces laid out in the plane, one put onto the other (thesis
/// section 3.4.1, step 2); private to kernel/merge.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/parameterize/parameterize.h"
#include "kernel/mesh/parameterize/uv_grid.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// A piece of surface in the plane with the values that placements need of it.
struct PasteChart {
    Parameterization map;
    /// Mean of the feature's outline in the plane (of the source).
    Vec2 center = Vec2::Zero();
    /// Length on the surface over length in the plane, of the ring's edges (of the source).
    double length_ratio = 1.0;
    /// Greatest distance in the plane from `center` to the ring (of the source).
    double reach = 0.0;

    /// Place in `map.vertex` of a vertex, or kNoIndex.
    Index place_of(Index vertex) const;
    MapQuality quality() const;
};

/// The triangles of a chart as a mesh whose vertices are places of the chart.
Mesh chart_mesh(const Mesh& mesh, const PasteChart& chart);

/// Returns the ring, with a row of faces on each side of it if these leave it an annulus, and
/// triangles of least area over the feature's outline. Maps other than LSCM turn no face over: one
/// onto a disk is taken instead of a map that would.
/// Errors: boundary_conflict, naming faces, if that turns some over too; as `parameterize`.
PasteChart source_chart(const Mesh& source, const PasteRegions& regions, ParameterizeMethod method,
                        const Context& context);
/// Faces that are a disk, the same way. Errors: the same.
PasteChart target_chart(const Mesh& target, std::span<const Index> faces, ParameterizeMethod method,
                        const Context& context);

/// Image of one vertex of the ring on the target.
struct ImagePoint {
    /// Whether it lies on the target's region; nothing else is known otherwise.
    bool inside = false;
    Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
    /// In the plane of the target's chart.
    Vec2 uv = Vec2::Zero();
    /// See PasteMap::set_relief.
    double relief = 0.0;
};

/// A similarity of the plane: p -> factor R(angle) (p - center) + point.
struct PlanarMap {
    Vec2 center = Vec2::Zero(), point = Vec2::Zero();
    double factor = 1.0, angle = 0.0;
    /// The directions that its base is taken from lie clearly in both surfaces.
    bool clear = false;
    Vec2 operator()(const Vec2& p) const;
};

/// Values that maps of any region of the target need of both meshes, which must outlive it.
struct PasteSurfaces {
    PasteSurfaces(const Mesh& source, const Mesh& target);

    const Mesh &source, &target;
    std::vector<Vec3> source_normals, target_normals;
    SpatialTree target_tree;
};

/// Both charts, with the structures for placing one on the other many times.
class PasteMap {
  public:
    /// The surfaces must outlive it. `nearest` is for those who ask for nearest points.
    PasteMap(const PasteSurfaces& surfaces, PasteChart source_chart, PasteChart target_chart,
             bool nearest);

    const Mesh& source_mesh() const { return surfaces_.source; }
    const std::vector<Vec3>& source_normals() const { return surfaces_.source_normals; }
    const PasteChart& source() const { return source_; }
    const PasteChart& target() const { return target_; }

    /// Sets how much a line at each place of the target's chart would cut through a feature that
    /// was removed there: without unit, 0 beside features. It counts for boundaries that are
    /// sought.
    void set_relief(std::vector<double> relief) { relief_ = std::move(relief); }

    /// Returns the map of the plane that a placement asks for, `angle` being the whole angle from
    /// the base direction. Errors: boundary_conflict if the point is not on the target's region;
    /// invalid_argument for a scale that is not above 0 or a direction without length; not_finite.
    PlanarMap planar(const PastePlacement& placement, double angle) const;
    /// One image a place of the source's chart.
    std::vector<ImagePoint> images(const PlanarMap& plane) const;
    /// Whether nearest points can be asked for.
    bool has_nearest() const { return chart_tree_.has_value(); }
    /// The point of the target's region nearest to a point of space.
    ImagePoint nearest(const Vec3& point) const;
    /// Of the points at which a line meets the target's region and that look along it, the one
    /// nearest to `near`. Nothing where there is none, or without `nearest`.
    std::optional<ImagePoint> along(const Vec3& point, const Vec3& direction,
                                    const Vec3& near) const;
    /// The point of the target's surface at a place of its plane.
    std::optional<ImagePoint> on_target(const Vec2& uv) const;

  private:
    ImagePoint image_at(const Triangle& places, const Vec3& weights) const;
    Vec2 point_of(const PastePlacement& placement) const;
    double target_ratio(const Vec2& point, double radius) const;
    void turn_to_base(const PastePlacement& placement, double radius, PlanarMap& plane) const;

    const PasteSurfaces& surfaces_;
    PasteChart source_, target_;
    std::vector<double> relief_;
    /// Tree of the target's region, whose vertices are places of the chart.
    std::optional<SpatialTree> chart_tree_;
    UvGrid grid_;
};

}  // namespace lissom
