// The options that describe style curves.
#include <algorithm>
#include <string>

#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/hair/hair_object.h"

namespace lissom::lua {

namespace {

void take_length(const Call& call, const char* path, double& target) {
    if (call.has(path)) target = call.number(path);
}
void take_length(const Call& call, const char* path, std::optional<double>& target) {
    if (call.has(path)) target = call.number(path);
}

// {start, end} in degrees.
void take_tilt(const Call& call, const char* path, DividingOptions::Tilt& target) {
    if (!call.has(path)) return;
    const auto degrees = call.numbers(path);
    if (degrees.size() != 2) {
        throw Error(ErrorCode::invalid_argument, "option '" + std::string(path) +
                                                     "' takes two angles, that at the first point "
                                                     "and that at the last");
    }
    target = {degrees[0] * kDegree, degrees[1] * kDegree};
}

void take_stop(const Call& call, double& target) {
    if (!call.has("stop")) return;
    if (call.kind("stop") == Kind::number) {
        target = call.number("stop");
    } else {
        target = call.boolean("stop") ? StreamOptions{}.stop_length : 0.0;
    }
}

std::vector<Vec3> in_metres(const Scalp& scalp, std::span<const Vec3> points) {
    std::vector<Vec3> result(points.begin(), points.end());
    for (Vec3& p : result) p = scalp.to_metres(p);
    return result;
}

// Puts the point at place `i` of the list on top of the stack into `point`.
bool read_point(lua_State* L, int i, Vec3& point) {
    lua_rawgeti(L, -1, i);
    bool fits = lua_istable(L, -1);
    for (int axis = 0; fits && axis < 3; ++axis) {
        lua_rawgeti(L, -1, axis + 1);
        fits = lua_type(L, -1) == LUA_TNUMBER;
        point[axis] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
    lua_pop(L, 1);
    return fits;
}

Parameter metres_field(const std::string& name, const std::string& help) {
    return number(name, help).in("metres");
}

std::vector<Parameter> common_fields() {
    return {string("name", "For people, and for groups of strands.").optional(),
            boolean("enabled", "Curves that are not have no effect.").optional("true"),
            number("weight", "Weight of the curve in the field (omega of the thesis).")
                .between(1e-6, 1e9)
                .optional("100")};
}

Parameter stop_field() {
    return either("stop",
                  {boolean("on", "Whether it does."),
                   metres_field("length", "Length behind the end.").at_least(0)},
                  "Keeps hair from growing on beyond the end of the curve, by vectors that vanish "
                  "over a length.")
        .optional("true, 0.04 metres");
}

std::vector<Parameter> own_stream_fields() {
    return {stop_field(), metres_field("clearance", "The curve is moved out to this height.")
                              .at_least(0)
                              .optional("0.004")
                              .thesis("4.5", "0")};
}

std::vector<Parameter> own_dividing_fields() {
    return {
        numbers("tilt",
                "{at its first point, at its last}: by how much hair on both sides is turned "
                "towards the curve's end, in degrees.")
            .optional("{0, 0}"),
        numbers("left", "The same for one side, as seen along the curve from outside.")
            .optional("tilt"),
        numbers("right", "The same for the other.").optional("tilt"),
        metres_field("sigma", "Distance from the line to the crest of the hair.")
            .above(0)
            .optional("a grid step"),
        metres_field("height", "h of the thesis: the crest is 0.39 times as high.")
            .at_least(0)
            .optional("half a grid step"),
        metres_field("reach", "Distance from the line within which hair is shaped.")
            .above(0)
            .optional("2.5 sigma"),
        metres_field("thickness", "Distance above and below its line within which hair is shaped.")
            .above(0)
            .optional("0.8 grid steps"),
        number("separation", "Magnitude of the vectors that keep both sides apart.")
            .between(0, 1)
            .optional("0.3"),
        metres_field("wall_width", "Distance of these from the line.")
            .above(0)
            .optional("1.2 grid steps"),
        metres_field("wall_height", "Their height.").at_least(0).optional("2.6 grid steps"),
        metres_field("ramp", "Nearer to the line, vectors away from it fade; 0 as in the thesis.")
            .at_least(0)
            .optional("0.87 grid steps")
            .thesis("4.5", "0"),
        metres_field("gap", "Width of the bare skin along the line.")
            .at_least(0)
            .optional("0.0024")
            .thesis("4.5", "0")};
}

std::vector<Parameter> own_ponytail_fields() {
    return {
        metres_field("radius", "Radius of the tie, the first cross section.")
            .above(0)
            .optional("from section or profiles, else 1.5 grid steps"),
        points("section",
               "A closed curve around the spine, seen from anywhere: the tie stands there, and is "
               "as wide as it is across the spine.")
            .optional(),
        table("profiles",
              "{a, b}: two lists of points along the spine on either side of the tail; its cross "
              "sections reach between them along their common part, in either direction.")
            .optional(),
        number("share", "Without profiles: how much of the spine has cross sections.")
            .between(0, 1)
            .optional("0.7"),
        number("fullness", "Without profiles: the tail swells to 1 + fullness radii.")
            .at_least(0)
            .optional("1"),
        number("inner", "Hair is drawn into the tie from this many radii on (R1 of the thesis).")
            .above(0)
            .optional("1.3"),
        number("outer", "And up to this many (R2).").above(0).optional("1.9"),
        metres_field("ring", "It is at least so wide.")
            .at_least(0)
            .optional("2.5 grid steps")
            .thesis("4.5", "0"),
        metres_field("free", "Nearer to the head than this the tail leaves hair alone.")
            .at_least(0)
            .optional("1.5 grid steps")
            .thesis("4.5", "0"),
        metres_field("lead", "The ring begins so far in front of the tie.")
            .at_least(0)
            .optional("1.5 grid steps")
            .thesis("4.5", "half a grid step"),
        number("grip",
               "Strength with which the tail holds its hair together: the turn inward of vectors "
               "just outside, a grid step. 0 as in the thesis.")
            .at_least(0)
            .optional("4")
            .thesis("4.5", "0"),
        number("spread",
               "Strength with which hair spreads again behind the tie and fills the tail. 0 as in "
               "the thesis.")
            .at_least(0)
            .optional("2")
            .thesis("4.5", "0"),
        number("tightness", "Magnitude of the vectors that do so.").between(0, 1).optional("0.6"),
        metres_field("tail_length", "Length of the hair behind the tie.")
            .at_least(0)
            .optional("as long as the spine")
            .thesis("4.6", "as long as hair without a tie"),
        number("ragged", "Share of that by which tips differ.")
            .between(0, 1)
            .optional("0.45")
            .thesis("4.6", "0")};
}

std::vector<Parameter> joined(const std::vector<std::vector<Parameter>>& lists) {
    std::vector<Parameter> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

}  // namespace

std::vector<Parameter> stream_fields() {
    return joined({{points("points",
                           "From the root to the tip; the curve runs smoothly through "
                           "them.")
                        .in("mesh units")},
                   own_stream_fields(),
                   common_fields()});
}

std::vector<Parameter> dividing_fields() {
    return joined({{points("points", "On the scalp, or near it.").in("mesh units")},
                   own_dividing_fields(),
                   common_fields()});
}

std::vector<Parameter> ponytail_fields() {
    return joined({{points("spine", "From the tie to the tip of the tail.").in("mesh units")},
                   {stop_field()},
                   own_ponytail_fields(),
                   common_fields()});
}

std::vector<Parameter> curve_fields() {
    return joined({{points("points", "Points of a stream or dividing curve.").optional(),
                    points("spine", "Spine of a ponytail.").optional()},
                   own_stream_fields(),
                   own_dividing_fields(),
                   own_ponytail_fields(),
                   common_fields()});
}

CurveReader::CurveReader(Call& call, bool ponytails) : call_(call) {
    if (ponytails && call.has("profiles")) read_profiles();
}

void CurveReader::read_profiles() {
    lua_State* L = call_.lua();
    for (int side = 0; side < 2; ++side) {
        lua_rawgeti(L, call_.stack_index("profiles"), side + 1);
        if (!lua_istable(L, -1)) call_.reject("profiles", "{points, points} expected");
        const auto count = index_of(raw_length(L, -1));
        auto* list = call_.scratch<Vec3>(at(count));
        lua_insert(L, -2);
        for (int i = 0; i < count; ++i) {
            lua_rawgeti(L, -1, i + 1);
            lua_pop(L, 1);
            if (!read_point(L, i + 1, list[i])) {
                call_.reject("profiles", "two lists of {x, y, z} expected");
            }
        }
        lua_pop(L, 1);
        profiles_[side] = {list, at(count)};
    }
}

void CurveReader::read(const Scalp& scalp, StreamCurve& curve) const {
    if (call_.has("points")) curve.points = in_metres(scalp, call_.points("points"));
    take_stop(call_, curve.options.stop_length);
    take_length(call_, "clearance", curve.clearance);
    take_length(call_, "weight", curve.options.weight);
}

void CurveReader::read(const Scalp& scalp, DividingCurve& curve) const {
    if (call_.has("points")) curve.points = in_metres(scalp, call_.points("points"));
    DividingOptions& options = curve.options;
    take_tilt(call_, "tilt", options.left);
    take_tilt(call_, "tilt", options.right);
    take_tilt(call_, "left", options.left);
    take_tilt(call_, "right", options.right);
    take_length(call_, "sigma", options.sigma);
    take_length(call_, "height", options.height);
    take_length(call_, "reach", options.reach);
    take_length(call_, "thickness", options.thickness);
    take_length(call_, "separation", options.separation);
    take_length(call_, "wall_width", options.wall_width);
    take_length(call_, "wall_height", options.wall_height);
    take_length(call_, "ramp", options.ramp);
    take_length(call_, "gap", curve.gap);
    take_length(call_, "weight", options.weight);
}

void CurveReader::read(const Scalp& scalp, Ponytail& curve) const {
    if (call_.has("spine")) curve.spine = in_metres(scalp, call_.points("spine"));
    PonytailOptions& options = curve.options;
    take_length(call_, "radius", options.radius);
    if (call_.has("section")) options.section = in_metres(scalp, call_.points("section"));
    for (std::size_t side = 0; side < 2; ++side) {
        if (call_.has("profiles")) options.profiles[side] = in_metres(scalp, profiles_[side]);
    }
    take_stop(call_, options.stop_length);
    take_length(call_, "share", options.share);
    take_length(call_, "fullness", options.fullness);
    take_length(call_, "inner", options.inner);
    take_length(call_, "outer", options.outer);
    take_length(call_, "ring", options.ring);
    take_length(call_, "free", options.clearance);
    take_length(call_, "lead", options.lead);
    take_length(call_, "grip", options.grip);
    take_length(call_, "spread", options.spread);
    take_length(call_, "tightness", options.tightness);
    take_length(call_, "tail_length", curve.tail_length);
    take_length(call_, "ragged", curve.ragged);
    take_length(call_, "weight", options.weight);
}

void CurveReader::read(const Scalp& scalp, StyleCurve& curve) const {
    if (call_.has("name")) curve.name = call_.string("name");
    if (call_.has("enabled")) curve.enabled = call_.boolean("enabled");
    std::visit([&](auto& shape) { read(scalp, shape); }, curve.shape);
}

void refuse_other_options(const Call& call, const StyleCurve& curve) {
    const auto own = [&] {
        switch (curve.shape.index()) {
            case 0:
                return stream_fields();
            case 1:
                return dividing_fields();
            default:
                return ponytail_fields();
        }
    }();
    for (const Parameter& option : curve_fields()) {
        const bool applies = std::any_of(own.begin(), own.end(), [&](const Parameter& field) {
            return field.name == option.name;
        });
        if (applies || !call.has(option.name.c_str())) continue;
        throw Error(ErrorCode::invalid_argument, "option '" + option.name +
                                                     "' does not apply to a " +
                                                     std::string(kind_name(curve)) + " curve");
    }
}

}  // namespace lissom::lua
