/// Ambient occlusion: how much of its surroundings every visible point is open to, from depths and
/// normals of the picture (McGuire, Mara and Luebke, "Scalable ambient obscurance", 2012).
#pragma once

#include "viewer/render/draw/view_parameters.h"
#include "viewer/render/gl/gpu_scene.h"

namespace lissom {

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
    gl::Framebuffer compute(const GpuScene& scene, const ViewParameters& view,
                            const OcclusionOptions& options) const;

  private:
    gl::Framebuffer draw_geometry(const GpuScene& scene, const ViewParameters& view,
                                  gl::Extent extent) const;
    void blur(const gl::Framebuffer& from, const gl::Framebuffer& to,
              const gl::Framebuffer& geometry, bool along_y, double radius) const;

    gl::Program geometry_, occlusion_, blur_;
    gl::VertexArray no_vertices_;
};

}  // namespace lissom
