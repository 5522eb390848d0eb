/// The search for faces that meet in one shape of a mesh after another, with the memory and the
/// hierarchy that it keeps; private to kernel/deform.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/contact/face_tree.h"
#include "kernel/deform/contact/local_shape.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/measure/triangulation_room.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Finds the pairs of faces that self_intersections finds in a shape and not in the rest shape. The
/// hierarchy of boxes is built once. Pairs of neighbours that evidently lie side by side are told
/// from those that may be folded upon each other by their fans (spread_fans.h).
class ContactSearch {
  public:
    /// Takes `rest` as the rest shape. Errors: memory_limit; cancelled.
    ContactSearch(std::shared_ptr<const Topology> topology, std::vector<Vec3> rest,
                  const Context& context);
    ContactSearch(const ContactSearch&) = delete;
    ContactSearch& operator=(const ContactSearch&) = delete;

    const std::vector<Vec3>& rest() const { return rest_; }
    const Topology& topology() const { return *topology_; }

    /// Returns the new pairs in `shape`, ascending. Vertices of one `part` lie as in the rest
    /// shape, up to a similarity for each part; kNoIndex is none. Errors: cancelled.
    std::vector<FacePair> find(std::span<const Vec3> shape, std::span<const Index> part,
                               const Context& context);

  private:
    using Corners = std::array<Vec3, 3>;
    // A polygon and its triangles.
    struct Polygon {
        std::vector<Vec3> points;
        std::vector<Triangle> triangles;

        void set(std::span<const Index> vertices, std::span<const Vec3> shape);
        void triangulate(TriangulationRoom& room);
        Corners corners(const Triangle& t) const {
            return {points[at(t[0])], points[at(t[1])], points[at(t[2])]};
        }
    };
    // Memory of a search.
    struct PolygonRoom {
        Polygon f, g;
        TriangulationRoom room;
    };

    void set_parts(std::span<const Index> part);
    void prepare(std::span<const Vec3> shape, const Context& context);
    std::vector<FacePair> pairs(const Context& context) const;
    bool meet(Index slot, Index other, PolygonRoom& room) const;
    bool share_spread_fan(std::span<const Index> a, std::span<const Index> b) const;
    bool polygons_meet(std::span<const Index> f, std::span<const Index> g, PolygonRoom& room) const;
    bool corners_meet(const Corners& a, const Corners& b) const;
    Corners corners_at(std::span<const Index> vertices) const;

    std::shared_ptr<const Topology> topology_;
    MemoryCharge charge_;
    std::vector<Vec3> rest_;
    FaceTree tree_;
    std::vector<FacePair> known_;
    // The parts of the last shape, and the vertices of faces that have none.
    std::vector<Index> part_, loose_;
    // Of the shape that is searched.
    std::span<const Vec3> shape_;
    LocalShape local_;
    std::vector<char> spread_;
};

}  // namespace lissom
