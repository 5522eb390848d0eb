/// Subdivision of a mesh.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

enum class SubdivisionScheme {
    /// Splits edges in the middle and keeps the shape: a triangle becomes four, a polygon one quad
    /// a corner. A polygon that cannot be seen whole from its mean point is triangulated first.
    midpoint,
    /// Loop 1987, with cubic B-splines as boundaries (Hoppe et al. 1994). Polygons are triangulated
    /// first.
    loop,
    /// Catmull and Clark 1978, with cubic B-splines as boundaries. Every face becomes quads.
    catmull_clark,
};

struct SubdivideOptions {
    /// Number of splits of each face; 0 copies the mesh.
    Index levels = 1;
    SubdivisionScheme scheme = SubdivisionScheme::midpoint;
    /// Splits the faces of this region only; all faces if absent. Triangles beside it are divided
    /// along with their edges, and polygons take the new vertices in, so that there are no
    /// T-junctions. Only vertices whose faces are all split are smoothed.
    std::optional<Region> region = std::nullopt;
};

/// Returns the subdivided mesh. Old vertices keep their ids; then follow those on edges, in the
/// order of the edges, and those inside faces. Attributes are interpolated linearly, corner
/// attributes within each face, so that seams stay; offsets of morph targets are subdivided as
/// positions are; the faces made from one face follow each other. Errors: invalid_argument for
/// negative levels; topology_mismatch for a region of another mesh; region_empty for a region
/// without a face; out_of_range if the result would have more elements than Index can number;
/// memory_limit; cancelled.
Mesh subdivide(const Mesh& mesh, const SubdivideOptions& options = {}, const Context& context = {});

}  // namespace lissom
