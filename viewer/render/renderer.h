/// Renderer: pictures of snapshots, drawn with OpenGL into framebuffers of its own: no window, no
/// display; strands over them without OpenGL. A picture is one update of a GpuScene and one
/// draw_scene; a caller that draws a scene many times keeps it and calls these.
#pragma once

#include <memory>
#include <string>

#include "kernel/sketch/camera.h"
#include "viewer/render/draw/image/image.h"
#include "viewer/render/draw/render_options.h"
#include "viewer/render/draw/snapshot.h"
#include "viewer/render/gl/platform.h"

namespace lissom {

class Renderer {
  public:
    /// Errors: no_display; internal if the driver refuses a shader.
    explicit Renderer(std::unique_ptr<Platform> platform = make_egl_platform());
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    /// Returns the picture of `snapshot` as `camera` sees it. The same input gives the same pixels
    /// on the same driver. May be called on any thread, by one at a time. Errors: invalid_argument
    /// and out_of_range for options; those of GpuScene::update and view_strands; memory_limit;
    /// no_display if the context is in use on another thread; cancelled.
    Image render(const Snapshot& snapshot, const Camera& camera, const RenderOptions& options = {},
                 const Context& context = {});

    /// Throws if `options` cannot be drawn: invalid_argument, out_of_range.
    void require_valid(const RenderOptions& options) const;
    /// Most pixels along a side of a picture.
    int maximum_size() const;
    /// Most samples a pixel.
    int maximum_samples() const;
    /// Returns the name of the OpenGL renderer, for instance "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& driver() const;

  private:
    Image render_solid(const Snapshot& snapshot, const Camera& camera, const RenderOptions& options,
                       const Context& context);

    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
