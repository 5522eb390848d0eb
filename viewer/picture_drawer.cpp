#include "viewer/picture_drawer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "viewer/draw/colormap.h"
#include "viewer/gl/shaders.h"

namespace lissom {
namespace {

// Pixels that are drawn at one time; larger pictures are drawn in parts.
constexpr int kTileSize = 2048;
// Longest side on which occlusion is computed; larger pictures read it between its pixels.
constexpr int kOcclusionSize = 2048;
constexpr int kColormapSize = 256;

gl::Texture make_colormap() {
    std::vector<float> texels;
    for (int i = 0; i < kColormapSize; ++i) {
        const Color color = colormap(i / (kColormapSize - 1.0));
        for (const double part : {color.r, color.g, color.b, 1.0}) {
            texels.push_back(static_cast<float>(srgb_to_linear(part)));
        }
    }
    gl::Texture texture = gl::make_texture(kColormapSize, 1, GL_RGBA32F, true);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kColormapSize, 1, GL_RGBA, GL_FLOAT, texels.data());
    return texture;
}

Vec3 linear(const Color& color) {
    return {srgb_to_linear(color.r), srgb_to_linear(color.g), srgb_to_linear(color.b)};
}

// Parts that cover a picture, none larger than `size`.
std::vector<Tile> split(int width, int height, int size) {
    std::vector<Tile> tiles;
    for (int y = 0; y < height; y += size) {
        for (int x = 0; x < width; x += size) {
            tiles.push_back({x, y, std::min(size, width - x), std::min(size, height - y)});
        }
    }
    return tiles;
}

Image read_pixels(const gl::Framebuffer& from) {
    Image image(from.extent().width, from.extent().height);
    from.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    return image;
}

}  // namespace

PictureTools::PictureTools()
    : surface("surface", shaders::kCommon, shaders::kSurfaceVertex, shaders::kSurfaceFragment),
      line("line", shaders::kCommon, shaders::kLineVertex, shaders::kLineFragment),
      point("point", shaders::kCommon, shaders::kPointVertex, shaders::kPointFragment),
      output("output", shaders::kCommon, shaders::kCoverVertex, shaders::kOutputFragment),
      colormap(make_colormap()),
      no_vertices(gl::make_vertex_array()) {}

// Framebuffers that one part of a picture passes through.
struct PictureDrawer::Targets {
    gl::Framebuffer samples, picture, output;

    Targets(gl::Extent extent, const RenderOptions& options) {
        const gl::Extent fine{extent.width * options.supersample,
                              extent.height * options.supersample};
        const int count = options.samples > 1 ? options.samples : 0;
        samples = gl::Framebuffer::multisampled(fine, GL_RGBA16F, count);
        picture = gl::Framebuffer::texture(fine, GL_RGBA16F, false);
        output = gl::Framebuffer::texture(extent, GL_RGBA8, false);
    }
};

PictureDrawer::PictureDrawer(const PictureTools& tools, const GpuDrawing& drawing,
                             const ViewParameters& view, const RenderOptions& options,
                             double occlusion_radius)
    : tools_(tools),
      drawing_(drawing),
      view_(view),
      options_(options),
      openness_(compute_occlusion(occlusion_radius)) {}

gl::Framebuffer PictureDrawer::compute_occlusion(double radius) const {
    if (options_.occlusion == 0.0) return tools_.occlusion.none();
    const double longest = std::max(options_.width, options_.height);
    const double scale = std::min(1.0, kOcclusionSize / longest);
    const gl::Extent extent{static_cast<int>(std::ceil(scale * options_.width)),
                            static_cast<int>(std::ceil(scale * options_.height))};
    return tools_.occlusion.compute(drawing_, view_, {extent, radius, options_.occlusion});
}

