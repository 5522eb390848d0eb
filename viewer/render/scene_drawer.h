/// Draws a scene that is on the graphics card into a picture. All of it needs a current context.
#pragma once

#include <array>
#include <optional>

#include "viewer/render/draw/image/image.h"
#include "viewer/render/draw/projection.h"
#include "viewer/render/draw/render_options.h"
#include "viewer/render/gl/gpu_scene.h"
#include "viewer/render/gl/hair_shadow.h"
#include "viewer/render/gl/occlusion.h"
#include "viewer/render/scene_view.h"

namespace lissom {

/// Optional features of the surface shader.
struct SurfaceParts {
    bool occlusion = false, hair = false, wire = false, values = false;
};

/// The programs that draw surfaces, each made when it is first asked for: drivers take long.
class SurfacePrograms {
  public:
    const gl::Program& get(const SurfaceParts& parts) const;

  private:
    mutable std::array<std::optional<gl::Program>, 16> programs_;
};

/// Objects made once for all pictures.
struct SceneTools {
    SurfacePrograms surface;
    gl::Program line, point, output, strand_output;
    /// The colour scale in linear values, one row.
    gl::Texture colormap;
    gl::VertexArray no_vertices;

    SceneTools();
    /// Made when it is first asked for.
    const Occlusion& occlusion() const;

  private:
    mutable std::optional<Occlusion> occlusion_;
};

/// Framebuffers that a part of a picture passes through; the finished pixels are in `output`, rows
/// from the top.
struct DrawTarget {
    /// `samples` if there are several of them, else all is drawn into `picture`.
    gl::Framebuffer samples, picture, output;

    bool has_samples() const { return samples.extent().width > 0; }
    const gl::Framebuffer& drawn() const { return has_samples() ? samples : picture; }

    /// `extent` in pixels of the picture. Errors: memory_limit.
    DrawTarget(gl::Extent extent, const RenderOptions& options);
};

/// Returns the pixels of an output.
Image read_pixels(const gl::Framebuffer& from);

/// Draws the meshes and overlays of a scene as one camera sees them.
class SceneDrawer {
  public:
    /// All arguments must outlive the drawer.
    SceneDrawer(const SceneTools& tools, const GpuScene& scene, const GpuHairShade& hair,
                const SceneView& view, const RenderOptions& options);

    /// A part of the picture, whose size is that of `target`.
    void draw(const Tile& tile, const DrawTarget& target) const;
    /// Draws in two steps, between which strands are drawn into `target.drawn()`, which is bound
    /// meanwhile. Without supersampling.
    void draw_samples(const Tile& tile, const DrawTarget& target) const;
    void finish_with_strands(const DrawTarget& target) const;
    /// Returns the projection from view space to that part.
    Mat4 projection(const Tile& tile) const;
    /// All of it; large pictures are drawn in parts. Errors: memory_limit; cancelled.
    Image picture(Progress& progress) const;

  private:
    // Empty if there is none.
    gl::Framebuffer compute_occlusion() const;
    void draw_surfaces(const Tile& tile) const;
    SurfaceParts parts() const;
    void use_occlusion(const gl::Program& program, const Tile& tile) const;
    void use_hair(const gl::Program& program) const;
    void draw_through(const gl::Program& program, const GpuSurface& surface) const;
    void draw_marks(const Tile& tile) const;
    // Pixels drawn for one that styles count in.
    double mark_scale() const;
    void use_for_marks(const gl::Program& program, const Tile& tile) const;
    void finish(const DrawTarget& target, const gl::Program& output) const;
    void draw_output(const DrawTarget& target, const gl::Program& program) const;

    const SceneTools& tools_;
    const GpuScene& scene_;
    const GpuHairShade& hair_;
    const SceneView& view_;
    const RenderOptions& options_;
    gl::Framebuffer openness_;
};

/// Returns the picture of a scene with all that it has, strands too. Errors: those of view_strands;
/// memory_limit; cancelled.
Image draw_scene(const SceneTools& tools, const GpuScene& scene, const Camera& camera,
                 const RenderOptions& options, const Context& context = {});

}  // namespace lissom
