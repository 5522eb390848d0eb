/// The polygons of a glTF primitive; private to kernel/io.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Shapes made by the vertices of a primitive.
enum class PrimitiveShape { points, lines, faces };

/// Returns the shape of a mode of glTF, 0 to 6. Errors: file_syntax for others.
PrimitiveShape shape_of_mode(int mode);

/// Joining of the vertices of a primitive.
struct PrimitiveJoin {
    /// Mode of the primitive: one of those with faces.
    int mode = 4;
    /// Triangles in a row that share their first vertex are a polygon (FB_ngon_encoding).
    bool has_polygons = false;
};

/// Polygons of the vertices `indices`. Triangles of strips without area, which join strips, are
/// left out; vertices that make no triangle are added to `left_over`.
FaceList join_primitive(std::vector<Index> indices, const PrimitiveJoin& join,
                        std::size_t& left_over);

/// Returns the polygon that `count` faces from `first` on make together, from the first vertex of
/// the first of them on. False if they make none.
bool outline_of(const FaceList& faces, Index first, Index count, std::vector<Index>& outline);

}  // namespace lissom
