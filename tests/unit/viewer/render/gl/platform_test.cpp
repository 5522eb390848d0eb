#include "viewer/render/gl/platform.h"

#define EGL_NO_X11
#include <epoxy/egl.h>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/viewer_support.h"

using namespace lissom;

TEST_CASE("without EGL or OpenGL the error says what is missing and how to get it") {
    EglLibraries no_egl, no_gl;
    no_egl.egl = {"libEGL-absent.so.1"};
    no_gl.egl = {"libc.so.6"};  // one that is there
    no_gl.gl = {"libGL-absent.so.1"};
    for (const EglLibraries& libraries : {no_egl, no_gl}) {
        const Error error = test::error_of([&] { make_egl_platform(libraries); });
        CHECK(error.code() == ErrorCode::no_display);
        CHECK(error.message().find("-absent.so.1") != std::string::npos);
        CHECK(error.message().find("apt-get install") != std::string::npos);
    }
}

TEST_CASE("drawing leaves no context current") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const Mesh square = test::make_square();
    renderer->render({.meshes = {{test::shared(square)}}}, test::front_camera(3.0),
                     test::small_options());
    CHECK(eglGetCurrentContext() == EGL_NO_CONTEXT);
}

TEST_CASE("the context of a host is current again after drawing") {
    const auto renderer = test::make_renderer();
    if (!renderer) return;
    const std::unique_ptr<Platform> host = make_egl_platform();
    const PlatformScope scope(*host);
    const EGLContext context = eglGetCurrentContext();
    REQUIRE(context != EGL_NO_CONTEXT);
    const Mesh square = test::make_square();
    renderer->render({.meshes = {{test::shared(square)}}}, test::front_camera(3.0),
                     test::small_options());
    CHECK(eglGetCurrentContext() == context);
}

TEST_CASE("renderers may come, go and live side by side") {
    const auto first = test::make_renderer();
    if (!first) return;
    const Mesh box = make_box();
    const Snapshot drawing{.meshes = {{test::shared(box)}}};
    const Camera camera = test::front_camera(2.0);
    const Image image = first->render(drawing, camera, test::small_options());
    for (int i = 0; i < 5; ++i) {
        Renderer other;
        CHECK(other.render(drawing, camera, test::small_options()) == image);
        CHECK(first->render(drawing, camera, test::small_options()) == image);
    }
}
