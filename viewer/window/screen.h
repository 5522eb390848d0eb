/// Screen: draws a snapshot into the window of the current context, at once and plainly, and shows
/// finished pictures there. All of it needs that context, also to end.
#pragma once

#include "kernel/sketch/camera.h"
#include "viewer/draw/image.h"
#include "viewer/draw/legend.h"
#include "viewer/draw/snapshot.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/gl/gpu_scene.h"
#include "viewer/scene_drawer.h"

namespace lissom::window {

/// A rectangle of a window, in pixels from its top left corner.
struct Canvas {
    int x = 0, y = 0, width = 1, height = 1;

    bool operator==(const Canvas&) const = default;
};

class Screen {
  public:
    Screen();

    /// Becomes what `snapshot` shows; see GpuScene::update.
    Uploads update(const Snapshot& snapshot) {
        return scene_.update(snapshot, {}, MovedVertices::quick);
    }
    /// From now on `legend` stands at the right of what is drawn on a canvas of this height; taken
    /// pictures have their own.
    void set_legend(const std::optional<Legend>& legend, int height, const Color& background);
    /// What the legend leaves free of a canvas.
    Canvas beside_legend(const Canvas& canvas) const;
    /// Draws what `camera` sees beside the legend, with one sample a pixel and without occlusion,
    /// in a picture that is `coarseness` times smaller than `canvas`.
    void draw(const Camera& camera, const Canvas& canvas, const Color& background, int coarseness);
    /// Shows `image` from now on.
    void take(const Image& image);
    /// Copies what was drawn or taken last to `canvas` of a window of this height.
    void show(const Canvas& canvas, int window_height) const;

  private:
    SceneTools tools_;
    GpuScene scene_;
    GpuHairShade no_hair_;
    std::unique_ptr<DrawTarget> target_;
    gl::Framebuffer legend_;
    gl::Framebuffer finished_;
    const gl::Framebuffer* shown_ = nullptr;
};

}  // namespace lissom::window
