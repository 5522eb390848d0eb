#include "viewer/window/screen/screen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "kernel/core/clock.h"
#include "viewer/render/draw/image/overlay.h"

namespace lissom::window {
namespace {

// Seconds of a moving picture that its strands may take, and of a slice.
constexpr double kMovingAim = 0.012;
constexpr double kSliceAim = 0.014;
// With its first slice the driver makes its program, which takes as long as a slice.
constexpr Index kFirstSlice = 25;
constexpr int kFillSamples = 8;
// However slow the driver is: fewer would be strips of paper.
constexpr Index kFewestMoving = 800;
// Strands that are drawn in any case, and pixels that they are wide while something moves: narrower
// ones break into dots without smooth edges.
constexpr Index kMinStrands = 300;
constexpr double kMovingWidth = 1.0;
// With fewer samples strands are drawn that are so many pixels wide, and so many fewer.
constexpr int kAllSamples = 8;
constexpr double kFilledWidth = 0.35;

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

// A picture that is filled with strands.
struct Screen::Filling {
    Filling(Screen& screen, const Camera& seen_from, const RenderOptions& given, double longest)
        : camera(seen_from),
          options(given),
          view(see(screen.scene_, camera, 1.0 * options.width / options.height)),
          hair_view(screen.hair_view(view)),
          shade(screen.hair_.shade(hair_view)),
          target({options.width, options.height}, options),
          drawer(screen.tools_, screen.scene_, shade, view, options),
          fill(screen.filled_strands(view, options), screen.moving_, longest) {}

    Tile tile() const { return {0, 0, options.width, options.height}; }

    Camera camera;
    RenderOptions options;
    SceneView view;
    HairView hair_view;
    GpuHairShade shade;
    DrawTarget target;
    SceneDrawer drawer;
    Fill fill;
};

Screen::Screen() : moving_pace_(kMovingAim), fill_pace_(kSliceAim, kFirstSlice) {
    GLint samples = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &samples);
    max_samples_ = std::clamp(static_cast<int>(samples), 1, kFillSamples);
}

Screen::~Screen() = default;

void Screen::set_legend(const std::optional<Legend>& legend, int height, const Color& background) {
    ++version_;
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

RenderOptions Screen::options_of(const Canvas& canvas, const Color& background,
                                 int coarseness) const {
    RenderOptions options;
    options.width = std::max(canvas.width / coarseness, 1);
    options.height = std::max(canvas.height / coarseness, 1);
    options.background = background;
    options.samples = 1;
    options.mark_scale = 1.0 / coarseness;
    options.occlusion = 0.0;
    return options;
}

HairView Screen::hair_view(const SceneView& view) const {
    return {view.parameters, view.parameters.projection, scene_.origin()};
}

// `most`, or fewer that are so many pixels wide.
Index Screen::wide_strands(const SceneView& view, int height, Index most, double least) const {
    Index count = most;
    const ViewParameters& seen = view.parameters;
    const Vec3 middle = (seen.view * (hair_.middle() - scene_.origin()).homogeneous()).head<3>();
    const double depth = seen.perspective ? std::max(-middle.z(), seen.near) : 1.0;
    const double pixels = 0.5 * height / (seen.half_extent.y() * depth);
    while (count > kMinStrands && hair_.width(1.0 * count / hair_.size()) * pixels < least) {
        count -= count / 16;
    }
    return count;
}

// Returns as many strands as are drawn in time, and can be seen.
Index Screen::moving_strands(const SceneView& view, int height) const {
    Index count = std::min(std::max(moving_pace_.count(), kFewestMoving), hair_.size());
    if (!hair_.complete()) {
        count = std::min(count, static_cast<Index>(hair_.few() * hair_.size()));
    }
    return wide_strands(view, height, count, kMovingWidth);
}

Index Screen::filled_strands(const SceneView& view, const RenderOptions& options) const {
    if (options.samples >= kAllSamples) return hair_.size();
    return wide_strands(view, options.height, hair_.size(), kFilledWidth);
}

void Screen::draw_moving_hair(const HairView& view, Index count) {
    moving_ = count;
    glFinish();
    const auto start = Clock::now();
    const double share = 1.0 * count / hair_.size();
    hair_.draw(view, {0.0, share, share, true});
    glFinish();
    moving_seconds_ = seconds_since(start);
    moving_pace_.add(count, moving_seconds_);
}

void Screen::draw(const Camera& camera, const Canvas& whole, const Color& background,
                  int coarseness) {
    filling_ = nullptr;
    const RenderOptions options = options_of(beside_legend(whole), background, coarseness);
    const gl::Extent extent{options.width, options.height};
    if (!target_ || !(target_->output.extent() == extent)) {
        shown_ = nullptr;
        target_ = std::make_unique<DrawTarget>(extent, options);
    }
    const SceneView view = see(scene_, camera, 1.0 * options.width / options.height);
    hair_.undirect();
    HairView hair_seen = hair_view(view);
    hair_seen.thinnest = 2.0 * kMovingWidth * view.parameters.half_extent.y() / options.height;
    const GpuHairShade shade = hair_.shade(hair_seen);
    const SceneDrawer drawer(tools_, scene_, shade, view, options);
    const Tile tile{0, 0, options.width, options.height};
    if (hair_.empty()) {
        drawer.draw(tile, *target_);
    } else {
        drawer.draw_samples(tile, *target_);
        draw_moving_hair(hair_seen, moving_strands(view, options.height));
        drawer.finish_with_strands(*target_);
    }
    shown_ = &target_->output;
    ++version_;
}

void Screen::begin_fill(const Camera& camera, const Canvas& whole, const Color& background,
                        double longest) {
    filling_ = nullptr;
    if (hair_.empty()) return;
    RenderOptions options = options_of(beside_legend(whole), background, 1);
    options.samples = max_samples_;
    filling_ = std::make_unique<Filling>(*this, camera, options, longest);
}

bool Screen::fill() {
    if (!filling_) return false;
    const std::optional<Slice> slice = filling_->fill.next(fill_pace_);
    if (!slice) {
        filling_ = nullptr;
        return false;
    }
    Filling& now = *filling_;
    if (slice->is_first()) now.drawer.draw_samples(now.tile(), now.target);
    now.target.drawn().bind();
    glEnable(GL_DEPTH_TEST);
    glFinish();
    const auto start = Clock::now();
    const double all = hair_.size();
    hair_.draw(now.hair_view, {slice->begin / all, slice->end / all, slice->of / all});
    glFinish();
    slice_seconds_ = seconds_since(start);
    fill_pace_.add(slice->end - slice->begin, slice_seconds_);
    now.fill.drawn();
    if (!slice->is_last()) return false;
    now.drawer.finish_with_strands(now.target);
    filled_ = std::exchange(now.target.output,
                            gl::Framebuffer::texture(now.target.output.extent(), GL_RGBA8, false));
    shown_ = &filled_;
    ++version_;
    return true;
}

void Screen::take(const Image& image) {
    upload(image, finished_);
    shown_ = &finished_;
    ++version_;
}

Image Screen::picture() const {
    return shown_ ? read_pixels(*shown_) : Image();
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
