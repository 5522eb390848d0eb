// What the screen of a window asks of OpenGL, counted by a mock: needs no driver.
#include <doctest/doctest.h>

#include <memory>

#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/viewer/render/gl/mock_gl.h"
#include "viewer/render/draw/quick_vertices.h"
#include "viewer/window/screen/display.h"
#include "viewer/window/screen/screen.h"

using namespace lissom;
using namespace lissom::window;

namespace {

constexpr Canvas kMockCanvas{0, 0, 640, 480};

Camera mock_camera(double x) {
    return Camera({.eye = {x, 1.0, 6.0}});
}

Picture mock_picture(int meshes) {
    Picture picture;
    for (int i = 0; i < meshes; ++i) {
        picture.meshes.push_back({std::make_shared<const Mesh>(make_sphere())});
    }
    return picture;
}

// Moves all vertices of a mesh of the picture.
void stretch_first(Picture& picture, double factor) {
    Mesh moved = *picture.meshes[0].mesh;
    for (Vec3& p : moved.edit_positions()) p.x() *= factor;
    picture.meshes[0].mesh = std::make_shared<const Mesh>(std::move(moved));
}

std::size_t vertex_bytes_of(const Mesh& mesh) {
    const Index triangles = mesh.topology().corner_count() - 2 * mesh.face_count();
    return sizeof(QuickVertex) * 3 * at(triangles);
}

// A screen that has drawn a frame.
struct MockedScreen {
    explicit MockedScreen(int meshes) : picture(mock_picture(meshes)) {
        update();
        draw(mock_camera(0.0));
        gl.reset();
    }
    void update() { screen->update(quick_snapshot(picture, {})); }
    void draw(const Camera& camera) {
        screen->draw(camera, kMockCanvas, kWhite, 1);
        screen->show(kMockCanvas, kMockCanvas.height);
    }
    bool makes_objects() const {
        for (const auto& [name, count] : gl.calls_by_name()) {
            if (name.starts_with("glGen") || name.starts_with("glCreate")) return true;
        }
        return false;
    }

    test::MockGl gl;
    std::unique_ptr<Screen> screen = std::make_unique<Screen>();
    Picture picture;
};

}  // namespace

TEST_CASE("mock of OpenGL: an orbit sends nothing, reads nothing back and makes nothing") {
    MockedScreen drawn(1);
    int calls = 0;
    for (int i = 1; i <= 20; ++i) {
        drawn.gl.reset();
        drawn.update();
        drawn.draw(mock_camera(0.1 * i));
        CHECK(drawn.gl.bytes() == 0);
        CHECK(drawn.gl.calls("glReadPixels") == 0);
        CHECK_FALSE(drawn.makes_objects());
        CHECK(drawn.gl.draws() > 0);
        if (i > 1) CHECK(drawn.gl.calls() == calls);
        calls = drawn.gl.calls();
    }
    CHECK(calls < 150);
}

TEST_CASE("mock of OpenGL: a drag sends positions and normals, and builds nothing again") {
    MockedScreen drawn(1);
    const int alive = drawn.gl.alive();
    for (int i = 1; i <= 5; ++i) {
        stretch_first(drawn.picture, 1.05);
        drawn.gl.reset();
        drawn.update();
        drawn.draw(mock_camera(0.0));
        // The first time all normals are found exactly.
        if (i > 1) CHECK(drawn.gl.bytes() == vertex_bytes_of(*drawn.picture.meshes[0].mesh));
        CHECK(drawn.gl.calls("glReadPixels") == 0);
        CHECK(drawn.gl.calls("glGenVertexArrays") <= 1);
        CHECK(drawn.gl.calls("glGenTextures") == 0);
        CHECK(drawn.gl.calls("glCreateShader") == 0);
        CHECK(drawn.gl.alive() == alive);
    }
}

TEST_CASE(
    "mock of OpenGL: each more object costs the same few calls, none of them while it rests") {
    int calls[3];
    for (const int more : {0, 1, 2}) {
        MockedScreen drawn(1 + 10 * more);
        drawn.draw(mock_camera(1.0));
        calls[more] = drawn.gl.calls();
        CHECK(drawn.gl.bytes() == 0);
    }
    CHECK(calls[2] - calls[1] == calls[1] - calls[0]);
    CHECK(calls[1] - calls[0] <= 10 * 20);
    MockedScreen drawn(11);
    drawn.update();
    CHECK(drawn.gl.calls() == 0);
}

TEST_CASE(
    "mock of OpenGL: a hidden mesh is not drawn, another size makes one picture of that size") {
    MockedScreen drawn(2);
    drawn.draw(mock_camera(0.0));
    const int both = drawn.gl.draws();
    drawn.gl.reset();
    drawn.screen->update(quick_snapshot(drawn.picture, {.hidden = {false, true}}));
    drawn.draw(mock_camera(0.0));
    CHECK(drawn.gl.draws() < both);
    CHECK(drawn.gl.bytes() == 0);
    const int alive = drawn.gl.alive();
    drawn.gl.reset();
    drawn.screen->draw(mock_camera(0.0), {0, 0, 320, 200}, kWhite, 1);
    CHECK(drawn.makes_objects());
    CHECK(drawn.gl.alive() == alive);
}

TEST_CASE("mock of OpenGL: a screen frees what it has made") {
    MockedScreen drawn(3);
    CHECK(drawn.gl.alive() > 0);
    drawn.draw(mock_camera(0.5));
    drawn.screen.reset();
    CHECK(drawn.gl.alive() == 0);
}
