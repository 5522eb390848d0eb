/// Rings of vertices next to a seam, which have the shape of neither side; private to
/// kernel/merge.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Number of edges from each vertex to the nearest of `seams`: 0 on them; kNoIndex beyond `limit`.
std::vector<Index> seam_rings(const Topology& topology, std::span<const std::vector<Index>> seams,
                              Index limit);

/// Returns the vertices with a ring number that may move. Vertices on open boundaries stay; so do
/// those farthest from its seams in a component that has numbers everywhere.
Region seam_band(const std::shared_ptr<const Topology>& topology, std::span<const Index> rings);

/// The core of a band: the rows on a seam, and those within some rings of it that move. Rows on
/// open boundaries are none of it.
class SeamCore {
  public:
    /// `rings` of the mesh's vertices; those below `width` are core.
    SeamCore(const BandSystem& band, std::span<const Index> rings, Index width);

    bool contains(Index local) const { return unknown_[at(local)] != kNoIndex; }

    /// One umbrella step within the tangent planes of the shape last measured: the core moves
    /// towards the mean of its neighbours, all at once, half the way on the seam and less in each
    /// ring away from it. Along the normal it would sink, and take with it the curvature that is
    /// to be kept around it. A vertex whose step is more than a quarter of its shortest edge stays,
    /// as triangles would turn over in the fans between loops of unlike density. All shapes of the
    /// band make the step of its positions.
    void umbrella(BandSystem& band) const;

    /// Laplacian coordinates for each shape of `band` to bend to, one for each local vertex: those
    /// of the shape last measured, with the mean curvature given for every row. In the core the
    /// curvature and the normals are filled harmonically from around it, and there is nothing along
    /// the surface.
    std::vector<std::vector<Vec3>> relaxed(const BandSystem& band,
                                           std::span<const std::vector<double>> curvature,
                                           const Context& context) const;
    /// The given curvatures of each shape with those of the core filled.
    std::vector<std::vector<double>> filled(const BandSystem& band,
                                            std::span<const std::vector<double>> curvature,
                                            const Context& context) const;

  private:
    using Values = std::vector<Vec4>;
    std::vector<Values> fill(const BandSystem& band, std::vector<Values> values,
                             const Context& context) const;
    std::vector<Index> vertices_;
    // Unknown of each local vertex in `fill`, or kNoIndex outside the core.
    std::vector<Index> unknown_;
    // Length of an umbrella step, 0 to 1, for each vertex of the core.
    std::vector<double> strength_;
};

}  // namespace lissom
