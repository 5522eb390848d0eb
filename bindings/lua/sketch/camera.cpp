// lissom.camera, lissom.frame and lissom.Camera.
#include <cstdio>
#include <string>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/navigation.h"

namespace lissom::lua {
namespace {

// Returns the camera that make() gives.
template <typename Make>
int new_camera(Call& call, const Make& make) {
    const auto result = call.create<CameraObject>();
    const bool done =
        call.attempt_quick([&] { result.set(std::make_shared<CameraObject>(make())); });
    return done ? 1 : call.fail();
}

int place_camera(Call& call) {
    if (call.has("fov") && call.has("ortho")) {
        call.reject("ortho",
                    "a camera has either an opening angle 'fov' or, without perspective, "
                    "a height 'ortho'");
    }
    CameraOptions options;
    options.eye = call.vector("eye");
    options.target = call.vector("target");
    options.up = call.vector("up");
    if (call.has("fov")) options.fov = call.number("fov") * kDegree;
    if (call.has("ortho")) options.ortho = call.number("ortho");
    return new_camera(call, [&] { return Camera(options); });
}

int frame_mesh(Call& call) {
    const auto mesh = call.object<MeshObject>("mesh");
    ViewRequest request = ViewRequest::read(call);
    request.framing.fov = call.number("fov") * kDegree;
    const SizeRequest size = SizeRequest::read(call, "size");
    request.framing.aspect = 1.0 * size.width / size.height;
    return new_camera(
        call, [&] { return frame_points(request.view, mesh->mesh.positions(), request.framing); });
}

// ---- lissom.Camera

const Camera& self(const Call& call) {
    return call.self<CameraObject>()->camera;
}

int eye(Call& call) {
    return call.push_vector(self(call).eye());
}
int target(Call& call) {
    return call.push_vector(self(call).target());
}
int right(Call& call) {
    return call.push_vector(self(call).right());
}
int up(Call& call) {
    return call.push_vector(self(call).up());
}
int forward(Call& call) {
    return call.push_vector(self(call).forward());
}

int fov(Call& call) {
    if (!self(call).is_ortho()) return call.push(self(call).fov() / kDegree);
    lua_pushnil(call.lua());
    return 1;
}

int ortho(Call& call) {
    if (self(call).is_ortho()) return call.push(*self(call).options().ortho);
    lua_pushnil(call.lua());
    return 1;
}

int project(Call& call) {
    return call.push_coordinates(
        self(call).project(call.vector("point"), SizeRequest::picture(call)));
}

int unproject(Call& call) {
    return call.push_vector(self(call).unproject(call.vector("pixel"), SizeRequest::picture(call)));
}

int ray(Call& call) {
    const Ray ray = self(call).ray(call.number("x"), call.number("y"), SizeRequest::picture(call));
    call.push_vector(ray.origin);
    call.push_vector(ray.direction);
    return 2;
}

int camera_text(Call& call) {
    const Camera& camera = self(call);
    const Vec3 &from = camera.eye(), &to = camera.target();
    char text[256];
    std::snprintf(text, sizeof text,
                  "lissom.Camera (from %.6g, %.6g, %.6g to %.6g, %.6g, %.6g; %s %.6g)", from.x(),
                  from.y(), from.z(), to.x(), to.y(), to.z(), camera.is_ortho() ? "ortho" : "fov",
                  camera.is_ortho() ? *camera.options().ortho : camera.fov() / kDegree);
    return call.push(std::string_view(text));
}

std::vector<Function> camera_methods() {
    const std::vector<Result> vector_result = {{"number[]", "vector", "{x, y, z}."}};
    const std::string setup = "local camera = lissom.camera{ eye = { 0, 0, 5 } }\n";
    return {{.name = "eye",
             .body = eye,
             .summary = "Position of the camera.",
             .results = vector_result,
             .example = setup + "assert(camera:eye()[3] == 5)"},
            {.name = "target",
             .body = target,
             .summary = "The point in the middle of the picture.",
             .results = vector_result,
             .example = setup + "assert(camera:target()[3] == 0)"},
            {.name = "right",
             .body = right,
             .summary = "Unit vector to the right of the picture.",
             .results = vector_result,
             .example = setup + "assert(camera:right()[1] == 1)"},
            {.name = "up",
             .body = up,
             .summary = "Unit vector upwards in the picture, orthogonal to the view.",
             .results = vector_result,
             .example = setup + "assert(camera:up()[2] == 1)"},
            {.name = "forward",
             .body = forward,
             .summary = "Unit vector into the scene.",
             .results = vector_result,
             .example = setup + "assert(camera:forward()[3] == -1)"},
            {.name = "fov",
             .body = fov,
             .summary = "Vertical opening angle in degrees.",
             .results = {{"number?", "angle", "nil for a camera without perspective."}},
             .example = setup + "assert(math.abs(camera:fov() - 30) < 1e-9)"},
            {.name = "ortho",
             .body = ortho,
             .summary = "Height of the picture in world units, of a camera without perspective.",
             .results = {{"number?", "height", "nil for a camera with perspective."}},
             .example = setup + "assert(camera:ortho() == nil)"},
            {.name = "project",
             .body = project,
             .summary =
                 "Image of a point: pixels from the top left, and its depth along the view. With "
                 "perspective, x and y are NaN for a point that is not in front of the camera.",
             .arguments = {vector("point", "The point."), size_argument()},
             .results = {{"number", "x", "Pixels to the right."},
                         {"number", "y", "Pixels down."},
                         {"number", "depth", "Mesh units."}},
             .example = setup + "local x, y, depth = camera:project({ 0, 0, 0 }, { 640, 480 })\n"
                                "assert(x == 320 and y == 240 and depth == 5)"},
            {.name = "unproject",
             .body = unproject,
             .summary = "The inverse of project.",
             .arguments = {vector("pixel", "{x, y, depth}."), size_argument()},
             .results = {{"number[]", "point", "The point, {x, y, z}."}},
             .example = setup + "local point = camera:unproject({ 320, 240, 5 }, { 640, 480 })\n"
                                "assert(math.abs(point[3]) < 1e-9)"},
            {.name = "ray",
             .body = ray,
             .summary = "The ray of points that are seen at a pixel; mesh:pick takes it.",
             .arguments = {number("x", "Pixels from the left."),
                           number("y", "Pixels from the top."), size_argument()},
             .results = {{"number[]", "origin", "Start of the ray."},
                         {"number[]", "direction", "Direction of the ray; unit length."}},
             .example = setup + "local hit = lissom.shapes.box():pick(camera:ray(640, 480))\n"
                                "assert(hit.position[3] == 0.5)"}};
}

}  // namespace

ViewRequest ViewRequest::read(const Call& call) {
    ViewRequest request;
    if (call.has("view")) request.view = call.choice<StandardView>("view");
    if (call.has("up")) request.framing.up = call.choice<ViewUp>("up");
    if (call.has("parallel")) request.framing.ortho = call.boolean("parallel");
    if (call.has("margin")) request.framing.margin = call.number("margin");
    return request;
}

SizeRequest SizeRequest::read(const Call& call, const char* path) {
    SizeRequest size;
    if (!call.has(path)) return size;
    if (call.kind(path) == Kind::integer) {
        size.width = size.height = static_cast<int>(call.integer(path));
        return size;
    }
    const auto numbers = call.ids(path);
    if (numbers.size() != 2 || numbers[0] < 1 || numbers[1] < 1) {
        call.reject(path, "{width, height} in pixels expected, each at least 1");
    }
    size.width = numbers[0];
    size.height = numbers[1];
    return size;
}

PictureSize SizeRequest::picture(const Call& call) {
    const SizeRequest size = read(call, "size");
    return {static_cast<double>(size.width), static_cast<double>(size.height)};
}

Parameter size_argument() {
    return either("size",
                  {integer("pixels", "Side of a square.").at_least(1),
                   integers("pixels", "{width, height}.")},
                  "{width, height} of the picture in pixels; one number for a square.")
        .optional("{1280, 960}");
}

std::vector<Parameter> view_options() {
    return {choice("view", {"front", "back", "left", "right", "top", "bottom", "three-quarter"},
                   "The side to look from, of the world and not of the object: with y upwards the "
                   "camera stands at +z for front, -z for back, +x for right, -x for left. For a "
                   "head that faces +z, as is usual, left shows its own right side. three-quarter "
                   "stands between front and right, and above.")
                .optional("three-quarter"),
            choice("up", {"y", "z"}, "The axis that points up in the view.").optional("y"),
            boolean("parallel", "Without perspective.").optional("false"),
            number("margin", "Share of the picture left free on every side.")
                .between(0.0, 0.49)
                .optional("0.06")};
}

Type camera_type() {
    Type type;
    type.name = CameraObject::kTypeName;
    type.is_heard = false;
    type.summary =
        "View of a world in a picture. It does not change. Pixels count from the top left "
        "corner of the picture.";
    type.operators = {
        {"__tostring", camera_text, "tostring(camera)", "its position and direction"}};
    type.methods = camera_methods();
    for (Function& method : navigation_methods()) type.methods.push_back(std::move(method));
    return type;
}

std::vector<Function> camera_functions() {
    std::vector<Parameter> frame_options = view_options();
    frame_options.push_back(
        number("fov", "Vertical opening angle.").defaults(30.0).between(1.0, 170.0).in("degrees"));
    frame_options.push_back(size_argument());
    return {
        {.name = "camera",
         .body = place_camera,
         .summary = "A camera that stands at a point and looks at another.",
         .options =
             {vector("eye", "Its position."),
              vector("target", "The point in the middle of the picture.").optional("{0, 0, 0}"),
              axis("up", "The direction that is up in the picture.").defaults("y"),
              number("fov", "Vertical opening angle.")
                  .above(0.0)
                  .between(0.0, 179.0)
                  .in("degrees")
                  .optional("30"),
              number("ortho",
                     "Height of the picture in world units; the camera then has no "
                     "perspective.")
                  .above(0.0)
                  .optional()},
         .results = {{"lissom.Camera", "camera", "The camera."}},
         .errors = {ErrorCode::invalid_argument},
         .example =
             "local camera = lissom.camera{ eye = { 3, 2, 5 }, target = { 0, 1, 0 }, fov = 40 }\n"
             "assert(camera:target()[2] == 1)"},
        {.name = "frame",
         .body = frame_mesh,
         .summary = "The camera of a standard view that shows all of a mesh, as large as the "
                    "margin allows. "
                    "Use it for several pictures that are to be compared.",
         .arguments = {object("mesh", "lissom.Mesh", "The mesh to show.")},
         .options = frame_options,
         .results = {{"lissom.Camera", "camera", "The camera."}},
         .errors = {ErrorCode::invalid_argument},
         .example = "local mesh = lissom.shapes.box()\n"
                    "local camera = lissom.frame(mesh, { view = \"front\" })\n"
                    "local x, y = camera:project{ 0, 0, 0 }\n"
                    "assert(math.abs(x - 640) < 1e-6 and math.abs(y - 480) < 1e-6)"}};
}

}  // namespace lissom::lua
