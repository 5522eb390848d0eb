// camera:orbit, pan, zoom, frame and parallel: the camera after a move of a hand.
#include "bindings/lua/sketch/navigation.h"

#include <memory>
#include <string>
#include <utility>

#include "bindings/lua/sketch/camera_object.h"
#include "kernel/sketch/navigation.h"

namespace lissom::lua {
namespace {

View seen_view(const Call& call) {
    return {call.self<CameraObject>()->camera, SizeRequest::picture(call)};
}

template <typename Move>
int moved_camera(Call& call, const Move& move) {
    const auto result = call.create<CameraObject>();
    const bool done =
        call.attempt_quick([&] { result.set(std::make_shared<CameraObject>(move())); });
    return done ? 1 : call.fail();
}

int orbit_camera(Call& call) {
    const View view = seen_view(call);
    const Vec2 drag(call.number("right"), call.number("down"));
    return moved_camera(call, [&] { return orbited(view, drag); });
}

int pan_camera(Call& call) {
    const View view = seen_view(call);
    const Vec2 drag(call.number("right"), call.number("down"));
    return moved_camera(call, [&] { return panned(view, drag); });
}

int zoom_camera(Call& call) {
    const View view = seen_view(call);
    const Vec2 cursor(call.number("x"), call.number("y"));
    return moved_camera(
        call, [&] { return zoomed(view, cursor, call.number("factor"), call.number("extent")); });
}

int frame_with_camera(Call& call) {
    const View view = seen_view(call);
    Box box;
    for (const Vec3& p : call.points("points")) box.extend(p);
    return moved_camera(call, [&] { return framed(view, box, call.number("margin")); });
}

int parallel_camera(Call& call) {
    const Camera& camera = call.self<CameraObject>()->camera;
    const bool parallel = call.boolean("parallel");
    return moved_camera(
        call, [&] { return parallel ? without_perspective(camera) : with_perspective(camera); });
}

Parameter pixels_right() {
    return number("right", "Pixels to the right.");
}
Parameter pixels_down() {
    return number("down", "Pixels down.");
}

}  // namespace

std::vector<Function> navigation_methods() {
    const std::vector<Result> result = {{"lissom.Camera", "camera", "Another camera."}};
    const std::string setup = "local camera = lissom.camera{ eye = { 0, 0, 5 } }\n";
    return {
        {.name = "orbit",
         .body = orbit_camera,
         .summary =
             "Turns it about its target, as a drag by so many pixels does: across the height of "
             "the picture by half a turn; up and down no further than along its up.",
         .arguments = {pixels_right(), pixels_down(), size_argument()},
         .results = result,
         .errors = {ErrorCode::not_finite},
         .example = setup + "local turned = camera:orbit(480, 0, { 640, 480 })\n"
                            "assert(math.abs(turned:eye()[3] + 5) < 1e-9)"},
        {.name = "pan",
         .body = pan_camera,
         .summary = "Moves it beside itself: points as far away as its target follow the drag.",
         .arguments = {pixels_right(), pixels_down(), size_argument()},
         .results = result,
         .errors = {ErrorCode::not_finite},
         .example = setup + "local moved = camera:pan(10, 0, { 640, 480 })\n"
                            "local x = moved:project({ 0, 0, 0 }, { 640, 480 })\n"
                            "assert(math.abs(x - 330) < 1e-6)"},
        {.name = "zoom",
         .body = zoom_camera,
         .summary = "Comes nearer to the point seen at a pixel, which stays there.",
         .arguments = {number("x", "Pixels from the left."), number("y", "Pixels from the top."),
                       number("factor", "2: half the distance, 0.5: twice the distance.").above(0),
                       size_argument()},
         .options = {number("extent",
                            "Size of the object: its distance stays between 1e-6 and 1e6 times "
                            "that.")
                         .above(0)
                         .defaults(1.0)},
         .results = result,
         .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite},
         .example = setup + "local near = camera:zoom(320, 240, 2, { 640, 480 })\n"
                            "assert(math.abs(near:eye()[3] - 2.5) < 1e-9)"},
        {.name = "frame",
         .body = frame_with_camera,
         .summary =
             "Looks in the same direction at the box around points, as near as the margin allows.",
         .arguments = {points("points", "The points to show."), size_argument()},
         .options = {number("margin", "Share of the picture left free on every side.")
                         .between(0.0, 0.49)
                         .defaults(0.06)},
         .results = result,
         .errors = {ErrorCode::invalid_argument},
         .example = setup + "local near = camera:frame{ { -1, -1, -1 }, { 1, 1, 1 } }\n"
                            "assert(near:target()[1] == 0)"},
        {.name = "parallel",
         .body = parallel_camera,
         .summary =
             "The camera without perspective, or with it, that shows as much as far away as its "
             "target is.",
         .arguments = {boolean("parallel", "Without perspective.")},
         .results = result,
         .example = setup + "assert(camera:parallel(true):ortho())"}};
}

}  // namespace lissom::lua
