/// Contours of a function on a mesh: its crossings of edges, joined to lines; private to
/// kernel/mesh.
///
/// Values are linear on the triangles of the mesh, polygons being triangulated (triangulation.h).
/// No vertex lies on a contour: one with the value 0 counts as positive, or as negative if all
/// neighbours of its connected zeros are negative. So contours never branch, and a function that
/// only touches 0 has none there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// A function on vertices and the side of its contour that each lies on.
struct LevelSet {
    /// NaN if there is none: contours end there.
    std::vector<double> value;
    /// 1 or -1; 0 if there is no value.
    std::vector<signed char> side;
};

/// Sides for `value`, one a vertex; those within `tolerance` of 0 are made 0 first.
LevelSet level_set(const Topology& topology, std::vector<double> value, double tolerance);

/// Crossing of a contour and an edge: `t` of the way from its positive end to its negative one.
struct Crossing {
    Index positive = kNoIndex, negative = kNoIndex;
    double t = 0.5;

    Index other(Index v) const { return v == positive ? negative : positive; }
    Vec3 point(const Mesh& mesh) const;
};

/// One connected contour: crossings in order, with the positive side on the left.
struct ContourLine {
    std::vector<Crossing> crossings;
    /// Triangle i of the mesh's polygons lies between crossings i and i + 1; of a closed line the
    /// last leads back to the first.
    std::vector<Triangle> triangles;
    /// Faces that those triangles are parts of.
    std::vector<Index> faces;
    bool closed = false;
    /// True if an end of an open line lies inside the mesh, because values end there.
    bool clipped = false;

    std::vector<Vec3> points(const Mesh& mesh) const;
};

/// Returns all contours of a function, in the order of the faces at which they are first met.
/// Errors: nonmanifold_edge if triangulated polygons share a diagonal; cancelled.
std::vector<ContourLine> trace_contours(const Mesh& mesh, const LevelSet& levels,
                                        const Context& context);

/// Finds the crossing on an edge. Made of the lines that a mesh is cut along.
class CrossedEdges {
  public:
    explicit CrossedEdges(const std::vector<ContourLine>& lines);

    /// Number of the crossing between two vertices, in either order, or kNoIndex. They are numbered
    /// line by line.
    Index find(Index a, Index b) const;
    const Crossing& operator[](Index i) const { return crossings_[at(i)]; }
    Crossing& operator[](Index i) { return crossings_[at(i)]; }
    Index size() const { return count_of(crossings_); }
    /// Number of the first crossing of a line.
    Index first(std::size_t line) const { return first_[line]; }

  private:
    std::vector<Crossing> crossings_;
    std::vector<Index> first_;
    std::unordered_map<std::uint64_t, Index> number_;
};

}  // namespace lissom
