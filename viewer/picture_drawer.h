/// Draws a drawing that is on the graphics card into a picture. All of it needs a current context.
#pragma once

#include "viewer/draw/image.h"
#include "viewer/draw/projection.h"
#include "viewer/gl/occlusion.h"
#include "viewer/renderer.h"

namespace lissom {

/// What is made once for all pictures.
struct PictureTools {
    Occlusion occlusion;
    gl::Program surface, line, point, output;
    /// The colour scale in linear values, one row.
    gl::Texture colormap;
    gl::VertexArray no_vertices;

    PictureTools();
};

class PictureDrawer {
  public:
    /// All arguments must outlive the drawer. `occlusion_radius` is in world units.
    PictureDrawer(const PictureTools& tools, const GpuDrawing& drawing, const ViewParameters& view,
                  const RenderOptions& options, double occlusion_radius);

    /// Large pictures are drawn in parts. Errors: memory_limit; cancelled.
    Image draw(Progress& progress) const;

  private:
    struct Targets;

    gl::Framebuffer compute_occlusion(double radius) const;
    Image draw_part(const Tile& tile, const Targets& targets) const;
    void draw_surfaces(const Tile& tile) const;
    void draw_marks(const Tile& tile) const;
    void use_for_marks(const gl::Program& program, const Tile& tile) const;
    void draw_output(const Targets& targets) const;
    Mat4 projection(const Tile& tile) const;

    const PictureTools& tools_;
    const GpuDrawing& drawing_;
    const ViewParameters& view_;
    const RenderOptions& options_;
    gl::Framebuffer openness_;
};

}  // namespace lissom
