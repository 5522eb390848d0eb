/// Remeshing: triangles of even size and shape for the same surface.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct RemeshOptions {
    /// Length of edges, and the longest where they adapt; the mean of the mesh's if absent.
    std::optional<double> edge = std::nullopt;
    /// Edges are shorter where the surface is curved, so that they stay as near to it as this
    /// length; all edges are alike if absent.
    std::optional<double> error = std::nullopt;
    /// Shortest edge where they adapt; an eighth of `edge` if absent.
    std::optional<double> shortest = std::nullopt;
    /// Only faces in this region change, and not its outline; all if absent.
    std::optional<Region> region = std::nullopt;
    /// Edges whose faces' normals differ by more than this angle, in radians, are lines that are
    /// kept, and so are the corners of lines; pi for none.
    double crease = 40.0 * kDegree;
    /// Rounds of splits, collapses, flips and moves.
    Index iterations = 8;
};

struct RemeshResult {
    Mesh mesh;
    /// From its elements to those of the mesh, whose polygons are triangulated (triangulate.h).
    MeshMap map;
};

/// Returns the surface with triangles of even size (Botsch and Kobbelt 2004; lengths that adapt as
/// Dunyach et al. 2013). Polygons are triangulated first. Each round splits edges longer than 4/3
/// of their length, collapses those shorter than 4/5, flips edges for valences near six, and moves
/// vertices along the surface to the middle of their neighbours. Open borders, seams of corner
/// attributes, outlines of labels and of named regions and creases stay lines: their vertices are
/// on the old ones. Attributes are those of the nearest point of the old surface in the same part
/// between lines. Errors: invalid_argument for lengths that are not above 0, edges longer than the
/// diagonal of the mesh's box, or a negative count; out_of_range, before anything is made, if the
/// lengths ask for more than about 20 million faces and twice those of the mesh; topology_mismatch
/// for a region of another mesh; memory_limit; cancelled.
RemeshResult remesh(const Mesh& mesh, const RemeshOptions& options = {},
                    const Context& context = {});

}  // namespace lissom
