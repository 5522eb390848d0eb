#include "viewer/render/scene_drawer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "viewer/render/draw/image/colormap.h"
#include "viewer/render/draw/studio_light.h"
#include "viewer/render/gl/shaders.h"
#include "viewer/render/strands/hair_light.h"
#include "viewer/render/strands/strand_layer.h"

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
            texels.push_back(srgb_to_linear(part));
        }
    }
    gl::Texture texture = gl::make_texture(kColormapSize, 1, GL_RGBA32F, true);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kColormapSize, 1, GL_RGBA, GL_FLOAT, texels.data());
    return texture;
}

// Later drawing hides surfaces at the same depth. The offset is the same everywhere: a larger one
// on slanted surfaces would bring their far side before their outline.
void raise() {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0.0f, -32.0f);
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

}  // namespace

Image read_pixels(const gl::Framebuffer& from) {
    Image image(from.extent().width, from.extent().height);
    from.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    return image;
}

const gl::Program& SurfacePrograms::get(const SurfaceParts& parts) const {
    const std::array<std::pair<bool, const char*>, 4> all{
        {{parts.occlusion, shaders::kHasOcclusion},
         {parts.hair, shaders::kHasHair},
         {parts.wire, shaders::kHasWire},
         {parts.values, shaders::kHasValues}}};
    std::size_t place = 0;
    std::string fragment;
    for (const auto& [has_it, definition] : all) {
        place = 2 * place + (has_it ? 1 : 0);
        if (has_it) fragment += definition;
    }
    std::optional<gl::Program>& program = programs_[place];
    if (program) return *program;
    fragment += shaders::kSurfaceFragment;
    return program.emplace("surface", shaders::kCommon, shaders::kSurfaceVertex, fragment.c_str());
}

SceneTools::SceneTools()
    : line("line", shaders::kCommon, shaders::kLineVertex, shaders::kLineFragment),
      point("point", shaders::kCommon, shaders::kPointVertex, shaders::kPointFragment),
      output("output", shaders::kCommon, shaders::kCoverVertex, shaders::kOutputFragment),
      strand_output("strand output", shaders::kCommon, shaders::kCoverVertex,
                    shaders::kStrandOutputFragment),
      colormap(make_colormap()),
      no_vertices(gl::make_vertex_array()) {}

const Occlusion& SceneTools::occlusion() const {
    return occlusion_ ? *occlusion_ : occlusion_.emplace();
}

DrawTarget::DrawTarget(gl::Extent extent, const RenderOptions& options) {
    const gl::Extent fine{extent.width * options.supersample, extent.height * options.supersample};
    const bool several = options.samples > 1;
    if (several) samples = gl::Framebuffer::multisampled(fine, GL_RGBA16F, options.samples);
    picture = gl::Framebuffer::texture(fine, GL_RGBA16F, !several);
    output = gl::Framebuffer::texture(extent, GL_RGBA8, false);
}

SceneDrawer::SceneDrawer(const SceneTools& tools, const GpuScene& scene, const GpuHairShade& hair,
                         const SceneView& view, const RenderOptions& options)
    : tools_(tools),
      scene_(scene),
      hair_(hair),
      view_(view),
      options_(options),
      openness_(compute_occlusion()) {}

gl::Framebuffer SceneDrawer::compute_occlusion() const {
    if (options_.occlusion <= 0.0) return {};
    const double longest = std::max(options_.width, options_.height);
    const double scale = std::min(1.0, kOcclusionSize / longest);
    const gl::Extent extent{static_cast<int>(std::ceil(scale * options_.width)),
                            static_cast<int>(std::ceil(scale * options_.height))};
    return tools_.occlusion().compute(scene_, view_.parameters,
                                      {extent, view_.occlusion_radius, options_.occlusion});
}

Image SceneDrawer::picture(Progress& progress) const {
    Image image(options_.width, options_.height);
    const std::vector<Tile> tiles =
        split(options_.width, options_.height, kTileSize / options_.supersample);
    std::unique_ptr<DrawTarget> target;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const Tile& tile = tiles[i];
        const gl::Extent extent{tile.width, tile.height};
        if (!target || !(target->output.extent() == extent)) {
            target.reset();
            target = std::make_unique<DrawTarget>(extent, options_);
        }
        draw(tile, *target);
        image.paste(read_pixels(target->output), tile.x, options_.height - tile.y - tile.height);
        progress.update(i + 1, tiles.size());
    }
    return image;
}

