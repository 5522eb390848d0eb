/// A drawing on the graphics card. All of it needs a current context, also to end.
#pragma once

#include <vector>

#include "viewer/draw/drawing.h"
#include "viewer/draw/surface_arrays.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/strands/strand_shadow.h"

namespace lissom {

/// Vertices in a buffer, and how they are read.
struct GpuArray {
    gl::VertexArray layout;
    gl::Buffer buffer;
    GLsizei count = 0;
};

/// Triangles of one mesh.
struct GpuSurface {
    GpuArray triangles;
    /// Pixels of the picture; 0 is none.
    double wire_width = 0.0;
    Color wire_color = kWireColor;

    void draw() const;
};

/// What strands do to the light on surfaces, and to the colour of a scalp.
struct GpuHairShade {
    /// Key light and light from all around that is left, and how much hair grows; see
    /// StrandShadow::on_meshes. One texel of no hair where there are no strands.
    gl::Texture volume;
    /// From view space to the volume's texture coordinates: scale, then offset.
    Vec3 scale = Vec3::Zero();
    Vec3 offset = Vec3::Zero();
    /// In view units: between grid points; 0 where there are no strands.
    double step = 0.0;
    /// Linear.
    Vec3 scalp_color = Vec3::Zero();
};

struct GpuDrawing {
    std::vector<GpuSurface> surfaces;
    /// One instance a segment.
    GpuArray lines;
    /// One instance a point.
    GpuArray points;
    GpuHairShade hair;

    void draw_lines() const;
    void draw_points() const;
};

/// Uploads `drawing`, moved so that `origin` is at zero.
/// Errors: those of build_surface; memory_limit; cancelled.
GpuDrawing upload(const Drawing& drawing, const Vec3& origin, const Context& context);

/// The shade of hair; without strands where `shadow` is null.
GpuHairShade upload_shade(const StrandShadow* shadow);

}  // namespace lissom