Image PictureDrawer::draw(Progress& progress) const {
    Image image(options_.width, options_.height);
    const std::vector<Tile> tiles =
        split(options_.width, options_.height, kTileSize / options_.supersample);
    std::unique_ptr<Targets> targets;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Tile& tile = tiles[i];
        const gl::Extent extent{tile.width, tile.height};
        if (!targets || !(targets->output.extent() == extent)) {
            targets.reset();
            targets = std::make_unique<Targets>(extent, options_);
        }
        image.paste(draw_part(tile, *targets), tile.x, options_.height - tile.y - tile.height);
        progress.update(static_cast<double>(i + 1) / static_cast<double>(tiles.size()));
    }
    return image;
}

Image PictureDrawer::draw_part(const Tile& tile, const Targets& targets) const {
    targets.samples.bind();
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_surfaces(tile);
    draw_marks(tile);
    targets.samples.resolve_to(targets.picture);
    draw_output(targets);
    gl::check_errors("drawing the picture");
    return read_pixels(targets.output);
}

Mat4 PictureDrawer::projection(const Tile& tile) const {
    return tile_matrix(tile, options_.width, options_.height) * view_.projection;
}

void PictureDrawer::draw_surfaces(const Tile& tile) const {
    const gl::Program& program = tools_.surface;
    const Vec2 texels(openness_.extent().width, openness_.extent().height);
    const Vec2 per_pixel = texels.cwiseQuotient(Vec2(options_.width, options_.height));
    program.use();
    program.set("u_view", view_.view);
    program.set("u_projection", projection(tile));
    program.set("u_perspective", view_.perspective ? 1.0f : 0.0f);
    program.set_texture("u_colormap", 0, tools_.colormap.id());
    program.set_texture("u_openness_depth", 1, openness_.color());
    program.set("u_openness_scale", Vec2(per_pixel / options_.supersample));
    program.set("u_openness_offset", Vec2(per_pixel.cwiseProduct(Vec2(tile.x, tile.y))));
    const GpuHairShade& hair = drawing_.hair;
    program.set_volume("u_hair", 2, hair.volume.id());
    program.set("u_hair_scale", hair.scale);
    program.set("u_hair_offset", hair.offset);
    program.set("u_hair_step", static_cast<float>(hair.step));
    program.set("u_scalp_color", hair.scalp_color);
    for (const GpuSurface& surface : drawing_.surfaces) {
        program.set("u_wire_width", static_cast<float>(surface.wire_width * options_.supersample));
        program.set("u_wire_color", linear(surface.wire_color));
        surface.draw();
    }
}

// Lines don't write depths, so that their soft edges hide nothing.
void PictureDrawer::draw_marks(const Tile& tile) const {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    use_for_marks(tools_.line, tile);
    drawing_.draw_lines();
    glDepthMask(GL_TRUE);
    use_for_marks(tools_.point, tile);
    drawing_.draw_points();
    glDisable(GL_BLEND);
}

void PictureDrawer::use_for_marks(const gl::Program& program, const Tile& tile) const {
    const int scale = options_.supersample;
    program.use();
    program.set("u_view", view_.view);
    program.set("u_projection", projection(tile));
    program.set("u_size", Vec2(tile.width * scale, tile.height * scale));
    program.set("u_pixel",
                static_cast<float>(2.0 * view_.half_extent.y() / (options_.height * scale)));
    program.set("u_perspective", view_.perspective ? 1.0f : 0.0f);
    program.set("u_near", static_cast<float>(view_.near));
    program.set("u_scale", static_cast<float>(scale));
}

void PictureDrawer::draw_output(const Targets& targets) const {
    const gl::Program& program = tools_.output;
    targets.output.bind();
    glDisable(GL_DEPTH_TEST);
    program.use();
    program.set_texture("u_picture", 0, targets.picture.color());
    program.set("u_block", options_.supersample);
    program.set("u_height", targets.output.extent().height);
    program.set("u_background", linear(options_.background.value_or(Color{})));
    program.set("u_background_alpha", options_.background ? 1.0f : 0.0f);
    glBindVertexArray(tools_.no_vertices.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lissom
