// lissom.polyline: Polyline.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/mesh/transform_options.h"
#include "bindings/lua/scene/polyline_object.h"

namespace lissom::lua {
namespace {

int make_polyline(Call& call) {
    const auto points = call.points("points");
    const bool closed = call.boolean("closed");
    const auto result = call.create<PolylineObject>();
    const bool done = call.attempt_quick([&] {
        result.set(
            std::make_shared<PolylineObject>(Polyline{{points.begin(), points.end()}, closed}));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

int polyline_points(Call& call) {
    const auto& points = call.self<PolylineObject>()->polyline.points;
    return push_list(call, points, [&](const Vec3& point) { call.push_vector(point); });
}

int set_polyline_points(Call& call) {
    const auto self = call.self<PolylineObject>();
    const auto points = call.points("points");
    const bool done = call.attempt_quick([&] {
        call.reserve(self, points.size_bytes());
        self->polyline.points.assign(points.begin(), points.end());
    });
    if (!done) return call.fail();
    call.charge(self);
    return call.push_argument();
}

int transform_polyline(Call& call) {
    const auto self = call.self<PolylineObject>();
    const TransformOptions options = TransformOptions::read(call);
    const bool done = call.attempt_quick([&] {
        const Affine map = options.map(Vec3::Zero());
        for (Vec3& point : self->polyline.points) point = map(point);
    });
    return done ? call.push_argument() : call.fail();
}

int polyline_is_closed(Call& call) {
    return call.push(call.self<PolylineObject>()->polyline.closed);
}

int polyline_length(Call& call) {
    const Polyline& polyline = call.self<PolylineObject>()->polyline;
    double length = 0.0;
    for (std::size_t i = 1; i < polyline.points.size(); ++i) {
        length += (polyline.points[i] - polyline.points[i - 1]).norm();
    }
    if (polyline.closed && !polyline.points.empty()) {
        length += (polyline.points.front() - polyline.points.back()).norm();
    }
    return call.push(length);
}

int polyline_count(Call& call) {
    return call.push_count(call.self<PolylineObject>()->polyline.points.size());
}

int polyline_text(Call& call) {
    lua_pushfstring(call.lua(), "lissom.Polyline: %d points",
                    count_of(call.self<PolylineObject>()->polyline.points));
    return 1;
}

const std::string kTriangle =
    "local line = lissom.polyline{ points = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 4, 0 } }, closed = "
    "true }\n";

const std::vector<Result> kPolyline = {{"lissom.Polyline", "line", "The polyline itself."}};

}  // namespace

Type polyline_type() {
    Type type{.name = "lissom.Polyline",
              .summary = "A curve through points in space: a drawn stroke, a guide."};
    type.operators = {{"__len", polyline_count, "#polyline", "number of points"},
                      {"__tostring", polyline_text, "tostring(polyline)", "its size"}};
    type.methods = {{.name = "points",
                     .body = polyline_points,
                     .summary = "Its points.",
                     .results = {{"lissom.Vector[]", "points", "A list of {x, y, z}."}},
                     .example = kTriangle + "assert(line:points()[3][2] == 4)"},
                    {.name = "set_points",
                     .body = set_polyline_points,
                     .summary = "Replaces its points.",
                     .arguments = {points("points", "Any number of them.")},
                     .results = kPolyline,
                     .errors = {ErrorCode::memory_limit},
                     .example = kTriangle + "assert(#line:set_points{ { 0, 0, 0 } } == 1)"},
                    {.name = "transform",
                     .body = transform_polyline,
                     .summary = "Scales, then rotates, then translates all points.",
                     .options = transform_fields("the origin"),
                     .results = kPolyline,
                     .errors = {ErrorCode::singular_transform},
                     .example = kTriangle + "assert(line:transform{ scale = 2 }:length() == 24)"},
                    {.name = "is_closed",
                     .body = polyline_is_closed,
                     .summary = "Whether its last point is joined to the first.",
                     .results = {{"boolean", "closed", "Whether it was made closed."}},
                     .example = kTriangle + "assert(line:is_closed())"},
                    {.name = "length",
                     .body = polyline_length,
                     .summary = "Its length.",
                     .results = {{"number", "length", "In the unit of its points."}},
                     .example = kTriangle + "assert(line:length() == 12)"}};
    return type;
}

std::vector<Function> polyline_functions() {
    return {{.name = "polyline",
             .body = make_polyline,
             .summary = "Makes a free curve.",
             .options = {points("points", "Its points, in order."),
                         boolean("closed", "Joins the last point to the first.").defaults(false)},
             .results = {{"lissom.Polyline", "line", "A new polyline."}},
             .errors = {ErrorCode::memory_limit},
             .example = kTriangle + R"(local scene = lissom.scene{}
scene:add("triangle", line))"}};
}

}  // namespace lissom::lua
