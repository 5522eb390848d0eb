/// A drawing on the graphics card. All of it needs a current context, also to end.
#pragma once

#include <vector>

#include "viewer/drawing.h"
#include "viewer/gl_objects.h"
#include "viewer/surface_arrays.h"

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

struct GpuDrawing {
    std::vector<GpuSurface> surfaces;
    /// One instance a segment.
    GpuArray lines;
    /// One instance a point.
    GpuArray points;

    void draw_lines() const;
    void draw_points() const;
};

/// Uploads `drawing`, moved so that `origin` is at zero.
/// Errors: those of build_surface; memory_limit; cancelled.
GpuDrawing upload(const Drawing& drawing, const Vec3& origin, const Context& context);

}  // namespace lissom
