/// The corners of a mesh as WebGL draws them; private to bindings/wasm.
#pragma once

#include <array>
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

/// A mesh whose faces are triangles by now.
struct Surface {
    std::vector<double> positions;
    std::vector<std::uint32_t> corners;
    /// The face of each triangle.
    std::vector<std::uint32_t> face;
    /// Of the faces of triangles, of unit length; zero without area.
    std::vector<std::array<double, 3>> normals;
    /// Corners by their vertex: those of vertex v begin at first[v].
    std::vector<std::uint32_t> first, around;
};

/// A mesh as it was read last. Before the first reading it is no mesh.
struct KeptMesh {
    Surface surface;
    /// Degrees.
    double crease = -1.0;
    std::int32_t faces = -1;
};

enum class MeshChange { none, places, all };

/// Reads a mesh that may have changed since the reading `kept`, which is then this one. Fills all
/// lists after a change of faces, positions, normals and vertices after one of places, none
/// otherwise. Errors: as draw_mesh.
lissom_status draw_change(lissom_context* context, lissom_mesh mesh, double crease, KeptMesh& kept,
                          DrawnMesh& drawn, MeshChange& change);

/// Returns the metres of a unit of `mesh`: how much larger the roots of `strands` lie apart than
/// the places on its faces that they name. 0 if they name none.
double root_unit(lissom_context* context, lissom_strands strands, lissom_mesh mesh);

}  // namespace lissom::wasm
