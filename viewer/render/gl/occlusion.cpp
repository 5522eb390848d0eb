#include "viewer/render/gl/occlusion.h"

#include "viewer/render/gl/shaders.h"

namespace lissom {
namespace {

// Openness and depth; normal and depth.
constexpr GLenum kOpennessFormat = GL_RG32F;
constexpr GLenum kGeometryFormat = GL_RGBA32F;

}  // namespace

Occlusion::Occlusion()
    : geometry_("geometry", shaders::kCommon, shaders::kGeometryVertex, shaders::kGeometryFragment),
      occlusion_("occlusion", shaders::kCommon, shaders::kCoverVertex, shaders::kOcclusionFragment),
      blur_("blur", shaders::kCommon, shaders::kCoverVertex, shaders::kOcclusionBlurFragment),
      no_vertices_(gl::make_vertex_array()) {}

gl::Framebuffer Occlusion::compute(const GpuScene& scene, const ViewParameters& view,
                                   const OcclusionOptions& options) const {
    const gl::Framebuffer geometry = draw_geometry(scene, view, options.extent);
    gl::Framebuffer openness = gl::Framebuffer::texture(options.extent, kOpennessFormat, false);
    const gl::Framebuffer half = gl::Framebuffer::texture(options.extent, kOpennessFormat, false);

    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    openness.bind();
    occlusion_.use();
    occlusion_.set_texture("u_normal_depth", 0, geometry.color());
    occlusion_.set("u_extent", view.half_extent);
    occlusion_.set("u_perspective", view.perspective ? 1.0f : 0.0f);
    occlusion_.set("u_radius", static_cast<float>(options.radius));
    occlusion_.set("u_strength", static_cast<float>(options.strength));
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    blur(openness, half, geometry, false, options.radius);
    blur(half, openness, geometry, true, options.radius);
    return openness;
}

gl::Framebuffer Occlusion::draw_geometry(const GpuScene& scene, const ViewParameters& view,
                                         gl::Extent extent) const {
    gl::Framebuffer target = gl::Framebuffer::texture(extent, kGeometryFormat, true);
    target.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    geometry_.use();
    geometry_.set("u_view", view.view);
    geometry_.set("u_projection", view.projection);
    scene.draw_surfaces();
    return target;
}

void Occlusion::blur(const gl::Framebuffer& from, const gl::Framebuffer& to,
                     const gl::Framebuffer& geometry, bool along_y, double radius) const {
    to.bind();
    blur_.use();
    blur_.set_texture("u_openness_depth", 0, from.color());
    blur_.set_texture("u_normal_depth", 1, geometry.color());
    blur_.set("u_along_y", along_y ? 1 : 0);
    blur_.set("u_radius", static_cast<float>(radius));
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lissom
