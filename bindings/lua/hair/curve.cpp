// lissom.Curve: a curve of a hairstyle.
#include "kernel/hair/curve/curve.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"
#include "kernel/hair/curve/hint.h"

namespace lissom::lua {

bool push_curve(Call& call, const std::shared_ptr<HairstyleObject>& style, CurveId id) {
    const auto result = call.create<CurveObject>();
    return call.attempt_quick([&] {
        result.set(std::make_shared<CurveObject>(CurveObject{style, id}));
    });
}

namespace {

// Runs work(Hairstyle&, CurveId), which changes the curve, and returns the curve.
template <typename Work>
int change_curve(Call& call, const Work& work) {
    const auto curve = call.self<CurveObject>();
    const bool done = call.attempt(
        [&] { curve->owner->edit(call, [&](Hairstyle& style) { work(style, curve->id); }); });
    return done ? call.push_argument() : call.fail();
}

// Runs work(const StyleCurve&), which gives plain data to push.
template <typename Work>
int tell(Call& call, const Work& work) {
    const auto curve = call.self<CurveObject>();
    using Told = decltype(work(std::declval<const StyleCurve&>()));
    Told told{};
    const bool done =
        call.attempt_quick([&] { told = work(curve->owner->style().curve(curve->id)); });
    return done ? call.push(told) : call.fail();
}

int curve_kind(Call& call) {
    return tell(call, [](const StyleCurve& curve) { return kind_name(curve); });
}

int curve_name(Call& call) {
    return tell(call, [](const StyleCurve& curve) { return std::string_view(curve.name); });
}

int curve_enabled(Call& call) {
    return tell(call, [](const StyleCurve& curve) { return curve.enabled; });
}

// A list of points of the frame as a list of points of the mesh.
template <typename Points>
int push_curve_points(Call& call, const Points& points_of) {
    const auto curve = call.self<CurveObject>();
    const std::vector<Vec3>* list = nullptr;
    const Scalp* scalp = nullptr;
    const bool done = call.attempt_quick([&] {
        const Hairstyle& style = curve->owner->style();
        list = &points_of(style, curve->id);
        scalp = &style.scalp();
    });
    if (!done) return call.fail();
    return push_list(call, *list,
                     [&](const Vec3& point) { call.push_vector(scalp->from_metres(point)); });
}

int curve_points(Call& call) {
    return push_curve_points(call,
                             [](const Hairstyle& style, CurveId id) -> const std::vector<Vec3>& {
                                 return drawn_points(style.curve(id));
                             });
}

int curve_course(Call& call) {
    return push_curve_points(call,
                             [](const Hairstyle& style, CurveId id) -> const std::vector<Vec3>& {
                                 return style.course(id);
                             });
}

std::vector<Vec3> points_in_metres(const Call& call, const char* path, const Hairstyle& style) {
    std::vector<Vec3> points;
    for (const Vec3& p : call.points(path)) points.push_back(style.scalp().to_metres(p));
    return points;
}

int set_curve_points(Call& call) {
    return change_curve(call, [&](Hairstyle& style, CurveId id) {
        style.set_points(id, points_in_metres(call, "points", style));
    });
}

int set_curve(Call& call) {
    const CurveReader reader(call, true);
    return change_curve(call, [&](Hairstyle& style, CurveId id) {
        StyleCurve changed = style.curve(id);
        refuse_other_options(call, changed);
        forget_hints(call, style, id, changed);
        reader.read(style.scalp(), changed);
        style.set(id, std::move(changed));
    });
}

int enable_curve(Call& call) {
    const bool on = call.boolean("on");
    return change_curve(call, [&](Hairstyle& style, CurveId id) { style.enable(id, on); });
}

int reorder_curve(Call& call) {
    const Index place = call.id("place");
    return change_curve(call, [&](Hairstyle& style, CurveId id) { style.reorder(id, place); });
}

int remove_curve(Call& call) {
    const auto curve = call.self<CurveObject>();
    const bool done = call.attempt([&] { curve->owner->style().remove(curve->id); });
    if (!done) return call.fail();
    call.charge(curve->owner);
    return 0;
}

// Replaces the drawn points by edit(curve, hint, options); the curve is as smooth as it is seen.
template <typename Edit>
int edit_by_hint(Call& call, bool joins, const Edit& edit) {
    return change_curve(call, [&](Hairstyle& style, CurveId id) {
        HintOptions options;
        options.reach = call.number("reach");
        if (joins) options.join = call.number("join");
        const std::vector<Vec3> hint = points_in_metres(call, "hint", style);
        const std::vector<Vec3> smooth =
            smooth_curve(drawn_points(style.curve(id)), style.layout().step);
        style.set_points(id, edit(smooth, hint, options));
    });
}

int cut_by_hint(Call& call) {
    return edit_by_hint(call, false, cut_curve);
}
int concatenate_hint(Call& call) {
    return edit_by_hint(call, true, concatenated_curve);
}
int insert_hint(Call& call) {
    return edit_by_hint(call, true, inserted_curve);
}

int tell_operation(Call& call) {
    constexpr std::string_view kNames[] = {"cut", "concatenate", "insert"};
    const auto curve = call.self<CurveObject>();
    HintReading reading;
    const bool done = call.attempt([&] {
        const Hairstyle& style = curve->owner->style();
        const std::vector<Vec3> smooth =
            smooth_curve(drawn_points(style.curve(curve->id)), style.layout().step);
        reading = hint_reading(smooth, points_in_metres(call, "hint", style), call.number("near"));
    });
    if (!done) return call.fail();
    call.push(kNames[static_cast<std::size_t>(reading.operation)]);
    call.push(reading.sure);
    return 2;
}

int curve_style(Call& call) {
    return call.push_shared(call.self<CurveObject>()->owner);
}

int equal_curves(Call& call) {
    const auto a = call.self<CurveObject>(1), b = call.self<CurveObject>(2);
    return call.push(a->owner == b->owner && a->id == b->id);
}

int curve_text(Call& call) {
    const auto curve = call.self<CurveObject>();
    std::string_view kind, name;
    int count = 0;
    const bool present = call.attempt_quick([&] {
        const StyleCurve& found = curve->owner->style().curve(curve->id);
        kind = kind_name(found);
        name = found.name;
        count = count_of(drawn_points(found));
    });
    if (!present) return call.push("lissom.Curve (removed)");
    lua_pushfstring(call.lua(), "lissom.Curve: %s '%s', %d points", kind.data(), name.data(),
                    count);
    return 1;
}

// ---- Descriptions

const std::vector<ErrorCode> kCurveErrors = {ErrorCode::handle_removed};
const std::vector<ErrorCode> kChangeErrors = {ErrorCode::handle_removed,
                                              ErrorCode::invalid_argument, ErrorCode::out_of_range,
                                              ErrorCode::memory_limit};
const std::vector<Result> kSelfCurve = {{"lissom.Curve", "curve", "The curve itself."}};

std::vector<Function> telling_methods() {
    return {{.name = "kind",
             .body = curve_kind,
             .summary = "The kind of the curve.",
             .results = {{"string", "kind", "\"stream\", \"dividing\" or \"ponytail\"."}},
             .errors = kCurveErrors,
             .example = kStyle + "assert(curve:kind() == 'stream')"},
            {.name = "name",
             .body = curve_name,
             .summary = "Its name.",
             .results = {{"string", "name", "Empty if it has none."}},
             .errors = kCurveErrors,
             .example = kStyle + "assert(curve:name() == 'side')"},
            {.name = "enabled",
             .body = curve_enabled,
             .summary = "Whether it has an effect.",
             .results = {{"boolean", "enabled", "True if it has."}},
             .errors = kCurveErrors,
             .example = kStyle + "assert(curve:enabled())"},
            {.name = "points",
             .body = curve_points,
             .summary = "The points that it was drawn with, of a ponytail those of the spine.",
             .results = {{"number[][]", "points", "{x, y, z} each, in mesh units."}},
             .errors = kCurveErrors,
             .example = kStyle + "assert(#curve:points() == 2)"},
            {.name = "course",
             .body = curve_course,
             .summary = "The curve as it acts: smooth, outside the head, in segments of about a "
                        "step of the grid.",
             .results = {{"number[][]", "points", "{x, y, z} each, in mesh units."}},
             .errors = kCurveErrors,
             .example = kStyle + "assert(#curve:course() > 2)"},
            {.name = "hairstyle",
             .body = curve_style,
             .summary = "The hairstyle that it belongs to.",
             .results = {{"lissom.Hairstyle", "style", "The hairstyle."}},
             .example = kStyle + "assert(curve:hairstyle() == style)"}};
}

std::vector<Parameter> hint_argument(const std::string& help) {
    return {points("hint", help).in("mesh units")};
}

std::vector<Parameter> reach_option() {
    return {number("reach", "A hint that is farther from the curve has nothing to do with it.")
                .in("metres")
                .at_least(0)
                .defaults(HintOptions{}.reach)};
}

std::vector<Parameter> joining_options() {
    std::vector<Parameter> options = reach_option();
    options.push_back(
        number("join", "Length of the curve and of the hint that a smooth join replaces.")
            .in("metres")
            .at_least(0)
            .defaults(HintOptions{}.join));
    return options;
}

std::vector<Function> changing_methods() {
    return {
        {.name = "set_points",
         .body = set_curve_points,
         .summary = "Draws the curve anew.",
         .arguments = {points("points", "The new points, of a ponytail those of the spine.")
                           .in("mesh units")},
         .results = kSelfCurve,
         .errors = kChangeErrors,
         .example = kStyle + "points[2][2] = points[2][2] - 0.02\ncurve:set_points(points)"},
        {.name = "set",
         .body = set_curve,
         .summary = "Changes some of the options that it was made with.",
         .options = curve_fields(),
         .results = kSelfCurve,
         .errors = kChangeErrors,
         .example = kStyle + "curve:set{ stop = false, name = 'left' }"},
        {.name = "enable",
         .body = enable_curve,
         .summary = "Lets it act, or not.",
         .arguments = {boolean("on", "Whether it does.").defaults(true)},
         .results = kSelfCurve,
         .errors = kCurveErrors,
         .example = kStyle + "assert(not curve:enable(false):enabled())"},
        {.name = "reorder",
         .body = reorder_curve,
         .summary = "Gives it another place in the order: the later of several curves counts at "
                    "a point, but dividing curves before all others.",
         .arguments = {id("place", "Its place among the curves of the style.")},
         .results = kSelfCurve,
         .errors = {ErrorCode::handle_removed, ErrorCode::out_of_range},
         .example = kStyle + "curve:reorder(1)"},
        {.name = "remove",
         .body = remove_curve,
         .summary = "Takes it out of the style.",
         .effect = Effect::changes,
         .errors = kCurveErrors,
         .example = kStyle + "curve:remove()\nassert(#style:curves() == 0)"}};
}

std::vector<Function> hint_methods() {
    return {{.name = "hint_operation",
             .body = tell_operation,
             .summary = "The meaning of a hint stroke, by its ends and by its general "
                        "direction. Call the method of that name with it.",
             .arguments = hint_argument("A polyline that begins, ends or passes near the curve."),
             .options = {number("near",
                                "Distance from the curve that counts as on it: about 20 pixels "
                                "of the picture that the stroke was drawn in.")
                             .in("metres")
                             .above(0)
                             .defaults(0.007)},
             .results = {{"string", "operation", "\"cut\", \"concatenate\" or \"insert\"."},
                         {"boolean", "sure",
                          "False if a slightly different stroke has another meaning."}},
             .errors = kChangeErrors,
             .example = kStyle + R"(local tip = curve:points()[2]
local hint = { tip, { tip[1], tip[2] - 0.05, tip[3] } }
local operation = curve:hint_operation(hint)
assert(operation == 'concatenate')
curve[operation](curve, hint))"},
            {.name = "cut",
             .body = cut_by_hint,
             .summary = "Ends the curve at the crossing of a hint stroke.",
             .arguments = hint_argument("A polyline that passes near the curve."),
             .options = reach_option(),
             .results = kSelfCurve,
             .effect = Effect::changes,
             .errors = kChangeErrors,
             .example = kStyle + R"(local points = curve:points()
local middle = {}
for k = 1, 3 do middle[k] = (points[1][k] + points[2][k]) / 2 end
local above = { middle[1], middle[2] + 0.02, middle[3] }
curve:cut({ above, middle }, { reach = 0.02 }))"},
            {.name = "concatenate",
             .body = concatenate_hint,
             .summary = "Goes on along a hint stroke that begins near the curve: from there to the "
                        "end the curve is replaced.",
             .arguments = hint_argument("A polyline that begins near the curve."),
             .options = joining_options(),
             .results = kSelfCurve,
             .effect = Effect::changes,
             .errors = kChangeErrors,
             .example = kStyle + R"(local tip = curve:points()[2]
curve:concatenate{ tip, { tip[1], tip[2] - 0.05, tip[3] } })"},
            {.name = "insert",
             .body = insert_hint,
             .summary = "Replaces the part of the curve between the ends of a hint stroke that "
                        "begins and ends near it.",
             .arguments = hint_argument("A polyline whose ends are near the curve."),
             .options = joining_options(),
             .results = kSelfCurve,
             .effect = Effect::changes,
             .errors = kChangeErrors,
             .example = kStyle + R"(local from, to = curve:points()[1], curve:points()[2]
local out = style:at{ azimuth = 45, elevation = 35, lift = 0.03 }
curve:insert{ from, out, to })"}};
}

}  // namespace

Type curve_type() {
    Type type{.name = "lissom.Curve",
              .summary = "A style curve: says how hair flows near it. It lives in its hairstyle."};
    for (const auto& list : {telling_methods(), changing_methods(), hint_methods(), tilt_methods(),
                             option_methods()}) {
        type.methods.insert(type.methods.end(), list.begin(), list.end());
    }
    type.operators = {{"__eq", equal_curves, "a == b", "whether both are the same curve"},
                      {"__tostring", curve_text, "tostring(curve)", "its kind and name"}};
    return type;
}

}  // namespace lissom::lua
