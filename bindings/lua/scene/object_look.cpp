// How an object of a scene stands and looks, as options and as a table.
#include <optional>
#include <string>
#include <string_view>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/scene/scene_object.h"

namespace lissom::lua {
namespace {

Vec3 color_of(const Call& call, const char* path) {
    if (call.kind(path) == Kind::vector) return call.vector(path);
    const std::string text = call.string(path);
    if (text.size() != 7 || text[0] != '#' ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos) {
        throw Error(
            ErrorCode::invalid_argument,
            "'" + text + "' is no colour; write \"#rrggbb\" or {r, g, b} with parts from 0 to 1");
    }
    const unsigned long rgb = std::stoul(text.substr(1), nullptr, 16);
    const auto part = [&](int shift) { return static_cast<double>(rgb >> shift & 255) / 255.0; };
    return {part(16), part(8), part(0)};
}

void take(const Call& call, const char* path, bool& target) {
    if (call.has(path)) target = call.boolean(path);
}

void take(const Call& call, const char* path, double& target, double factor = 1.0) {
    if (call.has(path)) target = factor * call.number(path);
}

void take(const Call& call, const char* path, std::optional<Vec3>& target) {
    if (call.has(path)) target = color_of(call, path);
}

ObjectStyle changed_style(const Call& call, ObjectStyle style) {
    take(call, "style.color", style.color);
    take(call, "style.vertex_colors", style.vertex_colors);
    if (call.has("style.shading")) style.flat = call.integer("style.shading") == 1;
    take(call, "style.crease", style.crease, kDegree);
    take(call, "style.wire", style.wire);
    take(call, "style.wire_color", style.wire_color);
    take(call, "style.wire_width", style.wire_width);
    take(call, "style.line_width", style.line_width);
    take(call, "style.boundaries", style.boundaries);
    if (call.has("style.region")) style.region = call.string("style.region");
    take(call, "style.handles", style.handles);
    take(call, "style.level", style.level);
    return style;
}

Parameter color_option(const char* name, const char* help) {
    return either(name,
                  {string("text", "\"#rrggbb\"."), vector("rgb", "{r, g, b}, each part 0 to 1.")},
                  help);
}

std::vector<Parameter> object_style_fields() {
    return {
        color_option("color", "Colour of the object, instead of that of its kind.").optional(),
        boolean("vertex_colors", "Draws the attribute \"color\" of a mesh, if any.").optional(),
        choice("shading", {"smooth", "flat"}, "Smooth normals, or one a face.").optional(),
        number("crease", "Edges sharper than this angle stay sharp.")
            .in("degrees")
            .between(0, 180)
            .optional(),
        boolean("wire", "Draws the polygons' edges.").optional(),
        color_option("wire_color", "Their colour.").optional(),
        number("wire_width", "Their width.").in("pixels").above(0).optional(),
        number("line_width", "Width of curves and open boundaries.")
            .in("pixels")
            .above(0)
            .optional(),
        boolean("boundaries", "Draws the loops of open boundaries.").optional(),
        string("region", "The named region of a mesh to draw in a colour of its own; \"\": none.")
            .optional(),
        boolean("handles", "Draws region and handles of a deformation.").optional(),
        number("level", "Part of the strands that is drawn.").between(0, 1).above(0).optional()};
}

void set_color(const Call& call, const char* key, const std::optional<Vec3>& color) {
    if (color) call.set_field(key, call.push_vector(*color));
}

int push_style(const Call& call, const ObjectStyle& style) {
    lua_createtable(call.lua(), 0, 12);
    set_color(call, "color", style.color);
    call.set_field("vertex_colors", call.push(style.vertex_colors));
    call.set_field("shading", call.push(style.flat ? "flat" : "smooth"));
    call.set_field("crease", call.push(style.crease / kDegree));
    call.set_field("wire", call.push(style.wire));
    set_color(call, "wire_color", style.wire_color);
    call.set_field("wire_width", call.push(style.wire_width));
    call.set_field("line_width", call.push(style.line_width));
    call.set_field("boundaries", call.push(style.boundaries));
    call.set_field("region", call.push(std::string_view(style.region)));
    call.set_field("handles", call.push(style.handles));
    call.set_field("level", call.push(style.level));
    return 1;
}

}  // namespace

std::vector<Parameter> look_fields() {
    return {affine("transform",
                   "Its place in the scene: rows of a 4 x 4 matrix. The object's own "
                   "coordinates stay.")
                .optional(),
            boolean("visible", "Whether it is drawn.").optional(),
            options("style", object_style_fields(), "Its style; options that are left out stay.")
                .optional()};
}

ObjectLook changed_look(const Call& call, ObjectLook look) {
    if (call.has("transform")) look.transform = call.affine("transform");
    take(call, "visible", look.visible);
    look.style = changed_style(call, std::move(look.style));
    return look;
}

int push_entry(const Call& call, const NamedObject& object) {
    lua_createtable(call.lua(), 0, 6);
    call.set_field("name", call.push(std::string_view(object.name)));
    call.set_field("number", call.push_count(object.id.value));
    call.set_field("kind", call.push(kind_name(object.item->kind())));
    call.set_field("transform", call.push_affine(object.look.transform));
    call.set_field("visible", call.push(object.look.visible));
    call.set_field("style", push_style(call, object.look.style));
    return 1;
}

std::vector<Record> scene_records() {
    return {
        {"lissom.SceneEntry",
         "An object of a scene.",
         {{"string", "name", "Its name."},
          {"integer", "number", "Its number, which it keeps and which no other gets."},
          {"string", "kind", "mesh, deformation, strands, hairstyle or polyline."},
          {"number[][]", "transform", "Rows of the 4 x 4 matrix from its space to the scene's."},
          {"boolean", "visible", "Whether it is drawn."},
          {"table", "style", "Its appearance; the fields are the options of scene:set."}}},
        {"lissom.HistoryStep",
         "A step of a scene's history.",
         {{"string", "name", "Its name."},
          {"integer", "bytes", "Memory that it added to the history."}}},
        {"lissom.History",
         "The steps of a scene's history, oldest first.",
         {{"lissom.HistoryStep", "[integer]", "The steps in order."},
          {"integer", "place", "Number of those that can be undone; the others can be done again."},
          {"integer", "bytes", "Memory of all steps, beside one copy of the present content."},
          {"integer", "limit", "Limit of `bytes`."},
          {"integer", "dropped", "Number of steps that were forgotten because of it."}}}};
}

}  // namespace lissom::lua
