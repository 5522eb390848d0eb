// lissom.ToolView: marks of a tool over the picture.
#include "bindings/lua/tools/tool_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/core/state.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/gizmo_object.h"

namespace lissom::lua {
namespace {

// Key of Lua's registry: its address. A weak table: the fields of each view.
const char kViewFields = 0;

std::vector<Result> view_fields() {
    return {{"lissom.Camera", "camera", "The camera that the scene is seen by."},
            {"lissom.Scene", "scene", "The scene."},
            {"integer[]", "size", "{width, height} of the picture in pixels."},
            {"\"y\"|\"z\"", "up", "The axis of the world that points up in views."},
            {"number[]?", "cursor", "Position of the cursor, if it is known."}};
}
constexpr const char* kUsualHandleColor = "#e8a33d";
const std::string kChosenColor = "#ffd24a";

// ---- Bodies

bool is_color(const char* text) {
    return std::strlen(text) == 7 && text[0] == '#' &&
           std::strspn(text + 1, "0123456789abcdefABCDEF") == 6;
}

// Refuses values that are no colours; to be called before anything is made.
void require_color(const Call& call) {
    if (call.has("color") && !is_color(call.string("color"))) {
        call.reject("color", "\"#rrggbb\" expected");
    }
}

std::string color_of(const Call& call) {
    return call.has("color") ? call.string("color") : "";
}

std::vector<Vec3> point_list(const Call& call, const char* path) {
    const std::span<const Vec3> given = call.points(path);
    return {given.begin(), given.end()};
}

// ---- Memory of marks

std::size_t bytes_of(const std::vector<Vec3>& points) {
    return points.size() * sizeof(Vec3);
}
std::size_t bytes_of(const PointMarks& mark) {
    return sizeof mark + bytes_of(mark.points);
}
std::size_t bytes_of(const LineMark& mark) {
    return sizeof mark + bytes_of(mark.points);
}
std::size_t bytes_of(const LabelMark& mark) {
    return sizeof mark + mark.text.size();
}
std::size_t bytes_of(const OutlineMark& mark) {
    return sizeof mark + mark.pixels.size() * sizeof(Vec2);
}
std::size_t bytes_of(const CircleMark& mark) {
    return sizeof mark;
}
std::size_t bytes_of(const RegionMark& mark) {
    return sizeof mark;
}
std::size_t bytes_of(const SurfaceMark& mark) {
    return sizeof mark + bytes_of(mark.from) + bytes_of(mark.to);
}
std::size_t bytes_of(const MeshMark& mark) {
    return sizeof mark;
}

// Lists of marks grow to twice their size; colours are short.
template <typename Mark>
void keep_mark(const Call& call, ToolViewObject& view, std::vector<Mark>& list, Mark mark) {
    const std::size_t bytes = sizeof mark + bytes_of(mark);
    call.reserve(&view, bytes);
    list.push_back(std::move(mark));
    view.mark_bytes += bytes;
}

// Adds the result of `make` to a list of the view; returns the view.
template <typename Mark, typename Make>
int add_mark(Call& call, std::vector<Mark> ToolViewObject::*list, const Make& make) {
    require_color(call);
    const auto view = call.self<ToolViewObject>();
    const bool done =
        call.attempt_quick([&] { keep_mark(call, *view, view.get()->*list, make()); });
    if (!done) return call.fail();
    call.charge(view);
    return call.push_argument();
}

int draw_points(Call& call) {
    return add_mark(call, &ToolViewObject::points, [&] {
        return PointMarks{point_list(call, "points"), color_of(call), call.number("radius")};
    });
}

int draw_line(Call& call) {
    return add_mark(call, &ToolViewObject::lines, [&] {
        return LineMark{point_list(call, "points"), color_of(call), call.number("width"),
                        call.boolean("closed")};
    });
}

int draw_label(Call& call) {
    return add_mark(call, &ToolViewObject::labels, [&] {
        return LabelMark{call.vector("at"), call.string("text"), color_of(call)};
    });
}

int draw_outline(Call& call) {
    return add_mark(call, &ToolViewObject::outlines, [&] {
        OutlineMark mark{{},
                         color_of(call),
                         call.number("width"),
                         call.number("opacity"),
                         call.boolean("closed")};
        for (const auto& [x, y] : call.pixels("pixels")) mark.pixels.emplace_back(x, y);
        return mark;
    });
}

int draw_circle(Call& call) {
    const std::span<const double> at = call.numbers("at");
    if (at.size() != 2) call.reject("at", "{x, y} expected");
    return add_mark(call, &ToolViewObject::circles, [&] {
        return CircleMark{{at[0], at[1]}, call.number("radius"), color_of(call)};
    });
}

int draw_region(Call& call) {
    return add_mark(call, &ToolViewObject::regions, [&] {
        const auto region = call.object<RegionObject>("region");
        return RegionMark{call.has("mesh") ? call.object<MeshObject>("mesh").share() : region->mesh,
                          region->region, color_of(call)};
    });
}

int draw_surface(Call& call) {
    if (call.points("from").size() != call.points("to").size()) {
        call.reject("to", "as many points as in 'from' expected");
    }
    return add_mark(call, &ToolViewObject::surfaces, [&] {
        return SurfaceMark{point_list(call, "from"), point_list(call, "to"), color_of(call),
                           call.number("opacity")};
    });
}

int draw_mesh(Call& call) {
    return add_mark(call, &ToolViewObject::meshes, [&] {
        return MeshMark{call.object<MeshObject>("mesh").share(),
                        call.has("transform") ? call.affine("transform") : Affine(),
                        color_of(call)};
    });
}

int draw_handle(Call& call) {
    return add_mark(call, &ToolViewObject::points, [&] {
        return PointMarks{{call.vector("at")}, call.string("color"), call.number("radius")};
    });
}

std::string hexadecimal(const Vec3& color) {
    std::array<char, 8> text{};
    const auto byte = [&](int k) {
        return static_cast<int>(std::lround(255.0 * std::clamp(color[k], 0.0, 1.0)));
    };
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", byte(0), byte(1), byte(2));
    return text.data();
}

// Pushes a field of the view at stack index 1, or nil.
void push_field(lua_State* L, const char* name) {
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kViewFields);
    lua_pushvalue(L, 1);
    lua_rawget(L, -2);
    lua_getfield(L, -1, name);
    lua_replace(L, -3);
    lua_pop(L, 1);
}

double item(lua_State* L, int list, int i) {
    lua_rawgeti(L, list, i);
    const double value = lua_tonumber(L, -1);
    lua_pop(L, 1);
    return value;
}

// The part of a gizmo that is held, else the one under the cursor.
std::optional<GizmoPart> part_in_hand(const GizmoObject& gizmo, const View& view,
                                      const std::optional<Vec2>& cursor) {
    if (gizmo.drag) return gizmo.drag->part();
    return cursor ? gizmo.gizmo.hit(view, *cursor) : std::nullopt;
}

int draw_gizmo(Call& call) {
    lua_State* L = call.lua();
    const auto self = call.self<ToolViewObject>();
    const auto gizmo = call.object<GizmoObject>("gizmo");
    push_field(L, "camera");
    const Holder* camera = find_holder(L, -1, CameraObject::kTypeName);
    push_field(L, "size");
    const int size = lua_gettop(L);
    const double width = item(L, size, 1), height = item(L, size, 2);
    if (!camera || !camera->object) call.raise("the camera of the view was closed");
    if (!(width >= 1.0 && height >= 1.0)) call.raise("the size of the view was changed");
    push_field(L, "cursor");
    const int at = lua_gettop(L);
    const bool has_cursor = lua_istable(L, at);
    const double x = has_cursor ? item(L, at, 1) : 0.0, y = has_cursor ? item(L, at, 2) : 0.0;
    const bool done = call.attempt_quick([&] {
        const View view{static_cast<CameraObject*>(camera->object.get())->camera, {width, height}};
        const GizmoShape shape = gizmo->shown().shape(view);
        const auto held =
            part_in_hand(*gizmo, view, has_cursor ? std::optional(Vec2(x, y)) : std::nullopt);
        const std::string chosen = call.has("chosen") ? call.string("chosen") : "";
        const auto color = [&](GizmoPart part, GizmoRole role) {
            if (part_name(part) == chosen) return kChosenColor;
            return hexadecimal(role_color(role, held && *held == part));
        };
        for (const GizmoLine& line : shape.lines) {
            keep_mark(call, *self, self->lines,
                      {line.points, color(line.part, line.role), line.width, line.closed});
        }
        for (const GizmoPoint& point : shape.points) {
            keep_mark(call, *self, self->points,
                      {{point.position}, color(point.part, point.role), point.radius});
        }
    });
    if (!done) return call.fail();
    call.charge(self);
    return call.push_argument();
}

// Fields come before methods; a view without a cursor has nil.
int get_field(Call& call) {
    lua_State* L = call.lua();
    const char* key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : "";
    for (const char* name : {"camera", "scene", "size", "up", "cursor"}) {
        if (std::strcmp(name, key) != 0) continue;
        push_field(L, name);
        return 1;
    }
    return 0;
}

// ---- Marks as tables

template <typename Mark, typename Push>
void set_list(const Call& call, const char* key, const std::vector<Mark>& list, const Push& push) {
    lua_State* L = call.lua();
    push_list(call, list, [&](const Mark& mark) {
        lua_createtable(L, 0, 4);
        push(mark);
        if (!mark.color.empty()) call.set_field("color", call.push(mark.color));
    });
    call.set_field(key);
}

void set_points(const Call& call, const char* key, const std::vector<Vec3>& points) {
    push_list(call, points, [&](const Vec3& point) { call.push_vector(point); });
    call.set_field(key);
}

void push_pixel(const Call& call, const Vec2& pixel) {
    call.push_numbers(std::array{pixel.x(), pixel.y()});
}

void set_lines(const Call& call, const ToolViewObject& view) {
    set_list(call, "points", view.points, [&](const PointMarks& mark) {
        set_points(call, "points", mark.points);
        call.set_field("radius", call.push(mark.radius));
    });
    set_list(call, "lines", view.lines, [&](const LineMark& mark) {
        set_points(call, "points", mark.points);
        call.set_field("width", call.push(mark.width));
        call.set_field("closed", call.push(mark.closed));
    });
    set_list(call, "labels", view.labels, [&](const LabelMark& mark) {
        call.set_field("at", call.push_vector(mark.at));
        call.set_field("text", call.push(mark.text));
    });
}

void set_outlines(const Call& call, const ToolViewObject& view) {
    set_list(call, "outlines", view.outlines, [&](const OutlineMark& mark) {
        push_list(call, mark.pixels, [&](const auto& pixel) { push_pixel(call, pixel); });
        call.set_field("pixels");
        call.set_field("width", call.push(mark.width));
        call.set_field("opacity", call.push(mark.opacity));
        call.set_field("closed", call.push(mark.closed));
    });
    set_list(call, "circles", view.circles, [&](const CircleMark& mark) {
        push_pixel(call, mark.at);
        call.set_field("at");
        call.set_field("radius", call.push(mark.radius));
    });
}

void set_surfaces(Call& call, const ToolViewObject& view) {
    set_list(call, "surfaces", view.surfaces, [&](const SurfaceMark& mark) {
        set_points(call, "from", mark.from);
        set_points(call, "to", mark.to);
        call.set_field("opacity", call.push(mark.opacity));
    });
    set_list(call, "regions", view.regions, [&](const RegionMark& mark) {
        call.set_field("mesh", call.push_shared(mark.mesh));
        const auto region = call.create<RegionObject>();
        const bool done = call.attempt_quick(
            [&] { region.set(std::make_shared<RegionObject>(mark.mesh, mark.region)); });
        if (!done) call.fail();
        call.set_field("region");
    });
    set_list(call, "meshes", view.meshes, [&](const MeshMark& mark) {
        call.set_field("mesh", call.push_shared(mark.mesh));
        call.set_field("transform", call.push_affine(mark.transform));
    });
}

// ---- Descriptions

Parameter color_option() {
    return string("color", "\"#rrggbb\".").optional("the usual one").elsewhere({"colour"});
}

Parameter pixel_number(const char* name, const char* help, double usual) {
    const bool is_width = std::strcmp(name, "width") == 0;
    return number(name, help)
        .at_least(0)
        .in("pixels")
        .defaults(usual)
        .elsewhere(is_width ? std::vector<std::string>{"thickness"}
                            : std::vector<std::string>{"size", "r"});
}

Parameter opacity_option(double usual) {
    return number("opacity", "From 0, nothing, to 1.")
        .at_least(0)
        .defaults(usual)
        .elsewhere({"alpha"});
}

// Other names of a place.
std::vector<std::string> place_names() {
    return {"center", "centre", "position", "pos", "point"};
}

// A tool that draws by `text`, of which `count` marks come in the list `list`.
std::string view_example(const std::string& text, const std::string& list) {
    return R"(local scene = lissom.scene{}
scene:add("ball", lissom.shapes.sphere())
local tool = lissom.tool{ name = "marks", draw = function(_, view) )" +
           text + R"( end }
local camera = lissom.camera{ eye = { 0, 0, 5 } }
local host = lissom.tool_host{ scene = scene, camera = camera, tool = tool }
assert(#host:draw().)" +
           list + " > 0)";
}

Function view_method(const char* name, Body body, const char* summary,
                     std::vector<Parameter> fields, const std::string& text,
                     const std::string& list) {
    return {.name = name,
            .body = body,
            .summary = summary,
            .options = std::move(fields),
            .results = {{"lissom.ToolView", "view", "The view itself."}},
            .example = view_example(text, list)};
}

std::vector<Function> line_methods() {
    const std::vector<Parameter> fields{
        points("points", "Points of the world."), color_option(),
        pixel_number("width", "Its width.", 3.0),
        boolean("closed", "Goes back to its first point.").defaults(false)};
    const std::string points_of_line = "points = { { 0, 0, 0 }, { 0, 1, 0 } }";
    return {view_method("line", draw_line, "Draws a line in the world.", fields,
                        "view:line{ " + points_of_line + ", width = 2 }", "lines"),
            view_method("curve", draw_line, "Draws a line in the world, as line.", fields,
                        "view:curve{ " + points_of_line + " }", "lines"),
            view_method("outline", draw_outline, "Draws a line in the picture.",
                        {pixels("pixels", "From the top left corner of the picture."),
                         color_option(), pixel_number("width", "Its width.", 1.5),
                         boolean("closed", "Goes back to its first pixel.").defaults(false),
                         opacity_option(1.0)},
                        "view:outline{ pixels = { { 1, 1 }, { 9, 5 } } }", "outlines"),
            view_method("circle", draw_circle, "Draws a circle in the picture.",
                        {numbers("at", "Its middle, {x, y}.").elsewhere(place_names()),
                         pixel_number("radius", "Its radius.", 20.0), color_option()},
                        "view:circle{ at = { 320, 240 }, radius = 30 }", "circles")};
}

std::vector<Function> point_methods() {
    return {view_method("points", draw_points, "Draws balls at points of the world.",
                        {points("points", "The points."), color_option(),
                         pixel_number("radius", "Their radius.", 5.0)},
                        "view:points{ points = { { 0, 0, 1 } }, color = '#ff0000' }", "points"),
            view_method("handle", draw_handle, "Draws a ball to take hold of.",
                        {vector("at", "A point of the world.").elsewhere(place_names()),
                         string("color", "\"#rrggbb\".").defaults(kUsualHandleColor),
                         pixel_number("radius", "Its radius.", 7.0)},
                        "view:handle{ at = { 0, 0, 1 } }", "points"),
            view_method(
                "label", draw_label, "Writes text at a point of the world; long lines are wrapped.",
                {vector("at", "The point.").elsewhere(place_names()),
                 string("text", "The text.").defaults("").elsewhere({"label"}), color_option()},
                "view:label{ at = { 0, 0, 1 }, text = 'here' }", "labels")};
}

std::vector<Function> surface_methods() {
    return {
        view_method(
            "region", draw_region, "Colours vertices of a mesh of the scene.",
            {object("region", "lissom.Region", "The vertices."),
             object("mesh", "lissom.Mesh", "The mesh.").optional("the region's"), color_option()},
            "local mesh = view.scene:get('ball') "
            "view:region{ mesh = mesh, region = mesh:region{ all = true } }",
            "regions"),
        view_method("surface", draw_surface,
                    "Draws a surface between two lines of as many points, which is seen through.",
                    {points("from", "A line of the world."), points("to", "The other line."),
                     color_option(), opacity_option(0.25)},
                    "view:surface{ from = { { 0, 0, 0 }, { 1, 0, 0 } }, "
                    "to = { { 0, 1, 0 }, { 1, 1, 0 } } }",
                    "surfaces"),
        view_method("mesh", draw_mesh,
                    "Draws a mesh that is not in the scene, before the surfaces that it lies on; "
                    "it must not change afterwards.",
                    {object("mesh", "lissom.Mesh", "The mesh."),
                     affine("transform", "Its place in the world.")
                         .optional("the identity")
                         .elsewhere({"matrix"}),
                     color_option()},
                    "view:mesh{ mesh = lissom.shapes.box() }", "meshes")};
}

Function gizmo_method() {
    return {.name = "gizmo",
            .body = draw_gizmo,
            .summary = "Draws a gizmo as it is seen now.",
            .arguments = {object("gizmo", "lissom.Gizmo", "The gizmo."),
                          string("chosen", "The part that is drawn as the one in hand.")
                              .optional("the one under the cursor")},
            .results = {{"lissom.ToolView", "view", "The view itself."}},
            .example = view_example("view:gizmo(lissom.gizmo{ mode = 'move' })", "lines")};
}

}  // namespace

Type tool_view_type() {
    Type type;
    type.name = ToolViewObject::kTypeName;
    type.summary = "A tool draws on it, over the picture. Each method returns the view.";
    type.fields = view_fields();
    type.is_heard = false;
    type.operators = {{"__index", get_field, "view.camera", "one of the fields"}};
    for (auto* methods : {point_methods, line_methods, surface_methods}) {
        for (Function& method : methods()) type.methods.push_back(std::move(method));
    }
    type.methods.push_back(gizmo_method());
    return type;
}

int new_tool_view(lua_State* L) {
    static const Operator kMake{.name = "__call"};
    luaL_checktype(L, 1, LUA_TTABLE);
    Call call(L, *find_state(L), kMake);
    const auto view = call.create<ToolViewObject>();
    if (!call.attempt_quick([&] { view.set(std::make_shared<ToolViewObject>()); })) {
        return call.fail();
    }
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kViewFields);
    if (!lua_istable(L, -1)) {
        lua_pop(L, 1);
        lua_newtable(L);
        lua_createtable(L, 0, 1);
        lua_pushliteral(L, "k");
        lua_setfield(L, -2, "__mode");
        lua_setmetatable(L, -2);
        lua_pushvalue(L, -1);
        raw_set_pointer(L, LUA_REGISTRYINDEX, &kViewFields);
    }
    lua_pushvalue(L, -2);
    lua_pushvalue(L, 1);
    lua_rawset(L, -3);
    lua_pop(L, 1);
    return 1;
}

int push_tool_marks(lua_State* L) {
    static const Operator kRead{.name = "__call"};
    const Holder* holder = find_holder(L, 1, ToolViewObject::kTypeName);
    if (!holder || !holder->object) return luaL_error(L, "a view of a tool expected");
    luaL_checkstack(L, LUA_MINSTACK, "no room for marks");
    Call call(L, *find_state(L), kRead);
    const auto& view = *static_cast<const ToolViewObject*>(holder->object.get());
    lua_createtable(L, 0, 8);
    set_lines(call, view);
    set_outlines(call, view);
    set_surfaces(call, view);
    return 1;
}

}  // namespace lissom::lua
