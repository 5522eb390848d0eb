#include "kernel/mesh/fill/fill.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "kernel/mesh/derive.h"
#include "kernel/mesh/fill/fairing.h"
#include "kernel/mesh/fill/hole_patch.h"
#include "kernel/mesh/fill/hole_triangulation.h"
#include "kernel/mesh/half_edges.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/morph_maps.h"

namespace lissom {
namespace {

constexpr double kFold = 150.0 * kPi / 180.0;

// The hole's outline in the direction of the faces that will close it: against those around it.
std::vector<Index> outline_of(const Mesh& mesh, const Path& boundary) {
    if (boundary.on_mesh()) require_same_topology(mesh, boundary.topology(), "the boundary");
    if (!boundary.is_boundary()) {
        throw Error(ErrorCode::invalid_argument,
                    "only an open boundary of the mesh can be filled; take one of its boundaries");
    }
    const Index smallest =
        *std::min_element(boundary.vertices().begin(), boundary.vertices().end());
    for (const std::vector<Index>& loop : mesh.topology().boundary_loops()) {
        if (loop[0] == smallest) return {loop.rbegin(), loop.rend()};
    }
    throw Error(ErrorCode::internal, "a boundary has no loop");
}

Mesh closed_mesh(const HolePatch& patch, const Context& context) {
    const Mesh& mesh = patch.mesh();
    const Topology& topology = mesh.topology();
    FaceList faces = topology.faces();
    MeshMap map{ElementMap::identity(mesh.vertex_count()),
                ElementMap::identity(topology.corner_count()),
                ElementMap::identity(mesh.face_count())};
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Index v = 0; v < patch.new_vertex_count(); ++v) {
        positions.push_back(patch.new_positions()[v]);
        map.vertices.add_blend(patch.sources(v));
    }
    for (const Triangle& t : patch.triangles()) {
        faces.add(t);
        map.faces.add_new();
        for (int k = 0; k < 3; ++k) map.corners.add_new();
    }
    Mesh result = derive(mesh, std::move(positions), std::move(faces), map, context);
    set_morphs(result, mapped_morphs(mesh, [&](std::vector<Vec3> x) {
                   return patch.with_middles(std::move(x));
               }));
    return result;
}

Index folded_edges(const Mesh& mesh, Index first_face) {
    const OpenMesh::PolyConnectivity& halfedges = mesh.topology().halfedges();
    const std::vector<Vec3> normals = face_normals(mesh);
    Index count = 0;
    for (Index e = 0; e < mesh.topology().edge_count(); ++e) {
        const Index left = halfedges.face_handle(OpenMesh::HalfedgeHandle(2 * e)).idx();
        const Index right = halfedges.face_handle(OpenMesh::HalfedgeHandle(2 * e + 1)).idx();
        if (left < 0 || right < 0 || std::max(left, right) < first_face) continue;
        count += normals[left].dot(normals[right]) < std::cos(kFold);
    }
    return count;
}

void require_fill(const FillOptions& options) {
    if (options.maximum_vertices < 0) {
        throw Error(ErrorCode::invalid_argument, "maximum_vertices must be 0 or more");
    }
    if (!(options.density > 0.0) || !std::isfinite(options.density)) {
        throw Error(ErrorCode::invalid_argument, "the density of a patch must be above 0");
    }
}

}  // namespace

FillReport fill(Mesh& mesh, const Path& boundary, const FillOptions& options,
                const Context& context) {
    const std::vector<Index> outline = outline_of(mesh, boundary);
    require_fill(options);
    Progress progress(context, "fill");
    const MemoryCharge working = context.charge(2 * mesh.memory_bytes(), "filling a hole");
    FillReport report;
    report.loop_size = count_of(outline);
    report.first_vertex = mesh.vertex_count();
    report.first_face = mesh.face_count();

    progress.step(0.4);
    HolePatch patch(mesh);
    if (options.method == FillMethod::area) {
        triangulate_hole_by_area(patch, outline, context);
    } else {
        report.parts = triangulate_hole(patch, outline, context);
    }
    progress.step(0.3);
    if (options.subdivide) {
        report.limit_reached =
            !patch.refine(outline, options.density, options.maximum_vertices, context);
    }
    report.vertex_count = patch.new_vertex_count();
    report.face_count = count_of(patch.triangles());
    Mesh filled = closed_mesh(patch, context);
    progress.step(0.3);
    if (options.fair) {
        std::vector<Index> added(report.vertex_count);
        std::iota(added.begin(), added.end(), report.first_vertex);
        fair(filled, Region(filled.shared_topology(), std::move(added)), options.continuity,
             context);
    }
    report.folded_edges = folded_edges(filled, report.first_face);
    mesh.replace_by(std::move(filled));
    return report;
}

}  // namespace lissom
