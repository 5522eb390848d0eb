/// Coordinates on the band beside a seam: around it and away from it; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// One side of a seam as far as a band reaches, and a little farther. `angle` is a fraction of a
/// turn around the seam, 0 to 1, on the seam by arc length from its first vertex: the argument of
/// the harmonic extension of exp(2 pi i u) from the seam. `distance` is geodesic, from the seam. No
/// cut and no flat domain are needed, and both sides agree on the seam.
struct BandChart {
    SeamSide side = SeamSide::target;
    /// Vertices of the mesh, and their coordinates.
    std::vector<Index> vertex;
    std::vector<double> angle, distance;
    /// Triangles over places in `vertex`.
    std::vector<Triangle> triangles;
    /// Greatest distance on this part of the side, and the least one on an open boundary
    /// that goes around it, as the far end of a tube does; infinity if the chart has
    /// none.
    double farthest = 0.0, end = 0.0;
};

/// The chart of all that lies within `width` of one of the seams, on one side of it.
/// Errors: memory_limit; cancelled.
BandChart make_band_chart(const Sewn& sewn, std::span<const Index> seam, SeamSide side,
                          double width, const Context& context);

/// For each point of a closed polyline its fraction of the way around, from 0 at the first.
std::vector<double> loop_fractions(std::span<const Vec3> points);

}  // namespace lissom
