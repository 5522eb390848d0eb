/// Decimation: fewer triangles for nearly the same surface.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct DecimateOptions {
    /// Number of faces wanted, at least 1; as many as there are if absent.
    std::optional<Index> faces = std::nullopt;
    /// Greatest error of one collapse, a length: the root of the mean squared distance to the
    /// planes of the triangles that it replaces. No limit if absent.
    std::optional<double> error = std::nullopt;
    /// Only edges whose faces are all in this region collapse; all if absent.
    std::optional<Region> region = std::nullopt;
    /// Edges whose faces' normals differ by more than this angle, in radians, are lines that are
    /// kept; pi for none. Creases lower than that are kept as well as their error asks for.
    double crease = kPi;
    /// Weight of attributes: a difference as great as the range of an attribute counts as this part
    /// of the size of the mesh; 0 ignores attributes.
    double attributes = 0.1;
    /// Vertices of open borders stay.
    bool keep_borders = false;
};

struct DecimateResult {
    Mesh mesh;
    /// From its elements to those of the mesh, whose polygons are triangulated (triangulate.h).
    MeshMap map;
    /// Greatest error of a collapse that was made, as in DecimateOptions.
    double error = 0.0;
};

/// Returns the mesh with fewer faces: the edges with the least quadric error collapse first
/// (Garland and Heckbert 1997), with the error of attributes (Hoppe 1999). Polygons are
/// triangulated first. Open borders, seams of texture coordinates and of other corner attributes,
/// outlines of labels and of named regions stay lines and are thinned out along themselves; their
/// branches and ends stay. No triangle turns by more than 78 degrees in one collapse, and the
/// topology stays. Vertices on lines keep their attributes; others take those of the nearest point
/// of the mesh in the same part between lines, morph targets and skins too. If those lines
/// need more faces than were wanted, there are more. Errors: invalid_argument without a limit,
/// for no faces or a negative error or weight; topology_mismatch for a region of another mesh;
/// memory_limit; cancelled.
DecimateResult decimate(const Mesh& mesh, const DecimateOptions& options,
                        const Context& context = {});

}  // namespace lissom
