// lissom.Curve: the tilts of a parting, from hint strokes beside it.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"

namespace lissom::lua {

void forget_hints(const Call& call, const Hairstyle& style, CurveId id, StyleCurve& curve) {
    auto* dividing = std::get_if<DividingCurve>(&curve.shape);
    if (!dividing || !(call.has("tilt") || call.has("left") || call.has("right"))) return;
    if (dividing->hints.empty()) return;
    dividing->options.left = style.tilt(id).left.tilt;
    dividing->options.right = style.tilt(id).right.tilt;
    dividing->hints.clear();
}

namespace {

int push_side(const Call& call, const SideTilt& side) {
    lua_createtable(call.lua(), 0, 4);
    call.set_field("start", call.push(side.tilt.start / kDegree));
    call.set_field("finish", call.push(side.tilt.end / kDegree));
    call.set_field("pieces", call.push(side.pieces));
    call.set_field("error", call.push(side.error / kDegree));
    return 1;
}

int push_tilt(const Call& call, const TiltFit& fit) {
    lua_createtable(call.lua(), 0, 2);
    call.set_field("left", push_side(call, fit.left));
    call.set_field("right", push_side(call, fit.right));
    return 1;
}

int curve_tilt(Call& call) {
    const auto curve = call.self<CurveObject>();
    TiltFit fit;
    const bool done = call.attempt_quick([&] { fit = curve->owner->style().tilt(curve->id); });
    return done ? push_tilt(call, fit) : call.fail();
}

int add_hint(Call& call) {
    const auto curve = call.self<CurveObject>();
    TiltFit fit;
    const bool done = call.attempt([&] {
        Hairstyle& style = curve->owner->style();
        std::vector<Vec3> hint;
        for (const Vec3& p : call.points("hint")) hint.push_back(style.scalp().to_metres(p));
        curve->owner->edit(call, [&](Hairstyle& own) { own.add_hint(curve->id, std::move(hint)); });
        fit = style.tilt(curve->id);
    });
    return done ? push_tilt(call, fit) : call.fail();
}

const DividingCurve& parting_of(const Hairstyle& style, CurveId id) {
    (void)style.tilt(id);
    return std::get<DividingCurve>(style.curve(id).shape);
}

int curve_hints(Call& call) {
    const auto curve = call.self<CurveObject>();
    const std::vector<std::vector<Vec3>>* hints = nullptr;
    const Scalp* scalp = nullptr;
    const bool done = call.attempt_quick([&] {
        hints = &parting_of(curve->owner->style(), curve->id).hints;
        scalp = &curve->owner->style().scalp();
    });
    if (!done) return call.fail();
    return push_list(call, *hints, [&](const auto& hint) {
        push_list(call, hint,
                  [&](const Vec3& point) { call.push_vector(scalp->from_metres(point)); });
    });
}

int remove_hints(Call& call) {
    const auto curve = call.self<CurveObject>();
    const bool done = call.attempt([&] {
        Hairstyle& style = curve->owner->style();
        StyleCurve changed = style.curve(curve->id);
        (void)parting_of(style, curve->id);
        std::get<DividingCurve>(changed.shape).hints.clear();
        style.set(curve->id, std::move(changed));
    });
    return done ? call.push_argument() : call.fail();
}

// ---- Descriptions

std::string hint_example() {
    return kParting + R"(local hint = { style:at{ azimuth = 10, elevation = 60 },
               style:at{ azimuth = 20, elevation = 66 } }
)";
}
const std::vector<ErrorCode> kTiltErrors = {ErrorCode::invalid_argument, ErrorCode::handle_removed};

}  // namespace

std::vector<Function> tilt_methods() {
    return {
        {.name = "tilt",
         .body = curve_tilt,
         .summary = "By how much hair on both sides of a dividing curve is turned towards the "
                    "curve's end, as the options say or as the hints do.",
         .results = {{"lissom.CurveTilt", "tilt", "Tilt of both sides."}},
         .errors = kTiltErrors,
         .example = kParting + "assert(parting:tilt().left.start == 0)"},
        {.name = "add_hint",
         .body = add_hint,
         .summary = "A stroke beside a dividing curve that says which way hair flows away from it. "
                    "The curve keeps its hints, and all hints on a side tell its tilt together; "
                    "one alone means an even tilt. To set the tilt by numbers takes them out.",
         .arguments = {points("hint",
                              "A polyline away from the curve, at most 0.03 metres of an average "
                              "head beside it.")
                           .in("mesh units")},
         .results = {{"lissom.CurveTilt", "tilt", "The present tilt of the curve."}},
         .effect = Effect::changes,
         .errors = {ErrorCode::not_finite, ErrorCode::invalid_argument, ErrorCode::out_of_range,
                    ErrorCode::handle_removed, ErrorCode::memory_limit},
         .example =
             hint_example() + "local tilt = parting:add_hint(hint)\nassert(tilt.right.pieces > 0)"},
        {.name = "hints",
         .body = curve_hints,
         .summary = "The hints of a dividing curve.",
         .results = {{"number[][][]", "hints", "A list of points {x, y, z} each, in mesh units."}},
         .errors = kTiltErrors,
         .example = hint_example() + "parting:add_hint(hint)\nassert(#parting:hints()[1] == 2)"},
        {.name = "remove_hints",
         .body = remove_hints,
         .summary = "Takes the hints of a dividing curve out: its tilts are those of its options.",
         .results = {{"lissom.Curve", "curve", "The curve itself."}},
         .errors = kTiltErrors,
         .example = hint_example() +
                    "parting:add_hint(hint)\nassert(#parting:remove_hints():hints() == 0)"}};
}

std::vector<Record> curve_records() {
    return {{"lissom.CurveTilt",
             "The tilts of a dividing curve.",
             {{"lissom.SideTilt", "left", "Tilt seen along the curve from outside."},
              {"lissom.SideTilt", "right", "The other side."}}},
            {"lissom.SideTilt",
             "The tilt of one side of a dividing curve, in degrees.",
             {{"number", "start", "At the curve's first point."},
              {"number", "finish", "At its last point."},
              {"integer", "pieces", "Pieces of hints, about 0.003 metres long, that told it."},
              {"number", "error", "By how much these differ from it (root of mean square)."}}},
            {"lissom.HairTie",
             "The ring around the beginning of a ponytail.",
             {{"number[]", "center", "In mesh units."},
              {"number[]", "direction",
               "Direction of the spine there, away from the head; of length 1."},
              {"number", "radius", "In metres of an average head."}}}};
}

}  // namespace lissom::lua
