#include "viewer/window/screen.h"

#include <algorithm>

#include "viewer/draw/overlay.h"

namespace lissom::window {
namespace {

void upload(const Image& image, gl::Framebuffer& to) {
    const gl::Extent extent{image.width, image.height};
    if (!(to.extent() == extent)) to = gl::Framebuffer::texture(extent, GL_RGBA8, false);
    glBindTexture(GL_TEXTURE_2D, to.color());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                    image.rgba.data());
}

void copy(const gl::Framebuffer& from, const Canvas& canvas, int window_height) {
    from.copy_to_window(canvas.x, window_height - canvas.y - canvas.height,
                        {canvas.width, canvas.height});
}

}  // namespace

Screen::Screen() : no_hair_(upload_shade(nullptr)) {}

void Screen::set_legend(const std::optional<Legend>& legend, int height, const Color& background) {
    legend_ = {};
    if (!legend) return;
    Image strip(legend_width(*legend, height), height);
    fill_rectangle(strip, 0, 0, strip.width, strip.height, background);
    draw_legend(strip, *legend, ink_on(background));
    upload(strip, legend_);
}

Canvas Screen::beside_legend(const Canvas& canvas) const {
    return {canvas.x, canvas.y, std::max(canvas.width - legend_.extent().width, 1), canvas.height};
}

void Screen::draw(const Camera& camera, const Canvas& whole, const Color& background,
                  int coarseness) {
    const Canvas canvas = beside_legend(whole);
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
    upload(image, finished_);
    shown_ = &finished_;
}

void Screen::show(const Canvas& canvas, int window_height) const {
    if (!shown_) return;
    if (shown_ == &finished_) return copy(finished_, canvas, window_height);
    const Canvas beside = beside_legend(canvas);
    copy(*shown_, beside, window_height);
    const int strip = canvas.width - beside.width;
    if (legend_.extent().width == 0) return;
    copy(legend_, {canvas.x + beside.width, canvas.y, strip, canvas.height}, window_height);
}

}  // namespace lissom::window
