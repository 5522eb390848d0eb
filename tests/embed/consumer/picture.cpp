// Draws a picture into memory; where there is no OpenGL it says so.
#include <lissom/core/error.h>
#include <lissom/mesh/shapes/shapes.h>
#include <lissom/viewer/picture.h>

#include <cstdio>
#include <memory>

int main() {
    lissom::Picture picture;
    picture.meshes.emplace_back().mesh = std::make_shared<lissom::Mesh>(lissom::make_bar());
    try {
        lissom::Renderer renderer(lissom::make_egl_platform());
        const lissom::Image image = lissom::draw_picture(renderer, picture);
        return image.width > 0 ? 0 : 1;
    } catch (const lissom::Error& error) {
        std::puts(error.what());
        return error.code() == lissom::ErrorCode::no_display ? 0 : 1;
    }
}
