/// Vertex data of a mesh for the graphics card.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernel/mesh/measure/triangulation.h"
#include "viewer/render/draw/drawing.h"

namespace lissom {

/// One corner of a triangle, as it lies in the vertex buffers: the moving part and the constant
/// one.
struct SurfaceVertex {
    std::array<float, 3> position;
    std::array<float, 3> normal;
};
struct SurfaceColor {
    /// Color in sRGB.
    std::array<std::uint8_t, 4> color;
    /// Place on the colour scale: 0 is its low end, 1 the high.
    float value;
    /// Bits of the triangle: see below.
    std::uint32_t flags;
};

/// Bit i: the side opposite to the triangle's corner i is an edge of the polygon.
inline constexpr std::uint32_t kEdgeFlags = 7;
/// The triangle has the colours of the scale.
inline constexpr std::uint32_t kValueFlag = 8;

/// The triangles that a mesh is drawn as.
struct SurfaceTriangles {
    std::shared_ptr<const Triangulation> faces;
    /// The space that is drawn is the mesh's in a mirror: triangles are turned round, so that the
    /// outside stays outside.
    bool mirrored = false;

    /// Returns whether both have the same corners in the same order.
    bool same_as(const SurfaceTriangles& other) const;
};

/// Vertices, if the picture has them.
std::vector<Vec3> picture_positions(const Mesh& mesh, const Affine& to_picture);

/// Returns the triangles of `mesh` at `positions`. Data of `known`, of the same topology, is reused
/// if moving vertices cannot change it; may be null.
SurfaceTriangles surface_triangles(const Mesh& mesh, std::span<const Vec3> positions,
                                   const Affine& to_picture, const SurfaceTriangles* known);

/// Three entries a triangle, in the mesh's order of faces.
std::vector<SurfaceVertex> surface_vertices(const Mesh& mesh, const MeshStyle& style,
                                            std::span<const Vec3> positions,
                                            const SurfaceTriangles& triangles,
                                            const Context& context = {});

/// Returns the colours of the same triangles. Errors: topology_mismatch for a region or handle of
/// another mesh; invalid_argument if the number of values is not that of vertices.
std::vector<SurfaceColor> surface_colors(const Mesh& mesh, const MeshStyle& style,
                                         const ValueRange& range, const SurfaceTriangles& triangles,
                                         const Context& context = {});

/// Return whether surface_vertices gives the same of both; likewise surface_colors, if the
/// triangles are the same; likewise build_marks.
bool same_vertices(const DrawnMesh& a, const DrawnMesh& b);
bool same_colors(const DrawnMesh& a, const DrawnMesh& b);
bool same_marks(const DrawnMesh& a, const DrawnMesh& b);

/// Lines and points that the style asks for, in the world of the camera: boundary loops, normals,
/// and the vertices of handles and parts that hold no face.
Overlay build_marks(const DrawnMesh& drawn);

}  // namespace lissom
