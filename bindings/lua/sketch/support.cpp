// lissom.Support: surfaces for strokes about a curve; and the meaning of hint strokes.
#include <cmath>
#include <string_view>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/support_object.h"
#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/hint.h"

namespace lissom::lua {
namespace {

constexpr std::string_view kOperationNames[] = {"cut", "concatenate", "insert"};
// Pixels that are near to a curve.
constexpr double kNear = 20.0;

// The curve as smooth as it is seen, in the unit of the mesh.
std::vector<Vec3> seen_curve(const Hairstyle& style, CurveId id) {
    std::vector<Vec3> points = smooth_curve(drawn_points(style.curve(id)), style.layout().step);
    for (Vec3& point : points) point = style.scalp().from_metres(point);
    return points;
}

// ---- Surfaces

int make_support(Call& call) {
    const auto curve = call.self<CurveObject>();
    const auto camera = call.object<CameraObject>("camera");
    SupportOptions options;
    options.mode = call.choice<SupportMode>("mode");
    options.width = call.has("width") ? call.number("width")
                                      : (options.mode == SupportMode::ruled ? 0.075 : 0.03);
    options.extension = call.number("extension");
    const auto result = call.create<SupportObject>();
    const bool done = call.attempt([&] {
        const Hairstyle& style = curve->owner->style();
        const double metre = style.scalp().scale();
        options.width *= metre, options.extension *= metre, options.end *= metre;
        SupportSurface surface(seen_curve(style, curve->id), camera->camera, options);
        result.set(std::make_shared<SupportObject>(std::move(surface), metre));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int support_mode(Call& call) {
    const bool ruled = call.self<SupportObject>()->surface.mode() == SupportMode::ruled;
    return call.push(std::string_view(ruled ? "ruled" : "strip"));
}

int support_end_on(Call& call) {
    return call.push(call.self<SupportObject>()->surface.end_on());
}

int support_seen(Call& call) {
    const auto self = call.self<SupportObject>();
    const auto camera = call.object<CameraObject>("camera");
    double seen = 0.0;
    const bool done = call.attempt_quick([&] { seen = self->surface.seen_from(camera->camera); });
    return done ? call.push(seen) : call.fail();
}

int support_edges(Call& call) {
    const auto rulings = call.self<SupportObject>()->surface.rulings();
    for (const double side : {-1.0, 1.0}) {
        lua_createtable(call.lua(), index_of(rulings.size()), 0);
        for (std::size_t i = 0; i < rulings.size(); ++i) {
            const auto& one = rulings[i];
            call.push_vector(one.center + side * one.reach * one.direction);
            lua_rawseti(call.lua(), -2, index_of(i) + 1);
        }
    }
    return 2;
}

int support_mesh(Call& call) {
    const auto self = call.self<SupportObject>();
    const auto result = call.create<MeshObject>();
    const bool done = call.attempt(
        [&] { result.set(std::make_shared<MeshObject>(self->surface.mesh(call.context()))); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int support_pick(Call& call) {
    const auto self = call.self<SupportObject>();
    const Ray ray{call.vector("origin"), call.vector("direction")};
    if (!(ray.direction.norm() > 0.0)) call.reject("direction", "a length above 0 expected");
    auto& hits = call.hold<std::vector<SupportSurface::Hit>>();
    const bool done = call.attempt_quick([&] {
        hits = self->surface.hits({ray.origin, ray.direction.normalized()});
    });
    if (!done) return call.fail();
    if (hits.empty()) {
        lua_pushnil(call.lua());
        return 1;
    }
    lua_createtable(call.lua(), 0, 4);
    call.set_field("position", call.push_vector(hits.front().position));
    call.set_field("distance", call.push(hits.front().distance));
    call.set_field("along", call.push(hits.front().along));
    call.set_field("across", call.push(hits.front().across));
    return 1;
}

int support_text(Call& call) {
    const SupportSurface& surface = call.self<SupportObject>()->surface;
    lua_pushfstring(call.lua(), "lissom.Support: %s, %d lines",
                    surface.mode() == SupportMode::ruled ? "ruled" : "strip",
                    count_of(surface.rulings()));
    return 1;
}

// ---- Hints

std::vector<Vec3> hint_pixels(const Call& call) {
    std::vector<Vec3> points;
    for (const auto& [x, y] : call.pixels("points")) points.emplace_back(x, y, 0.0);
    return points;
}

std::vector<Vec3> on_picture(const std::vector<Vec3>& curve, const Camera& camera,
                             const PictureSize& size) {
    std::vector<Vec3> pixels;
    for (const Vec3& point : curve) {
        const Vec3 seen = camera.project(point, size);
        if (!seen.allFinite()) {
            throw Error(ErrorCode::invalid_argument,
                        "the curve is partly behind the camera; step back until all is seen");
        }
        pixels.emplace_back(seen.x(), seen.y(), 0.0);
    }
    return pixels;
}

struct PictureHint {
    HintReading reading;
    double pixels = 0.0;
};

int read_hint(Call& call) {
    const auto curve = call.self<CurveObject>();
    const auto camera = call.object<CameraObject>("camera");
    const PictureSize size = SizeRequest::picture(call);
    const double near = kNear * call.number("scale");
    auto& hint = call.hold<PictureHint>();
    const bool done = call.attempt([&] {
        const auto seen =
            on_picture(seen_curve(curve->owner->style(), curve->id), camera->camera, size);
        hint.pixels = curve_length(seen) / call.number("scale");
        hint.reading = hint_reading(seen, hint_pixels(call), near);
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 4);
    const auto name = [&](HintOperation o) { return kOperationNames[static_cast<int>(o)]; };
    call.set_field("operation", call.push(name(hint.reading.operation)));
    call.set_field("sure", call.push(hint.reading.sure));
    push_list(call, hint.reading.others, [&](const auto& other) { call.push(name(other)); });
    call.set_field("others", 1);
    call.set_field("pixels", call.push(hint.pixels));
    return 1;
}

// ---- Descriptions

// Start of examples.
const std::string kSupport = kStyle + R"(local camera = lissom.camera{ eye = { 0, 0, 2 } }
local support = curve:support{ camera = camera }
)";

Parameter camera_option(const std::string& help) {
    return object("camera", CameraObject::kTypeName, help);
}

}  // namespace

std::vector<Function> support_methods_of_curve() {
    return {
        {.name = "support",
         .body = make_support,
         .summary =
             "The surface through the curve that strokes about it are drawn on (Figure 4.3): the "
             "strip keeps the depth of the curve and changes how it looks from the viewpoint, the "
             "ruled surface of the lines of sight keeps how it looks and changes its depth, seen "
             "from aside. Up to about 50 degrees from the viewpoint the strip is seen better, "
             "beyond that the ruled one. Give it to camera:stroke as `on`.",
         .options = {choice("mode", {"ruled", "strip"}, "Kind of surface.").defaults("strip"),
                     camera_option("The viewpoint; that of the stroke may be another."),
                     number("width", "To each side of the curve; a strip is narrower in bends.")
                         .in("metres of an average head")
                         .above(0)
                         .optional("0.03 of a strip, 0.075 of a ruled surface"),
                     number("extension", "Length beyond the tip.")
                         .in("metres of an average head")
                         .at_least(0)
                         .defaults(SupportOptions{}.extension)},
         .results = {{"lissom.Support", "support", "The surface, of the curve as it is now."}},
         .errors = {ErrorCode::handle_removed, ErrorCode::invalid_argument},
         .example = kSupport + "assert(support:mode() == 'strip')"},
        {.name = "read_hint",
         .body = read_hint,
         .summary = "The meaning of a hint stroke, seen on the picture: within 20 pixels is "
                    "near. Draw it on the curve's supporting surface, and call the method of "
                    "that name with it.",
         .options = {camera_option("The camera that it is seen by."),
                     pixels("points", "The stroke on the picture, smoothed; see camera:stroke."),
                     number("scale", "Pixels of the picture to a logical one, on dense screens.")
                         .above(0)
                         .defaults(1.0),
                     size_argument()},
         .results = {{"lissom.HintReading", "reading", "Its reading."}},
         .errors = {ErrorCode::handle_removed, ErrorCode::invalid_argument,
                    ErrorCode::out_of_range},
         .example = kSupport + R"(local tip = curve:points()[2]
local x, y = camera:project(tip)
local reading = curve:read_hint{ camera = camera, points = { { x, y }, { x + 5, y + 90 } } }
assert(reading.operation == 'concatenate' and reading.sure))"}};
}

Type support_type() {
    return {
        .name = "lissom.Support",
        .summary =
            "A surface through a curve, on which strokes about the curve are drawn; see "
            "lissom.Curve:support.",
        .methods = {{.name = "mode",
                     .body = support_mode,
                     .summary = "Kind of the surface.",
                     .results = {{"string", "mode", "\"ruled\" or \"strip\"."}},
                     .example = kSupport + "assert(support:mode() == 'strip')"},
                    {.name = "end_on",
                     .body = support_end_on,
                     .summary = "Fraction of the curve that is seen end-on from the viewpoint, at "
                                "which a surface says little of it. Warn above a third, and take "
                                "another viewpoint.",
                     .results = {{"number", "share", "Fraction of its length, 0 to 1."}},
                     .example = kSupport + "assert(support:end_on() <= 1)"},
                    {.name = "seen_from",
                     .body = support_seen,
                     .summary = "Cosine at which a camera sees the surface. Strokes need 0.3.",
                     .arguments = {camera_option("The camera.")},
                     .results = {{"number", "cosine", "0, seen edge-on, to 1."}},
                     .errors = {ErrorCode::invalid_argument},
                     .example = kSupport + "assert(support:seen_from(camera) > 0.3)"},
                    {.name = "edges",
                     .body = support_edges,
                     .summary = "Its two edges, for drawing it with view:surface.",
                     .results = {{"lissom.Vector[]", "first", "From the root to beyond the tip."},
                                 {"lissom.Vector[]", "second", "Likewise, as many points."}},
                     .example = kSupport + "local first, second = support:edges()\n"
                                           "assert(#first == #second)"},
                    {.name = "mesh",
                     .body = support_mesh,
                     .summary = "The surface as a mesh: two vertices and two triangles a line.",
                     .results = {{"lissom.Mesh", "mesh", "A new mesh."}},
                     .example = kSupport + "assert(support:mesh():is_manifold())"},
                    {.name = "pick",
                     .body = support_pick,
                     .summary = "First intersection with a ray.",
                     .arguments = {vector("origin", "Start of the ray."),
                                   vector("direction", "Its direction; any length.")},
                     .results = {{"lissom.SupportPoint?", "hit", "nil if there is none."}},
                     .example = kSupport + R"(local hit = support:pick(camera:ray(640, 480))
assert(hit == nil or hit.distance > 0))"}},
        .operators = {{"__tostring", support_text, "tostring(support)", "its kind"}}};
}

std::vector<Record> support_records() {
    return {{"lissom.HintReading",
             "Reading of a hint stroke.",
             {{"string", "operation", "\"cut\", \"concatenate\" or \"insert\"."},
              {"boolean", "sure",
               "False if a slightly different stroke has another meaning: show its reading."},
              {"string[]", "others", "Other readings, likelier first."},
              {"number", "pixels",
               "Length of the curve on the picture, in logical pixels: below 120 hints are hard "
               "to tell, so ask to come nearer."}}},
            {"lissom.SupportPoint",
             "A point of a supporting surface.",
             {{"lissom.Vector", "position", "The point."},
              {"number", "distance", "From the ray's origin."},
              {"number", "along", "Arc length along the curve, more than its length beyond it."},
              {"number", "across", "The way from the curve."}}}};
}

}  // namespace lissom::lua
