/// RenderMap: the vertices that a renderer draws; one vertex of a mesh has several of them if
/// texture coordinates or normals differ from face to face.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/render/tangent_space.h"
#include "kernel/mesh/repair/repair.h"
#include "kernel/mesh/topology.h"

namespace lissom {

struct RenderMap {
    std::shared_ptr<const Topology> topology;
    /// The vertex of the mesh that each render vertex lies on; kNoIndex if it was dropped.
    std::vector<Index> vertex;
    /// The first corner of the mesh at which each render vertex is drawn, or kNoIndex.
    std::vector<Index> corner;
    /// The render vertex at each corner of the mesh.
    std::vector<Index> of_corner;
    /// Group of render vertices that share one normal: those of one vertex, but on a crease.
    std::vector<Index> smooth;
    Index smooth_count = 0;

    Index size() const { return count_of(vertex); }
};

/// Vertices and faces as a vertex buffer holds them. Lists of values are empty or have one entry a
/// vertex.
struct RenderBuffer {
    std::vector<Vec3> positions;
    FaceList faces;
    std::vector<Vec3> normals;
    std::vector<Vec2> uvs;
};

/// A mesh, and where each vertex of a buffer lies on it.
struct WeldedBuffer {
    Mesh mesh;
    RenderMap map;
};

/// Normals at one vertex that differ by more than this angle are a crease.
inline constexpr double kCreaseAngle = 0.0175;

/// Returns the mesh of a buffer by `repair`, with the attributes "normal" and "uv" if they are
/// given. Render vertices of faces that were dropped lie on the vertex at their place, if there is
/// one. Errors: as repair.
WeldedBuffer weld_buffer(RenderBuffer buffer, const RepairOptions& options = {},
                         const Context& context = {});

/// Returns the render vertices that a mesh needs: one for each vertex and each set of different
/// values at its corners. Where tangents differ, vertices are apart too: between faces with
/// mirrored texture coordinates, and between the fans of faces that seams part at a vertex. Errors:
/// cancelled; memory_limit.
RenderMap render_map(const Mesh& mesh, const Context& context = {});

/// Returns the triangles of `mesh` between render vertices. Errors: topology_mismatch.
std::vector<Triangle> render_triangles(const RenderMap& map, const Mesh& mesh);

/// Returns the unit normals of the present shape, weighted by the angles of faces; zero for render
/// vertices without a face. Errors: topology_mismatch.
std::vector<Vec3> render_normals(const RenderMap& map, const Mesh& mesh);

/// Makes `normals` the same in the memory that it and `sums` have; the content of `sums` is lost.
void find_render_normals(const RenderMap& map, const Mesh& mesh, std::vector<Vec3>& sums,
                         std::vector<Vec3>& normals);

/// Returns the tangents of the present shape by MikkTSpace's rule, for the texture coordinates
/// `uv`, an attribute of two numbers a vertex or corner. Errors: topology_mismatch; out_of_range
/// without such an attribute.
std::vector<Tangent> render_tangents(const RenderMap& map, const Mesh& mesh, std::string_view uv);

}  // namespace lissom
