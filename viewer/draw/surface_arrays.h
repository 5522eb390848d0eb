/// What the graphics card is given of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "viewer/draw/drawing.h"

namespace lissom {

/// One corner of a triangle, as it lies in the vertex buffer.
struct SurfaceVertex {
    std::array<float, 3> position;
    std::array<float, 3> normal;
    /// Colour in sRGB.
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

/// Three entries a triangle, in the mesh's order of faces; `to_picture` maps the mesh to the space
/// that is drawn. Where it mirrors, triangles are turned round so that the outside stays outside.
/// Errors: topology_mismatch for a region or handle of another mesh; invalid_argument where the
/// number of values is not that of vertices.
std::vector<SurfaceVertex> build_surface(const Mesh& mesh, const MeshStyle& style,
                                         const Affine& to_picture, const ValueRange& range,
                                         const Context& context = {});

/// Lines and points that the style asks for, in the world of the camera.
struct SurfaceMarks {
    std::vector<DrawnLine> lines;
    std::vector<DrawnPoint> points;
};

/// Boundary loops, and the vertices of handles that hold no face.
SurfaceMarks build_marks(const DrawnMesh& drawn);

}  // namespace lissom
