/// PickScene: the pickable objects of a picture: surfaces, points such as handles, and polylines
/// such as curves and strands, each placed in the world.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/query/box_tree.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// Points to pick from.
class PointSet {
  public:
    /// Errors: not_finite; cancelled.
    explicit PointSet(std::vector<Vec3> points, const Context& context = {});

    std::span<const Vec3> points() const { return points_; }
    const BoxTree& boxes() const { return boxes_; }

  private:
    std::vector<Vec3> points_;
    BoxTree boxes_;
};

/// Polylines to pick from: line i has the points offsets[i] .. offsets[i + 1] - 1.
class PolylineSet {
  public:
    /// A segment of a line, between two points; of a line of one point both are the same.
    struct Segment {
        Index line, first, second;
    };

    /// `closed` lines also run from their last point to their first. Errors: not_finite;
    /// invalid_argument if `offsets` do not ascend from 0 to the number of points; cancelled.
    PolylineSet(std::vector<Vec3> points, std::vector<Index> offsets, bool closed = false,
                const Context& context = {});

    std::span<const Vec3> points() const { return points_; }
    Index line_count() const { return count_of(offsets_) - 1; }
    std::span<const Segment> segments() const { return segments_; }
    /// Place of a segment in its line, from 0.
    Index place(const Segment& segment) const { return segment.first - offsets_[at(segment.line)]; }
    /// Returns the boxes of the segments.
    const BoxTree& boxes() const { return boxes_; }

  private:
    std::vector<Vec3> points_;
    std::vector<Index> offsets_;
    std::vector<Segment> segments_;
    BoxTree boxes_;
};

/// Placement of an object, and its drawn sides.
struct Placement {
    /// Map from the object's own frame to the world.
    Affine to_world = {};
    /// Drawn over everything, so that no surface hides it.
    bool on_top = false;
};

class PickScene {
  public:
    /// One object; two of the pointers are null.
    struct Object {
        const SpatialTree* surface = nullptr;
        const PointSet* points = nullptr;
        const PolylineSet* lines = nullptr;
        Affine to_world = {}, to_local = {};
        bool on_top = false;
    };

    /// Each adds an object, which must outlive the scene and not change, and returns its number.
    /// Errors: invalid_argument for a transform that is not finite or has no inverse.
    Index add(const SpatialTree& surface, const Placement& placement = {});
    Index add(const PointSet& points, const Placement& placement = {});
    Index add(const PolylineSet& lines, const Placement& placement = {});
    Index add(SpatialTree&&, const Placement& = {}) = delete;
    Index add(PointSet&&, const Placement& = {}) = delete;
    Index add(PolylineSet&&, const Placement& = {}) = delete;

    std::span<const Object> objects() const { return objects_; }
    const Object& object(Index i) const { return objects_[at(i)]; }

  private:
    Index add(Object object, const Placement& placement);

    std::vector<Object> objects_;
};

}  // namespace lissom
