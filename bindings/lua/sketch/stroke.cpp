// lissom.Camera: strokes drawn on a picture, in the world.
#include "kernel/sketch/stroke.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_object.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "bindings/lua/sketch/camera_object.h"
#include "bindings/lua/sketch/support_object.h"
#include "kernel/sketch/stroke_cloud.h"
#include "kernel/sketch/stroke_depth.h"
#include "kernel/sketch/support/support_stroke.h"

namespace lissom::lua {
namespace {

// Result of a stroke.
struct DrawnStroke {
    Stroke stroke;
    std::vector<Vec3> points;
    bool is_click = false;
    // How many of the points were beside the supporting surface.
    std::size_t beside = 0;
};

std::vector<StrokeEvent> read_events(const Call& call) {
    const auto pixels = call.pixels("points");
    const auto optional = [&](const char* path) {
        return call.has(path) ? call.numbers(path) : std::span<const double>();
    };
    const auto times = optional("times"), pressures = optional("pressures");
    std::vector<StrokeEvent> events;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        StrokeEvent event{{pixels[i][0], pixels[i][1]}};
        // Without times no stroke is a click for being quick.
        event.time = times.empty() ? static_cast<double>(i) : times[i];
        if (!pressures.empty()) event.pressure = pressures[i];
        events.push_back(event);
    }
    return events;
}

void check_lengths(const Call& call) {
    const std::size_t count = call.pixels("points").size();
    for (const char* path : {"times", "pressures"}) {
        if (call.has(path) && call.numbers(path).size() != count) {
            call.reject(path, "one number for each point expected");
        }
    }
}

std::vector<char> faces_of(const Region& region) {
    std::vector<char> mask(region.topology()->face_count(), 0);
    for (const Index f : region.faces()) mask[f] = 1;
    return mask;
}

// The choices of the option `depth`, in their order.
enum class DepthRule { envelope, last };

double lift_of(const Call& call) {
    return call.has("lift") ? call.number("lift") : 0.0;
}

std::vector<Vec3> over_scalp(const Call& call, const Scalp& scalp, const Stroke& stroke,
                             const View& view) {
    const std::vector<char> faces = faces_of(scalp.region());
    const DrawnSurface head{scalp.tree(), faces};
    const double metre = scalp.scale();
    if (call.choice<DepthRule>("depth") == DepthRule::last) {
        return stroke_on_surface(stroke.points, view, head, lift_of(call) * metre, call.context());
    }
    EnvelopeOptions options;
    options.metre = metre;
    options.averages *= call.number("scale");
    options.snap *= call.number("scale");
    if (call.has("lift")) options.lift = call.number("lift");
    return stroke_over_head(stroke.points, view, head, options, call.context());
}

std::vector<Vec3> beside_curve(const CurveObject& curve, const Stroke& stroke, const View& view) {
    const Hairstyle& style = curve.owner->style();
    std::vector<Vec3> course = style.course(curve.id);
    for (Vec3& point : course) point = style.scalp().from_metres(point);
    return stroke_beside_curve(stroke.points, view, course);
}

std::vector<Vec3> on_support(const SupportObject& support, DrawnStroke& drawn, const View& view) {
    SupportStrokeOptions options;
    options.run *= support.metre, options.fade *= support.metre;
    SupportStroke result = stroke_on_support(drawn.stroke.points, view, support.surface, options);
    drawn.beside = result.beside;
    return std::move(result.points);
}

std::vector<Vec3> placed(const Call& call, DrawnStroke& drawn, const View& view) {
    const Stroke& stroke = drawn.stroke;
    if (call.has("plane")) {
        return stroke_on_plane(stroke.points, view, call.vector("plane.point"),
                               call.vector("plane.normal"));
    }
    if (call.is_object<SupportObject>("on")) {
        return on_support(*call.object<SupportObject>("on"), drawn, view);
    }
    if (call.is_object<CurveObject>("on")) {
        return beside_curve(*call.object<CurveObject>("on"), stroke, view);
    }
    if (call.is_object<StrandsObject>("on")) {
        CloudStrokeOptions options;
        options.radius *= call.number("scale");
        return stroke_before_cloud(stroke.points, view,
                                   call.object<StrandsObject>("on")->strands.points(), options,
                                   call.context());
    }
    if (call.is_object<ScalpObject>("on")) {
        return over_scalp(call, *call.object<ScalpObject>("on")->scalp, stroke, view);
    }
    const DrawnSurface surface{call.object<MeshObject>("on")->tree(call.context()), {}};
    return stroke_on_surface(stroke.points, view, surface, lift_of(call), call.context());
}

int push_drawn(const Call& call, const DrawnStroke& drawn) {
    lua_State* L = call.lua();
    const std::size_t count = drawn.points.size();
    lua_createtable(L, 0, 7);
    lua_createtable(L, index_of(count), 0);
    for (std::size_t i = 0; i < count; ++i) {
        call.push_vector(drawn.points[i]);
        lua_rawseti(L, -2, index_of(i) + 1);
    }
    call.set_field("points");
    push_list(call, drawn.stroke.points, [&](const auto& pixel_place) {
        const double pixel[] = {pixel_place.x(), pixel_place.y()};
        call.push_numbers(pixel);
    });
    call.set_field("pixels");
    call.set_field("corners", call.push_ids(drawn.stroke.corners));
    call.set_field("times", call.push_numbers(drawn.stroke.times));
    call.set_field("pressures", call.push_numbers(drawn.stroke.pressures));
    call.set_field("click", call.push(drawn.is_click));
    call.set_field("beside", call.push_count(drawn.beside));
    return 1;
}

int draw_stroke(Call& call) {
    const auto camera = call.self<CameraObject>();
    check_lengths(call);
    if (call.has("on") && call.has("plane")) call.reject("plane", "give on or plane, not both");
    const View view{camera->camera, SizeRequest::picture(call)};
    StrokeOptions options;
    options.smoothing = call.number("smoothing");
    options.spacing = call.number("spacing");
    options.scale = call.number("scale");
    auto& drawn = call.hold<DrawnStroke>();
    const bool done = call.attempt([&] {
        const std::vector<StrokeEvent> events = read_events(call);
        drawn.is_click = is_click(events, options.scale);
        drawn.stroke = fair_stroke(events, options, call.context());
        for (Vec2& pixel : drawn.stroke.points) pixel *= options.scale;
        if (call.has("on") || call.has("plane")) drawn.points = placed(call, drawn, view);
    });
    if (!done) return call.fail();
    return push_drawn(call, drawn);
}

}  // namespace

