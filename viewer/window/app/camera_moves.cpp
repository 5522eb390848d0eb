#include "viewer/window/app/camera_moves.h"

#include "kernel/sketch/navigation.h"
#include "viewer/render/draw/projection.h"

namespace lissom::window {
namespace {

// Returns the bounds of the selected vertices of all meshes, in the world.
Box selected_bounds(const Picture& picture) {
    Box box;
    for (const DrawnMesh& drawn : picture.meshes) {
        if (!drawn.style.region) continue;
        for (const Index v : drawn.style.region->vertices()) {
            box.extend(drawn.transform(drawn.mesh->position(v)));
        }
    }
    return box;
}

void frame_inside(ViewState& state, const Box& box) {
    if (!box.empty()) state.set_camera(framed(state.view(), box));
}

}  // namespace

void frame_all(ViewState& state) {
    if (state.shown) frame_inside(state, state.shown->bounds);
}

void frame_selection(ViewState& state) {
    if (!state.shown) return;
    const Box selected = selected_bounds(*state.shown->picture);
    frame_inside(state, selected.empty() ? state.shown->bounds : selected);
}

void look_from(ViewState& state, StandardView side) {
    if (!state.shown || state.shown->bounds.empty()) return;
    FramingOptions framing = state.shown->picture->framing;
    framing.up = state.up_axis();
    framing.aspect = state.view().size.aspect();
    framing.ortho = state.camera.is_ortho();
    state.set_camera(frame_box(side, state.shown->bounds, framing));
}

void place_camera(ViewState& state) {
    const Picture& picture = *state.shown->picture;
    // While nothing is visible the camera waits.
    if (!picture.camera && state.shown->bounds.empty()) return;
    const double aspect = state.view().size.aspect();
    state.set_camera(picture.camera && !picture.camera->is_ortho()
                         ? *picture.camera
                         : quick_camera_of(picture, state.shown->snapshot, aspect));
    state.camera_is_placed = true;
}

void toggle_up(ViewState& state) {
    const bool to_z = state.up_axis() == ViewUp::y;
    state.up = to_z ? ViewUp::z : ViewUp::y;
    if (!state.shown || state.shown->bounds.empty()) return;
    const double sign = to_z ? 1.0 : -1.0;
    const auto turned = [&](const Vec3& d) { return Vec3(d.x(), -sign * d.z(), sign * d.y()); };
    const Vec3 middle = state.shown->bounds.center();
    CameraOptions camera = state.camera.options();
    camera.eye = middle + turned(camera.eye - middle);
    camera.target = middle + turned(camera.target - middle);
    camera.up = turned(camera.up);
    state.set_camera(Camera(camera));
}

void toggle_perspective(ViewState& state) {
    const Camera& camera = state.camera;
    state.set_camera(camera.is_ortho() ? with_perspective(camera) : without_perspective(camera));
}

}  // namespace lissom::window
