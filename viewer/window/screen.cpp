#include "viewer/window/screen.h"

#include <algorithm>

namespace lissom::window {

Screen::Screen() : no_hair_(upload_shade(nullptr)) {}

void Screen::draw(const Camera& camera, const Canvas& canvas, const Color& background,
                  int coarseness) {
    RenderOptions options;
    options.width = std::max(canvas.width / coarseness, 1);
    options.height = std::max(canvas.height / coarseness, 1);
    options.background = background;
    options.samples = 1;
    options.occlusion = 0.0;
    const gl::Extent extent{options.width, options.height};
    if (!target_ || !(target_->output.extent() == extent)) {
        shown_ = nullptr;
        target_ = std::make_unique<DrawTarget>(extent, options);
    }
    const double aspect = 1.0 * options.width / options.height;
    const SceneView view = see(scene_, camera, aspect);
    const SceneDrawer drawer(tools_, scene_, no_hair_, view, options);
    drawer.draw({0, 0, options.width, options.height}, *target_);
    shown_ = &target_->output;
}

void Screen::take(const Image& image) {
    const gl::Extent extent{image.width, image.height};
    if (!(finished_.extent() == extent)) {
        finished_ = gl::Framebuffer::texture(extent, GL_RGBA8, false);
    }
    glBindTexture(GL_TEXTURE_2D, finished_.color());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.rgba.data());
    shown_ = &finished_;
}

void Screen::show(const Canvas& canvas, int window_height) const {
    if (!shown_) return;
    shown_->copy_to_window(canvas.x, window_height - canvas.y - canvas.height,
                           {canvas.width, canvas.height});
}

}  // namespace lissom::window
