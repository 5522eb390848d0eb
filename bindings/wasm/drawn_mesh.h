/// The corners of a mesh as WebGL draws them; private to bindings/wasm.
#pragma once

#include <cstdint>
#include <vector>

#include "bindings/c/lissom.h"

namespace lissom::wasm {

/// Three corners a triangle, none of which is shared.
struct DrawnMesh {
    /// Triples, one a corner. Normals are of unit length, smooth but for creases.
    std::vector<float> positions, normals;
    /// The vertex of each corner, from 0.
    std::vector<std::uint32_t> vertices;
    /// One byte a corner: 1 if the edge opposite it is an edge of a face, 0 if it divides one.
    std::vector<std::uint8_t> edges;
};

/// Reads a mesh. Faces that meet at more than `crease` degrees keep a sharp edge. Errors: those of
/// lissom_mesh_read_positions.
lissom_status draw_mesh(lissom_context* context, lissom_mesh mesh, double crease, DrawnMesh& drawn);

/// Returns the metres of a unit of `mesh`: how much larger the roots of `strands` lie apart than
/// the places on its faces that they name. 0 if they name none.
double root_unit(lissom_context* context, lissom_strands strands, lissom_mesh mesh);

}  // namespace lissom::wasm