void SceneDrawer::draw(const Tile& tile, const DrawTarget& target) const {
    draw_samples(tile, target);
    finish(target, tools_.output);
}

void SceneDrawer::draw_samples(const Tile& tile, const DrawTarget& target) const {
    target.drawn().bind();
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_surfaces(tile);
    draw_marks(tile);
}

void SceneDrawer::finish_with_strands(const DrawTarget& target) const {
    tools_.strand_output.use();
    tools_.strand_output.set("u_samples", static_cast<float>(std::max(options_.samples, 1)));
    finish(target, tools_.strand_output);
}

void SceneDrawer::finish(const DrawTarget& target, const gl::Program& output) const {
    if (target.has_samples()) target.samples.resolve_to(target.picture);
    draw_output(target, output);
    gl::check_errors("drawing the picture");
}

Mat4 SceneDrawer::projection(const Tile& tile) const {
    return tile_matrix(tile, options_.width, options_.height) * view_.parameters.projection;
}

SurfaceParts SceneDrawer::parts() const {
    SurfaceParts parts{.occlusion = options_.occlusion > 0.0, .hair = hair_.step > 0.0};
    for (const auto& surface : scene_.surfaces()) {
        parts.wire = parts.wire || surface->drawn.style.wire;
        parts.values = parts.values || !surface->drawn.style.values.empty();
    }
    return parts;
}

void SceneDrawer::draw_surfaces(const Tile& tile) const {
    const SurfaceParts has = parts();
    const gl::Program& program = tools_.surface.get(has);
    program.use();
    program.set("u_view", view_.parameters.view);
    program.set("u_projection", projection(tile));
    program.set("u_perspective", view_.parameters.perspective ? 1.0f : 0.0f);
    if (has.values) program.set_texture("u_colormap", 0, tools_.colormap.id());
    if (has.occlusion) use_occlusion(program, tile);
    if (has.hair) use_hair(program);
    for (const auto& surface : scene_.surfaces()) {
        const MeshStyle& style = surface->drawn.style;
        const double wire_width = style.wire ? style.wire_width : 0.0;
        program.set("u_wire_width", static_cast<float>(wire_width * mark_scale()));
        program.set("u_wire_color", linear(style.wire_color));
        if (style.raised) raise();
        draw_through(program, *surface);
        if (style.raised) glDisable(GL_POLYGON_OFFSET_FILL);
    }
}

void SceneDrawer::use_occlusion(const gl::Program& program, const Tile& tile) const {
    const Vec2 texels(openness_.extent().width, openness_.extent().height);
    const Vec2 per_pixel = texels.cwiseQuotient(Vec2(options_.width, options_.height));
    program.set_texture("u_openness_depth", 1, openness_.color());
    program.set("u_openness_scale", Vec2(per_pixel / options_.supersample));
    program.set("u_openness_offset", Vec2(per_pixel.cwiseProduct(Vec2(tile.x, tile.y))));
}

void SceneDrawer::use_hair(const gl::Program& program) const {
    const Mat3& turned = hair_.turn;
    Mat4 turn = Mat4::Identity();
    turn.topLeftCorner<3, 3>() = turned;
    program.set_volume("u_hair", 2, hair_.volume->id());
    program.set_volume("u_hair_moments", 3, (hair_.moments ? hair_.moments : hair_.volume)->id());
    program.set("u_hair_kind", static_cast<int>(hair_.kind));
    program.set("u_hair_turn", turn);
    program.set("u_hair_key", Vec3(turned * kKeyLight.direction.cast<double>().normalized()));
    program.set("u_hair_up", Vec3(turned.col(1)));
    program.set("u_hair_slope", ambient_slope());
    program.set("u_hair_scale", hair_.scale);
    program.set("u_hair_offset", hair_.offset);
    program.set("u_hair_step", static_cast<float>(hair_.step));
    program.set("u_scalp_color", hair_.scalp_color);
    program.set("u_hair_loss", hair_.loss);
}

