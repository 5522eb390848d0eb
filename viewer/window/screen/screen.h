/// Screen: draws a snapshot into the window of the current context, at once and plainly, and shows
/// finished pictures there. All of it needs that context, also to end.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernel/sketch/camera.h"
#include "viewer/render/draw/image/image.h"
#include "viewer/render/draw/legend.h"
#include "viewer/render/draw/snapshot.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/render/gl/gpu_hair.h"
#include "viewer/render/gl/gpu_scene.h"
#include "viewer/render/scene_drawer.h"
#include "viewer/window/screen/canvas.h"
#include "viewer/window/screen/fill.h"

namespace lissom::window {

class Screen {
  public:
    Screen();
    ~Screen();

    /// Shows `snapshot` from now on; see GpuScene::update.
    Uploads update(const Snapshot& snapshot, std::span<const PreparedSurface> prepared = {}) {
        return scene_.update_with(prepared, snapshot, {}, MovedVertices::quick);
    }
    /// Returns the needs of `update` for it; see GpuScene.
    std::vector<SurfaceNeeds> needs(const Snapshot& snapshot) const {
        return scene_.needs(snapshot);
    }
    /// Set the strands of the shown picture, and the light for one camera; see GpuHair. Return the
    /// bytes sent.
    std::size_t set_hair(const Hair& hair) { return hair_.update(hair); }
    std::size_t direct_light(std::span<const std::uint8_t> light) { return hair_.direct(light); }
    const GpuHair& hair() const { return hair_; }
    /// Sets the legend at the right of pictures on a canvas of this height; taken pictures have
    /// their own.
    void set_legend(const std::optional<Legend>& legend, int height, const Color& background);
    /// Returns the part of a canvas beside the legend.
    Canvas beside_legend(const Canvas& canvas) const;
    /// Draws the view of `camera` beside the legend, with one sample a pixel and without occlusion,
    /// in a picture that is `coarseness` times smaller than `canvas`. Strands are limited to those
    /// drawn in a moment. A fill that is going on ends.
    void draw(const Camera& camera, const Canvas& canvas, const Color& background, int coarseness);
    /// Begins to draw the picture of `draw` again, with smooth edges and more and more strands. If
    /// `longest` seconds are not enough for all, the last picture has as many as they are enough
    /// for.
    void begin_fill(const Camera& camera, const Canvas& canvas, const Color& background,
                    double longest);
    /// Draws the next slice of that; whether a picture is finished, which is shown from now on.
    bool fill();
    /// Returns whether a fill goes on.
    bool filling() const { return filling_ != nullptr; }
    /// Seconds that the last slice took, and that the strands of the last moving picture took.
    double slice_seconds() const { return slice_seconds_; }
    double moving_seconds() const { return moving_seconds_; }
    /// Strands that stood for all in that.
    Index moving_strands() const { return moving_; }
    /// Shows `image` from now on.
    void take(const Image& image);
    /// Reads back the shown picture, without the legend: for tests.
    Image picture() const;
    /// Another number: `show` shows something else.
    std::uint64_t version() const { return version_; }
    /// Copies the picture drawn or taken last to `canvas` of a window of this height.
    void show(const Canvas& canvas, int window_height) const;

  private:
    struct Filling;
    RenderOptions options_of(const Canvas& canvas, const Color& background, int coarseness) const;
    HairView hair_view(const SceneView& view) const;
    Index wide_strands(const SceneView& view, int height, Index most, double least) const;
    Index moving_strands(const SceneView& view, int height) const;
    Index filled_strands(const SceneView& view, const RenderOptions& options) const;
    void draw_moving_hair(const HairView& view, Index count);

    SceneTools tools_;
    GpuScene scene_;
    GpuHair hair_;
    int max_samples_ = 1;
    std::unique_ptr<DrawTarget> target_;
    Index moving_ = 0;
    StrandPace moving_pace_, fill_pace_;
    double slice_seconds_ = 0.0, moving_seconds_ = 0.0;
    std::unique_ptr<Filling> filling_;
    gl::Framebuffer legend_;
    gl::Framebuffer filled_, finished_;
    const gl::Framebuffer* shown_ = nullptr;
    std::uint64_t version_ = 0;
};

}  // namespace lissom::window
