/// Measures of a mesh: extents, area, volume, Euler characteristic, normals, and a hash of its
/// content. Areas and integrals of polygons are those of their triangulation (triangulation.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Axis-aligned box around all vertices, or around those of `region`; empty if there are none.
/// Errors: topology_mismatch.
Box bounds(const Mesh& mesh);
Box bounds(const Mesh& mesh, const Region& region);

/// Mean of the positions of the region's vertices. Errors: topology_mismatch; region_empty.
Vec3 center(const Mesh& mesh, const Region& region);

/// Centroid of the surface, weighted by area. Weighted by vertices if the mesh has no area; the
/// origin for a mesh without vertices.
Vec3 surface_centroid(const Mesh& mesh);

/// Size of a mesh: the RMS distance of its surface to the surface's centroid, integrated exactly
/// over each triangle. Turning the mesh does not change it; default lengths derive from it. RMS
/// over the vertices if the mesh has no area.
double surface_radius(const Mesh& mesh);

/// Area of the surface.
double area(const Mesh& mesh);
/// Area of every face.
std::vector<double> face_areas(const Mesh& mesh);

/// Returns the signed volume enclosed by a closed mesh, positive if the faces look outward. For an
/// open mesh each boundary loop is closed by a cone to its mean point, so that the value does not
/// depend on the frame.
double volume(const Mesh& mesh);

/// V - E + F over vertices that have faces.
Index euler_characteristic(const Topology& topology);

/// Handles of the surface, summed over components: (2 c - b - chi) / 2, with boundary loops counted
/// as closed. Vertices without faces do not count.
Index genus(const Topology& topology);

/// Unit normal of a polygon from its vector area; zero if it has no area.
Vec3 polygon_normal(std::span<const Vec3> corners);

/// Angle of a polygon's corner, `before` and `after` being those next to it counter-clockwise,
/// about the polygon's normal; from 0 to 2 pi, so that reflex corners count in full.
double corner_angle(const Vec3& before, const Vec3& corner, const Vec3& after, const Vec3& normal);

/// Unit normal of every face from its vector area; zero for a face without area.
std::vector<Vec3> face_normals(const Mesh& mesh);

/// Unit normal of every vertex: face normals weighted by the angle of the face at the vertex
/// (Thürmer and Wüthrich 1998); zero if no face around the vertex has an area.
std::vector<Vec3> vertex_normals(const Mesh& mesh);

/// Mean length of all edges; 0 without edges.
double mean_edge_length(const Mesh& mesh);

/// Faces whose area is below 1e-14 of their longest edge squared, ascending.
std::vector<Index> zero_area_faces(const Mesh& mesh);

/// 64-bit hash of positions (to the bit), faces, attributes, labels, named regions and material
/// libraries. The same on every platform; equal meshes have equal hashes.
std::uint64_t hash(const Mesh& mesh);

}  // namespace lissom
