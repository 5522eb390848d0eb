/// Helpers shared by the tests of the renderer.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/mesh/mesh.h"
#include "tests/unit/support.h"
#include "viewer/render/renderer.h"

namespace lissom::test {

/// A context whose driver's complaints are failures of the test.
class StrictPlatform : public Platform {
  public:
    explicit StrictPlatform(std::unique_ptr<Platform> inner) : inner_(std::move(inner)) {}

    void enter() override {
        inner_->enter();
        if (!epoxy_has_gl_extension("GL_KHR_debug")) return;
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(&report, nullptr);
    }
    void leave() noexcept override { inner_->leave(); }

  private:
    static void EPOXY_CALLSPEC report(GLenum, GLenum type, GLuint, GLenum, GLsizei,
                                      const GLchar* message, const void*) {
        if (type == GL_DEBUG_TYPE_PERFORMANCE || type == GL_DEBUG_TYPE_OTHER) return;
        ADD_FAIL_CHECK_AT(__FILE__, __LINE__, "OpenGL says: " << message);
    }

    std::unique_ptr<Platform> inner_;
};

/// A context, or null where this machine has none: the test then says so and returns, or fails
/// where LISSOM_REQUIRE_GL is set.
inline std::unique_ptr<Platform> make_platform() {
    try {
        return std::make_unique<StrictPlatform>(make_egl_platform());
    } catch (const Error& error) {
        if (error.code() != ErrorCode::no_display) throw;
        skip("LISSOM_REQUIRE_GL", error.message());
        return nullptr;
    }
}

/// The same for a renderer.
inline std::unique_ptr<Renderer> make_renderer() {
    std::unique_ptr<Platform> platform = make_platform();
    return platform ? std::make_unique<Renderer>(std::move(platform)) : nullptr;
}

/// As a snapshot holds meshes and strands. Copies share the topology, so that regions stay valid.
template <typename T>
std::shared_ptr<const T> shared(T content) {
    return std::make_shared<const T>(std::move(content));
}

/// One overlay.
inline std::vector<std::shared_ptr<const Overlay>> marks(Overlay overlay) {
    return {shared(std::move(overlay))};
}

/// The square [-1, 1] x [-1, 1] in the xy plane, which faces +z, as one quad.
inline Mesh make_square() {
    FaceList faces;
    faces.add({0, 1, 2, 3});
    return Mesh({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}, std::move(faces));
}

/// A camera on +z without perspective that shows `height` world units.
inline Camera front_camera(double height) {
    return Camera({.eye = Vec3(0, 0, 10), .ortho = height});
}

/// Small pictures without occlusion, on nothing.
inline RenderOptions small_options(int width = 96, int height = 96) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.background = std::nullopt;
    options.occlusion = 0.0;
    return options;
}

/// Pixels covered, partly covered ones by their share.
inline double covered(const Image& image) {
    double sum = 0.0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) sum += image.rgba[i] / 255.0;
    return sum;
}

/// Greatest difference of a byte.
inline int difference(const Image& a, const Image& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    int greatest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) {
        greatest = std::max(greatest, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    }
    return greatest;
}

/// The rectangle of `image` whose top left pixel is (x, y).
inline Image crop(const Image& image, int x, int y, int width, int height) {
    Image part(width, height);
    for (int row = 0; row < height; ++row) {
        std::copy_n(image.pixel(x, y + row), 4 * static_cast<std::size_t>(width),
                    part.pixel(0, row));
    }
    return part;
}

inline double brightness(const Color& color) {
    return (color.r + color.g + color.b) / 3.0;
}
inline bool is_blue(const Color& c) {
    return c.b > c.g + 0.1 && c.g > c.r + 0.05;
}
inline bool is_purple(const Color& c) {
    return c.b > c.g + 0.1 && c.r > c.g + 0.05;
}
inline bool is_gray(const Color& c) {
    return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) < 0.05;
}

}  // namespace lissom::test