Function stroke_method_of_camera() {
    return {
        .name = "stroke",
        .body = draw_stroke,
        .summary =
            "A line that a hand drew on the picture, as it was meant: without hooks at its ends, "
            "fair between its corners, and put into the world by a rule of depth. On a scalp it is "
            "the course of a stream curve, in front of the head wherever it goes; beyond the "
            "silhouette its depth is a guess, to be drawn again from another view.",
        .options =
            {pixels("points", "Positions of the pen."),
             numbers("times", "Seconds, one for each point; they tell a click.").optional(),
             numbers("pressures", "0 to 1, one for each point.").optional(),
             either("on",
                    {object("scalp", ScalpObject::kTypeName, "In front of a head, from its hair."),
                     object("strands", StrandsObject::kTypeName,
                            "In front of hair, but for a few strands that stand out."),
                     object("mesh", MeshObject::kTypeName,
                            "On a surface, and beyond it as deep as it was left."),
                     object("support", SupportObject::kTypeName,
                            "On the supporting surface of a curve, and beside it as its slope "
                            "goes on."),
                     object("curve", CurveObject::kTypeName,
                            "The depth of the place of a style curve that is seen nearest.")},
                    "The surface drawn on.")
                 .optional("only on the picture"),
             options("plane",
                     {vector("point", "A point of the plane."),
                      vector("normal", "Its normal; any length.")},
                     "The plane that is drawn on.")
                 .optional(),
             choice("depth", {"envelope", "last"},
                    "On a scalp: in front of all of the head, changing gently; or as deep as the "
                    "scalp, and beyond it as deep as it was left (section 4.5).")
                 .defaults("envelope"),
             number("lift",
                    "Distance in front of the surface; of a scalp in metres of an average head.")
                 .optional("0.02 on a scalp by the envelope, else 0"),
             number("smoothing",
                    "Multiple of the smoothing that suits a mouse; 0 keeps every wiggle.")
                 .at_least(0)
                 .defaults(1.0),
             number("spacing", "Between two points of the result.")
                 .above(0)
                 .defaults(4.0)
                 .in("pixels"),
             number("scale", "Pixels of the picture to a logical one, on dense screens.")
                 .above(0)
                 .defaults(1.0),
             size_argument()},
        .results = {{"lissom.DrawnStroke", "stroke", "The line."}},
        .errors = {ErrorCode::invalid_argument, ErrorCode::mesh_empty, ErrorCode::handle_removed,
                   ErrorCode::cancelled},
        .example = R"(local camera = lissom.camera{ eye = { 0, 0, 5 } }
local line = camera:stroke{ points = { { 600, 480 }, { 700, 480 } }, on = lissom.shapes.box() }
assert(math.abs(line.points[1][3] - 0.5) < 1e-9))"};
}

std::vector<Record> stroke_records() {
    return {
        {"lissom.DrawnStroke",
         "A line that a hand drew, at even steps.",
         {{"lissom.Vector[]", "points",
           "In the world, one for each pixel; empty if it is on nothing. Over a scalp by the "
           "envelope they begin at the hair: the pixels before that have none, or a point comes "
           "before the first."},
          {"number[][]", "pixels", "On the picture, {x, y}."},
          {"integer[]", "corners", "Places of corners in `pixels`."},
          {"number[]", "times", "Time of each pixel."},
          {"number[]", "pressures", "Pressure of each pixel."},
          {"boolean", "click", "Whether the pen only touched the picture."},
          {"integer", "beside",
           "Number of points that lay beside the supporting surface that was drawn on; their "
           "depth is a guess."}}}};
}

}  // namespace lissom::lua
