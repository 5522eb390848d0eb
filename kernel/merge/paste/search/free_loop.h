/// A boundary that is free of the mesh's edges (thesis section 3.5); private to kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/paste_energy.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/parameterize/uv_grid.h"

namespace lissom {

/// A point of the ring's surface and its image.
struct RingPoint {
    Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
    /// In the plane of the source's chart.
    Vec2 uv = Vec2::Zero();
    ImagePoint image;
};

/// The ring in the plane of the source's chart.
struct RingTriangles {
    RingTriangles(const PasteChart& chart, const PasteRegions& regions);

    /// Over places of the chart.
    std::vector<Triangle> triangles;
    UvGrid grid;
    /// A point of the plane that the ring runs around.
    Vec2 middle = Vec2::Zero();
};

/// The ring as a surface with an image of every point: vertices have the given ones, points of
/// triangles the interpolated ones in the plane of the target.
class RingSurface {
  public:
    /// One image a place of the source's chart. All must outlive it.
    RingSurface(const PasteMap& map, const RingTriangles& ring, std::span<const ImagePoint> images)
        : map_(map), ring_(ring), images_(images) {}

    const PasteMap& map() const { return map_; }
    const RingTriangles& ring() const { return ring_; }
    std::span<const ImagePoint> images() const { return images_; }
    /// The point with given weights of three places.
    RingPoint point(const Triangle& places, const Vec3& weights) const;
    /// Returns the point between vertices of the source, by their weights. Without an image if a
    /// vertex has none, or no place in the chart.
    RingPoint blend(std::span<const ElementMap::Source> vertices) const;
    /// The point at a place of the plane, or nothing outside the ring.
    std::optional<RingPoint> locate(const Vec2& uv) const;

  private:
    const PasteMap& map_;
    const RingTriangles& ring_;
    std::span<const ImagePoint> images_;
    void add(Index place, double weight, RingPoint& point) const;
    void finish(RingPoint& point, Index only) const;
};

/// A closed line of the ring, counter-clockwise.
struct FreeLoop {
    std::vector<RingPoint> points;
    PasteSimilarity similarity;
    double energy = 0.0, misfit = 0.0;
};

/// Returns the cheapest loop through vertices and middles of edges within four rings of `from`,
/// sampled evenly, smoothed, and kept in the ring and on the target's region. Returns nothing if it
/// would cross itself or cost more than `from`. Errors: cancelled.
std::optional<FreeLoop> free_loop(const RingSurface& surface, const PasteLoop& from,
                                  const EnergyOptions& options, const Context& context);

/// The outlines of a ring.
enum class Outline { outer, inner };

/// A line along an outline of the ring, without its teeth: smoothed, and drawn away from it until
/// it lies in the ring. Returns nothing if it leaves the target's region or crosses itself.
std::optional<FreeLoop> outline_loop(const RingSurface& surface, const PasteLoop& outline,
                                     Outline which, const EnergyOptions& options);

/// Returns a line carried to another surface. Returns nothing if it leaves that or crosses itself.
std::optional<FreeLoop> carried_loop(const RingSurface& surface, const FreeLoop& line,
                                     const PasteLoop& from, const EnergyOptions& options);

}  // namespace lissom
