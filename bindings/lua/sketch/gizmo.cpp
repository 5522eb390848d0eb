// lissom.gizmo: Gizmo.
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/gizmo_object.h"

namespace lissom::lua {
namespace {

constexpr const char* kMotionNames[] = {"move", "rotate", "scale"};
constexpr const char* kRoleNames[] = {"x", "y", "z", "view"};

// ---- Reading

// Returns the options with those of the call.
GizmoOptions changed_options(const Call& call, GizmoOptions options) {
    if (call.has("origin")) options.origin = call.vector("origin");
    if (call.has("mode")) options.mode = call.choice<GizmoMode>("mode");
    if (call.has("axes")) options.axes = call.choice<GizmoAxes>("axes");
    if (call.has("local_axes")) options.local = call.matrix3("local_axes");
    if (call.has("size")) options.size = call.number("size");
    return options;
}

GizmoSteps changed_steps(const Call& call, GizmoSteps steps) {
    if (call.has("steps.length")) steps.length = call.number("steps.length");
    if (call.has("steps.angle")) steps.angle = call.number("steps.angle") * kDegree;
    if (call.has("steps.factor")) steps.factor = call.number("steps.factor");
    return steps;
}

View view_of(const Call& call) {
    return {call.object<CameraObject>("camera")->camera, SizeRequest::picture(call)};
}

Vec2 cursor_of(const Call& call) {
    return {call.number("x"), call.number("y")};
}

GizmoDrag& drag_of(const Call& call) {
    const auto self = call.self<GizmoObject>();
    if (!self->drag) call.raise("the gizmo is not held; begin a drag first");
    return *self->drag;
}

// ---- Pushing

int push_motion(const Call& call, const GizmoDrag& drag) {
    const GizmoMotion& motion = drag.motion();
    const bool in_plane = drag.part() >= GizmoPart::move_yz && drag.part() <= GizmoPart::move_view;
    std::array<double, 2> amounts{motion.amount.x(), motion.amount.y()};
    if (motion.kind == GizmoKind::rotate) amounts[0] /= kDegree;
    lua_createtable(call.lua(), 0, 9);
    call.set_field("kind", call.push(kMotionNames[static_cast<int>(motion.kind)]));
    call.set_field("part", call.push(part_name(drag.part())));
    call.set_field("about", call.push_vector(motion.origin));
    call.set_field("matrix", call.push_affine(motion.affine()));
    call.set_field("amounts", call.push_numbers(std::span(amounts.data(), in_plane ? 2 : 1)));
    if (motion.kind == GizmoKind::move) {
        call.set_field("translation", call.push_vector(motion.translation));
    } else if (motion.kind == GizmoKind::rotate) {
        call.set_field("axis", call.push_vector(motion.axis));
        call.set_field("angle", call.push(motion.angle / kDegree));
    } else {
        call.set_field("factors", call.push_vector(motion.factors));
    }
    return 1;
}

int push_part(const Call& call, const std::optional<GizmoPart>& part) {
    if (part) return call.push(part_name(*part));
    lua_pushnil(call.lua());
    return 1;
}

// The fields that lines and points share, into the table on top of the stack.
void push_look(const Call& call, GizmoPart part, GizmoRole role, bool highlighted) {
    call.set_field("part", call.push(part_name(part)));
    call.set_field("role", call.push(kRoleNames[static_cast<int>(role)]));
    call.set_field("color", call.push_vector(role_color(role, highlighted)));
    call.set_field("highlighted", call.push(highlighted));
}

void push_lines(const Call& call, const GizmoShape& shape, const std::optional<GizmoPart>& held) {
    lua_State* L = call.lua();
    push_list(call, shape.lines, [&](const GizmoLine& line) {
        lua_createtable(L, 0, 7);
        push_look(call, line.part, line.role, held == line.part);
        push_list(call, line.points, [&](const Vec3& point) { call.push_vector(point); });
        call.set_field("points");
        call.set_field("closed", call.push(line.closed));
        call.set_field("width", call.push(line.width));
    });
}

void push_points(const Call& call, const GizmoShape& shape, const std::optional<GizmoPart>& held) {
    lua_State* L = call.lua();
    push_list(call, shape.points, [&](const GizmoPoint& point) {
        lua_createtable(L, 0, 6);
        push_look(call, point.part, point.role, held == point.part);
        call.set_field("position", call.push_vector(point.position));
        call.set_field("radius", call.push(point.radius));
    });
}

// ---- Bodies

int make_gizmo(Call& call) {
    const auto result = call.create<GizmoObject>();
    const bool done = call.attempt_quick([&] {
        const Gizmo gizmo(changed_options(call, {}));
        result.set(std::make_shared<GizmoObject>(
            GizmoObject{gizmo, changed_steps(call, {}), std::nullopt}));
    });
    return done ? 1 : call.fail();
}

int set_gizmo(Call& call) {
    const auto self = call.self<GizmoObject>();
    if (self->drag) call.raise("the gizmo is held; finish or cancel the drag first");
    const bool done = call.attempt_quick([&] {
        self->gizmo = Gizmo(changed_options(call, self->gizmo.options()));
        self->steps = changed_steps(call, self->steps);
    });
    return done ? call.push_argument() : call.fail();
}

int gizmo_origin(Call& call) {
    return call.push_vector(call.self<GizmoObject>()->shown().origin());
}

int gizmo_axes(Call& call) {
    const auto self = call.self<GizmoObject>();
    const Mat3 axes = self->shown().axes(call.object<CameraObject>("camera")->camera);
    for (int k = 0; k < 3; ++k) call.push_vector(axes.col(k));
    return 3;
}

int hit_gizmo(Call& call) {
    const auto self = call.self<GizmoObject>();
    std::optional<GizmoPart> part;
    const bool done = call.attempt_quick(
        [&] { part = self->shown().hit(view_of(call), cursor_of(call), call.number("reach")); });
    return done ? push_part(call, part) : call.fail();
}

int begin_drag(Call& call) {
    const auto self = call.self<GizmoObject>();
    const bool done = call.attempt_quick([&] {
        const auto part = call.choice<GizmoPart>("part");
        self->drag.emplace(self->shown(), part, view_of(call), cursor_of(call), self->steps);
    });
    return done ? call.push_argument() : call.fail();
}

int drag_gizmo(Call& call) {
    GizmoDrag& drag = drag_of(call);
    const GizmoModifiers modifiers{.snap = call.boolean("snap"),
                                   .precise = call.boolean("precise")};
    if (!call.attempt_quick([&] { drag.drag(cursor_of(call), modifiers); })) return call.fail();
    return push_motion(call, drag);
}

int set_amount(Call& call) {
    GizmoDrag& drag = drag_of(call);
    const double unit = drag.motion().kind == GizmoKind::rotate ? kDegree : 1.0;
    const double first = unit * call.number("first");
    const double second = call.has("second") ? call.number("second") : 0.0;
    if (!call.attempt_quick([&] { drag.set_amount(Vec2(first, second)); })) return call.fail();
    return push_motion(call, drag);
}

int held_part(Call& call) {
    const auto self = call.self<GizmoObject>();
    return push_part(call, self->drag ? std::optional(self->drag->part()) : std::nullopt);
}

int motion(Call& call) {
    const auto self = call.self<GizmoObject>();
    if (self->drag) return push_motion(call, *self->drag);
    lua_pushnil(call.lua());
    return 1;
}

int finish_drag(Call& call) {
    const GizmoDrag& drag = drag_of(call);
    const auto self = call.self<GizmoObject>();
    push_motion(call, drag);
    const bool done = call.attempt_quick([&] {
        self->gizmo = drag.moved();
        self->drag.reset();
    });
    return done ? 1 : call.fail();
}

int cancel_drag(Call& call) {
    call.self<GizmoObject>()->drag.reset();
    return call.push_argument();
}

int gizmo_shape(Call& call) {
    const auto self = call.self<GizmoObject>();
    auto& shape = call.hold<GizmoShape>();
    std::optional<GizmoPart> held;
    const bool done = call.attempt_quick([&] {
        const View view = view_of(call);
        const Gizmo gizmo = self->shown();
        shape = gizmo.shape(view);
        if (self->drag) {
            held = self->drag->part();
        } else if (call.has("x") && call.has("y")) {
            held = gizmo.hit(view, cursor_of(call));
        }
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 3);
    push_lines(call, shape, held);
    call.set_field("lines");
    push_points(call, shape, held);
    call.set_field("points");
    call.set_field("part", push_part(call, held));
    return 1;
}

int gizmo_text(Call& call) {
    const auto self = call.self<GizmoObject>();
    const Vec3 origin = self->shown().origin();
    char text[160];
    std::snprintf(text, sizeof text, "lissom.Gizmo (at %.6g, %.6g, %.6g%s)", origin.x(), origin.y(),
                  origin.z(), self->drag ? ", held" : "");
    return call.push(std::string_view(text));
}

// ---- Descriptions

std::vector<std::string> part_names() {
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(GizmoPart::scale_all); ++i) {
        names.emplace_back(part_name(static_cast<GizmoPart>(i)));
    }
    return names;
}

std::vector<Parameter> gizmo_options() {
    return {
        vector("origin", "The point that it stands at, and that turns and scaling are about.")
            .optional("{0, 0, 0}"),
        choice("mode", {"move", "rotate", "scale", "all"}, "Mode of its parts.").optional("all"),
        choice("axes", {"world", "local", "view"},
               "Directions of its axes: the world's, those of `local_axes`, or to the right, "
               "upwards and to the viewer.")
            .optional("world"),
        matrix3("local_axes", "Rows of a rotation; its columns are the object's axes.").optional(),
        number("size", "Length of an axis, the same at every distance.")
            .above(0)
            .in("pixels")
            .optional("90"),
        options("steps",
                {number("length", "Of moves.")
                     .above(0)
                     .optional("1, 2 or 5 times a power of ten that is seen as 10 pixels or more"),
                 number("angle", "Of turns.").above(0).in("degrees").optional("15"),
                 number("factor", "Of scaling.").above(0).optional("0.1")},
                "The steps of snapping.")
            .optional()};
}

Parameter camera_argument() {
    return object("camera", "lissom.Camera", "The camera that it is seen by.");
}

Parameter picture_argument() {
    Parameter size = size_argument();
    size.required = true;
    size.default_text.clear();
    return size;
}

std::vector<Parameter> cursor_arguments() {
    return {camera_argument(), picture_argument(), number("x", "Pixels from the left."),
            number("y", "Pixels from the top.")};
}

std::vector<Function> gizmo_methods() {
    const std::string setup =
        "local gizmo = lissom.gizmo{ mode = \"move\" }\n"
        "local camera = lissom.camera{ eye = { 0, 0, 5 }, ortho = 4.8 }\n"
        "local size = { 640, 480 }                   -- a pixel is a hundredth\n";
    const std::string held = setup + "gizmo:begin(\"move-x\", camera, size, 380, 240)\n";
    const Result motion_result{"lissom.GizmoMotion", "motion", "The motion since begin."};
    const Result self_result{"lissom.Gizmo", "gizmo", "The gizmo itself."};
    std::vector<Parameter> begin_arguments = cursor_arguments();
    begin_arguments.insert(begin_arguments.begin(),
                           choice("part", part_names(), "The part, as hit names it."));
    return {
        {.name = "hit",
         .body = hit_gizmo,
         .summary = "The part under a pixel. Axes that are seen end-on and planes from the side "
                    "are not offered.",
         .arguments = cursor_arguments(),
         .options = {number("reach", "Distance within which a part is picked.")
                         .at_least(0)
                         .defaults(7.0)
                         .in("pixels")},
         .results =
             {{"string?", "part",
               "\"move-x\", \"move-yz\", \"rotate-view\", \"scale-all\", ...; nil for none."}},
         .example = setup + "assert(gizmo:hit(camera, size, 380, 241) == \"move-x\")"},
        {.name = "begin",
         .body = begin_drag,
         .summary = "Begins a drag: holds a part at the pixel. The camera is that of the whole "
                    "drag.",
         .arguments = begin_arguments,
         .results = {self_result},
         .errors = {ErrorCode::invalid_argument},
         .example = held + "assert(gizmo:part() == \"move-x\")"},
        {.name = "drag",
         .body = drag_gizmo,
         .summary =
             "The pixel has moved. The part stays under it, but lags behind in degenerate "
             "views: end-on, from the side, near the horizon. A pixel that is back undoes all "
             "but full turns.",
         .arguments = {number("x", "Pixels from the left."), number("y", "Pixels from the top.")},
         .options = {boolean("snap", "Whole steps only, counted from begin.").defaults(false),
                     boolean("precise", "A tenth as far, from here on.").defaults(false)},
         .results = {motion_result},
         .example = held + R"(assert(math.abs(gizmo:drag(405, 300).translation[1] - 0.25) < 1e-12)
assert(math.abs(gizmo:drag(405, 300, { snap = true }).translation[1] - 0.3) < 1e-12))"},
        {.name = "set_amount",
         .body = set_amount,
         .summary = "A typed number in place of the pixel, not snapped: a length along the axis, "
                    "degrees, a factor; in a plane two lengths along its axes.",
         .arguments = {number("first", "The number."),
                       number("second", "The second, in a plane.").optional("0")},
         .results = {motion_result},
         .errors = {ErrorCode::invalid_argument},
         .example = held + "assert(gizmo:set_amount(2.5).translation[1] == 2.5)"},
        {.name = "motion",
         .body = motion,
         .summary = "The motion since begin; nil if no part is held.",
         .results = {{"lissom.GizmoMotion?", "motion", "Same as drag returned."}},
         .example = held + "assert(gizmo:motion().translation[1] == 0)"},
        {.name = "part",
         .body = held_part,
         .summary = "The part that is held.",
         .results = {{"string?", "part", "nil if none is."}},
         .example = setup + "assert(gizmo:part() == nil)"},
        {.name = "finish",
         .body = finish_drag,
         .summary = "Ends the drag. The gizmo keeps its moved place.",
         .results = {motion_result},
         .example = held + R"(gizmo:set_amount(2)
gizmo:finish()
assert(gizmo:origin()[1] == 2 and gizmo:motion() == nil))"},
        {.name = "cancel",
         .body = cancel_drag,
         .summary = "Ends the drag, if there is one. The gizmo goes back to its former place.",
         .results = {self_result},
         .example = held + R"(gizmo:set_amount(2)
assert(gizmo:cancel():origin()[1] == 0))"},
        {.name = "set",
         .body = set_gizmo,
         .summary = "Changes options; those that are left out stay.",
         .options = gizmo_options(),
         .results = {self_result},
         .errors = {ErrorCode::invalid_argument},
         .example = setup + "assert(gizmo:set{ origin = { 1, 2, 3 } }:origin()[3] == 3)"},
        {.name = "origin",
         .body = gizmo_origin,
         .summary = "Its position; during a drag the moved one.",
         .results = {{"number[]", "point", "{x, y, z}."}},
         .example = setup + "assert(gizmo:origin()[1] == 0)"},
        {.name = "axes",
         .body = gizmo_axes,
         .summary = "Its three axes in a view, of unit length.",
         .arguments = {camera_argument()},
         .results = {{"number[]", "x", "The first."},
                     {"number[]", "y", "The second."},
                     {"number[]", "z", "The third."}},
         .example = setup + "local x, y, z = gizmo:axes(camera)\nassert(y[2] == 1)"},
        {.name = "shape",
         .body = gizmo_shape,
         .summary = "Shape to draw; the part that is held, or else under a pixel, is highlighted.",
         .arguments = {camera_argument(), picture_argument()},
         .options = {number("x", "The pixel, from the left.").optional(),
                     number("y", "The pixel, from the top.").optional()},
         .results = {{"lissom.GizmoShape", "shape", "Empty if it lies behind the camera."}},
         .example = setup + R"(local shape = gizmo:shape(camera, size, { x = 380, y = 240 })
assert(shape.part == "move-x" and #shape.lines > 0 and #shape.points == 1))"}};
}

}  // namespace

Type gizmo_type() {
    Type type;
    type.name = GizmoObject::kTypeName;
    type.is_heard = false;
    type.summary =
        "Axes, planes and rings around a point, by which a hand moves, turns and scales. It draws "
        "nothing and moves nothing: it returns the shape to draw, the part under a pixel, and "
        "the motion of a drag.";
    type.operators = {{"__tostring", gizmo_text, "tostring(gizmo)", "its position"}};
    type.methods = gizmo_methods();
    return type;
}

std::vector<Function> gizmo_functions() {
    return {{.name = "gizmo",
             .body = make_gizmo,
             .summary = "A gizmo for moving, turning and scaling by hand.",
             .options = gizmo_options(),
             .results = {{"lissom.Gizmo", "gizmo", "The gizmo."}},
             .errors = {ErrorCode::invalid_argument},
             .example = R"(local gizmo = lissom.gizmo{ origin = { 0, 1, 0 }, mode = "rotate" }
local camera = lissom.camera{ eye = { 0, 1, 5 }, target = { 0, 1, 0 } }
gizmo:begin("rotate-z", camera, { 640, 480 }, 410, 240)
local motion = gizmo:drag(320, 150)
assert(math.abs(motion.angle - 90) < 1e-9 and motion.axis[3] == 1))"}};
}

std::vector<Record> gizmo_records() {
    return {
        {"lissom.GizmoMotion",
         "Motion of a drag. `matrix` is all of it, as handle:set_matrix takes it; "
         "mesh:transform takes its parts if the axes are the world's.",
         {{"string", "kind", "move, rotate or scale."},
          {"string", "part", "The part that is held."},
          {"lissom.Vector?", "translation", "Translation of a move."},
          {"lissom.Vector?", "axis", "Axis of a turn; unit length."},
          {"number?", "angle", "Angle of a turn, in degrees; counts full turns."},
          {"lissom.Vector?", "factors", "Factors of scaling, along the gizmo's axes."},
          {"lissom.Vector", "about",
           "Former position of the gizmo: the centre of turns and scaling."},
          {"number[][]", "matrix", "All of it as the rows of a 4 x 4 matrix of the world."},
          {"number[]", "amounts",
           "The value for set_amount: a length, degrees or a factor, or two lengths in a plane."}}},
        {"lissom.GizmoShape",
         "Shape to draw.",
         {{"lissom.GizmoLine[]", "lines", "Polylines."},
          {"lissom.GizmoPoint[]", "points", "Disks."},
          {"string?", "part", "The part that is highlighted."}}},
        {"lissom.GizmoLine",
         "A polyline of a gizmo.",
         {{"string", "part", "The part that it belongs to."},
          {"string", "role", "x, y, z or view."},
          {"number[]", "color", "{red, green, blue} in sRGB, each 0 to 1."},
          {"boolean", "highlighted", "Held or under the pixel."},
          {"lissom.Vector[]", "points", "In the world."},
          {"boolean", "closed", "The last point is joined to the first."},
          {"number", "width", "Pixels."}}},
        {"lissom.GizmoPoint",
         "A disk of a gizmo.",
         {{"string", "part", "The part that it belongs to."},
          {"string", "role", "x, y, z or view."},
          {"number[]", "color", "{red, green, blue} in sRGB, each 0 to 1."},
          {"boolean", "highlighted", "Held or under the pixel."},
          {"lissom.Vector", "position", "In the world."},
          {"number", "radius", "Pixels."}}}};
}

}  // namespace lissom::lua