// Only a fraction of the samples or pixels of a transparent surface is drawn, always the same: so
// surfaces behind it need no order, and its own inside is not seen.
void SceneDrawer::draw_through(const gl::Program& program, const GpuSurface& surface) const {
    const double opacity = surface.drawn.style.opacity;
    const bool has_samples = options_.samples > 1;
    program.set("u_opacity", static_cast<float>(opacity));
    program.set("u_dithered", opacity < 1.0 && !has_samples ? 1 : 0);
    if (opacity == 1.0 || !has_samples) return surface.draw();
    glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    glEnable(GL_SAMPLE_ALPHA_TO_ONE);
    surface.draw();
    glDisable(GL_SAMPLE_ALPHA_TO_ONE);
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

// Lines don't write depths, so that their soft edges hide nothing.
void SceneDrawer::draw_marks(const Tile& tile) const {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (const bool on_top : {false, true}) {
        if (on_top) glDisable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        use_for_marks(tools_.line, tile);
        scene_.draw_lines(on_top);
        glDepthMask(GL_TRUE);
        use_for_marks(tools_.point, tile);
        scene_.draw_points(on_top);
    }
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
}

double SceneDrawer::mark_scale() const {
    return options_.mark_scale * options_.supersample;
}

void SceneDrawer::use_for_marks(const gl::Program& program, const Tile& tile) const {
    const int scale = options_.supersample;
    program.use();
    program.set("u_view", view_.parameters.view);
    program.set("u_projection", projection(tile));
    program.set("u_size", Vec2(tile.width * scale, tile.height * scale));
    program.set("u_pixel", static_cast<float>(2.0 * view_.parameters.half_extent.y() /
                                              (options_.height * scale)));
    program.set("u_perspective", view_.parameters.perspective ? 1.0f : 0.0f);
    program.set("u_near", static_cast<float>(view_.parameters.near));
    program.set("u_scale", static_cast<float>(mark_scale()));
}

void SceneDrawer::draw_output(const DrawTarget& target, const gl::Program& program) const {
    target.output.bind();
    glDisable(GL_DEPTH_TEST);
    program.use();
    program.set_texture("u_picture", 0, target.picture.color());
    program.set("u_block", options_.supersample);
    program.set("u_height", target.output.extent().height);
    program.set("u_background", linear(options_.background.value_or(Color{})));
    program.set("u_background_alpha", options_.background ? 1.0f : 0.0f);
    glBindVertexArray(tools_.no_vertices.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

namespace {

double min_width(const Snapshot& snapshot) {
    Index count = 0;
    for (const DrawnStrands& drawn : snapshot.strands) count += drawn.strands->size();
    return min_visible_width(count);
}

// The picture without strands, which `shadow` stands for; may be null.
Image draw_meshes(const SceneTools& tools, const GpuScene& scene, const SceneView& view,
                  const RenderOptions& options, const StrandShadow* shadow,
                  const Context& context) {
    Progress progress(context, "render");
    progress.step(0.3);
    const GpuHairShade hair = upload_shade(shadow);
    const SceneDrawer drawer(tools, scene, hair, view, options);
    progress.step(0.7);
    return drawer.picture(progress);
}

}  // namespace

Image draw_scene(const SceneTools& tools, const GpuScene& scene, const Camera& camera,
                 const RenderOptions& options, const Context& context) {
    const double aspect = 1.0 * options.width / options.height;
    const SceneView view = see(scene, camera, aspect);
    const Snapshot& snapshot = scene.snapshot();
    if (snapshot.strands.empty()) {
        return draw_meshes(tools, scene, view, options, nullptr, context);
    }
    Progress progress(context, "render");
    progress.step(0.3);
    const Mat4& to_view = view.parameters.view;
    const StrandScene strands{view_strands(snapshot, to_view, scene.origin()),
                              view_triangles(snapshot, to_view, scene.origin()), view.parameters,
                              min_width(snapshot)};
    const StrandShadow shadow(strands.strands, strands.triangles, context);
    progress.step(0.3);
    RenderOptions on_nothing = options;
    on_nothing.background = std::nullopt;
    const Image meshes = draw_meshes(tools, scene, view, on_nothing, &shadow, context);
    progress.step(0.4);
    return lay_over(meshes, draw_strands(strands, shadow, options, context), options.background);
}

}  // namespace lissom
