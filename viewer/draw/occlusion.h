/// Ambient occlusion: how much of its surroundings every visible point is open to, from depths and
/// normals of the picture (McGuire, Mara and Luebke, "Scalable ambient obscurance", 2012).
#pragma once

#include "viewer/gl/gpu_drawing.h"

namespace lissom {

/// What the passes need to know about the camera.
struct ViewParameters {
    /// Picture space to view space, and that to clip space for the whole picture.
    Mat4 view = Mat4::Identity();
    Mat4 projection = Mat4::Identity();
    /// Half the width and height of what is seen, in world units; at depth 1 with perspective.
    Vec2 half_extent = Vec2::Ones();
    bool perspective = true;
    double near = 0.1;
};

struct OcclusionOptions {
    gl::Extent extent;
    /// World units within which surfaces darken each other.
    double radius = 0.1;
    /// 0 to 1.
    double strength = 1.0;
};

class Occlusion {
  public:
    Occlusion();

    /// Texture with the openness (1: nothing near) and the depth of every pixel; depth 0 is
    /// background.
    gl::Framebuffer compute(const GpuDrawing& drawing, const ViewParameters& view,
                            const OcclusionOptions& options) const;
    /// The same where nothing darkens: one texel.
    gl::Framebuffer none() const;

  private:
    gl::Framebuffer draw_geometry(const GpuDrawing& drawing, const ViewParameters& view,
                                  gl::Extent extent) const;
    void blur(const gl::Framebuffer& from, const gl::Framebuffer& to,
              const gl::Framebuffer& geometry, bool along_y, double radius) const;

    gl::Program geometry_, occlusion_, blur_;
    gl::VertexArray no_vertices_;
};

}  // namespace lissom
