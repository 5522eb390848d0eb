/// Charts: connected faces cut open and laid out in the plane; private to kernel/mesh.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/unwrap/face_graph.h"

namespace lissom {

struct FlatChart {
    /// Faces of the mesh, ascending, and the place in `uv` of each of their corners in turn.
    std::vector<Index> faces, places;
    std::vector<Vec2> uv;
    /// Over places in `uv`.
    std::vector<Triangle> triangles;
    /// Greatest change of a length by the map at each triangle, as a factor of 1 or more, and its
    /// area on the surface.
    std::vector<double> stretches, areas;

    double area() const;
    /// Returns the stretch that all but a fiftieth of the area keeps below.
    double stretch() const;
};

/// Lays out connected faces, with seams within rings. Nothing if they are closed,
/// have handles, would cover a point twice or turn a face over, or are stretched more than
/// `stretch`; one face alone always becomes a chart. Errors: memory_limit, cancelled.
std::optional<FlatChart> flatten(const FaceGraph& graph, std::span<const Index> faces,
                                 double stretch, const Context& context);

}  // namespace lissom
