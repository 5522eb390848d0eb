// lissom.Hairstyle: its style curves and sizes.
#include <algorithm>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/hair/hair_object.h"
#include "kernel/hair/style_bytes.h"

namespace lissom::lua {

Hairstyle& HairstyleObject::style() {
    if (content) return *content;
    throw Error(ErrorCode::handle_removed, "the hairstyle was closed; make a new one");
}

// Inputs are kept twice, with the curves as they act; about every point of these constrains the
// corners of a cell of the grid, in the curve's list and in that of the style.
std::size_t HairstyleObject::held_bytes() const {
    if (!content) return 0;
    constexpr std::size_t kPoint = sizeof(Vec3) + 16 * sizeof(GridConstraint);
    std::size_t bytes = 2 * lissom::memory_bytes(content->inputs());
    for (const CurveId id : content->curves()) bytes += content->course(id).size() * kPoint;
    return bytes;
}

namespace {

// ---- Curves

template <typename Shape>
int add_curve(Call& call, bool ponytails) {
    const auto style = call.self<HairstyleObject>();
    const CurveReader reader(call, ponytails);
    const auto result = call.create<CurveObject>();
    const bool done = call.attempt([&] {
        StyleCurve curve{curve_with<Shape>(style->style().options().fidelity)};
        reader.read(style->style().scalp(), curve);
        CurveId id;
        style->edit(call, [&](Hairstyle& own) { id = own.add(std::move(curve)); });
        result.set(std::make_shared<CurveObject>(CurveObject{style.share(), id}));
    });
    return done ? 1 : call.fail();
}

int add_stream(Call& call) {
    return add_curve<StreamCurve>(call, false);
}
int add_dividing(Call& call) {
    return add_curve<DividingCurve>(call, false);
}
int add_ponytail(Call& call) {
    return add_curve<Ponytail>(call, true);
}

int style_curves(Call& call) {
    const auto style = call.self<HairstyleObject>();
    auto& ids = call.hold<std::vector<CurveId>>();
    auto& owner = call.hold<std::shared_ptr<HairstyleObject>>();
    const bool done = call.attempt_quick([&] {
        const auto all = style->style().curves();
        ids.assign(all.begin(), all.end());
        owner = style.share();
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), count_of(ids), 0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (!push_curve(call, owner, ids[i])) return call.fail();
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

// ---- Its parts

int style_at(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const Scalp* scalp = nullptr;
    if (!call.attempt_quick([&] { scalp = &style->style().scalp(); })) return call.fail();
    return push_point_at(call, *scalp);
}

int style_normal_at(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const Scalp* scalp = nullptr;
    if (!call.attempt_quick([&] { scalp = &style->style().scalp(); })) return call.fail();
    return push_normal_at(call, *scalp);
}

int style_scalp(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const auto result = call.create<ScalpObject>();
    const bool done = call.attempt_quick([&] {
        result.set(std::make_shared<ScalpObject>(style->head, style->style().shared_scalp()));
    });
    return done ? 1 : call.fail();
}

int style_head(Call& call) {
    return push_owner(call, call.self<HairstyleObject>()->head);
}

std::string_view fidelity_name(const Hairstyle& style) {
    return style.options().fidelity == HairFidelity::thesis ? "thesis" : "default";
}

int style_stats(Call& call) {
    const auto style = call.self<HairstyleObject>();
    GridLayout layout;
    int constraints = 0, curves = 0;
    std::string_view fidelity;
    const bool done = call.attempt_quick([&] {
        const Hairstyle& own = style->style();
        layout = own.layout();
        fidelity = fidelity_name(own);
        constraints = own.field().grid().constraint_count();
        curves = index_of(own.curves().size());
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 5);
    call.set_field("fidelity", call.push(fidelity));
    call.set_field("curves", call.push(curves));
    call.set_field("constraints", call.push(constraints));
    call.set_field("grid_points", call.push(layout.size()));
    call.set_field("step", call.push(layout.step));
    return 1;
}

int style_text(Call& call) {
    const auto style = call.self<HairstyleObject>();
    int curves = 0, points = 0;
    bool thesis = false;
    const bool open = call.attempt_quick([&] {
        curves = index_of(style->style().curves().size());
        points = style->style().layout().size();
        thesis = style->style().options().fidelity == HairFidelity::thesis;
    });
    if (!open) return call.push("lissom.Hairstyle (closed)");
    lua_pushfstring(call.lua(), "lissom.Hairstyle: %d curves, %d grid points%s", curves, points,
                    thesis ? ", as in the thesis" : "");
    return 1;
}

// ---- Descriptions

const std::vector<ErrorCode> kAddErrors = {ErrorCode::not_finite, ErrorCode::invalid_argument,
                                           ErrorCode::out_of_range, ErrorCode::handle_removed,
                                           ErrorCode::memory_limit};
// The points of a curve, which are an argument, and its options.
std::vector<Parameter> first_of(const std::vector<Parameter>& fields) {
    return {fields.front()};
}
std::vector<Parameter> rest_of(const std::vector<Parameter>& fields) {
    return {fields.begin() + 1, fields.end()};
}

std::vector<Function> adding_methods() {
    const std::vector<Result> curve = {{"lissom.Curve", "curve", "The curve, behind all others."}};
    return {
        {.name = "add_stream",
         .body = add_stream,
         .summary = "Adds a stream curve: hair flows along it.",
         .arguments = first_of(stream_fields()),
         .named_arguments = true,
         .options = rest_of(stream_fields()),
         .results = curve,
         .effect = Effect::changes,
         .errors = kAddErrors,
         .example = kStyle},
        {.name = "add_dividing",
         .body = add_dividing,
         .summary = "Adds a dividing curve: hair parts along it. In a grid of more points the same "
                    "lengths in metres mean the same style; the defaults follow the grid.",
         .arguments = first_of(dividing_fields()),
         .named_arguments = true,
         .options = rest_of(dividing_fields()),
         .results = curve,
         .effect = Effect::changes,
         .errors = kAddErrors,
         .example = kStyle + R"(local parting = {}
for i, elevation in ipairs{ 40, 60, 80 } do
    parting[i] = style:at{ azimuth = 0, elevation = elevation }
end
style:add_dividing{ points = parting, tilt = { 20, 40 } })"},
        {.name = "add_ponytail",
         .body = add_ponytail,
         .summary = "Adds a ponytail: hair is drawn into a tie and goes on along a spine.",
         .arguments = first_of(ponytail_fields()),
         .named_arguments = true,
         .options = rest_of(ponytail_fields()),
         .results = curve,
         .effect = Effect::changes,
         .errors = kAddErrors,
         .example = kStyle + R"(local behind = { azimuth = 180, elevation = 25, lift = 0.02 }
local tie, out = style:at(behind), style:normal_at(behind)
local spine = { tie }
for i = 1, 3 do
    spine[i + 1] = { tie[1], tie[2] - 0.02 * i * i, tie[3] + 0.04 * i * out[3] }
end
style:add_ponytail{ spine = spine, radius = 0.016 })"}};
}

std::vector<Function> plain_methods() {
    return {
        point_at_method(style_at, kStyle + "local p = style:at{ azimuth = 90, elevation = 30 }"),
        normal_at_method(style_normal_at,
                         kStyle + "local n = style:normal_at{ azimuth = 90, elevation = 30 }"),
        {.name = "curves",
         .body = style_curves,
         .summary = "Its curves in their order.",
         .results = {{"lissom.Curve[]", "curves", "A list."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "assert(style:curves()[1] == curve)"},
        {.name = "scalp",
         .body = style_scalp,
         .summary = "The scalp that it was made for.",
         .results = {{"lissom.Scalp", "scalp", "The scalp."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "local center = style:scalp():center()"},
        {.name = "head",
         .body = style_head,
         .summary = "The mesh of the head.",
         .results = {{"lissom.Mesh", "head", "The mesh."}},
         .errors = {ErrorCode::topology_mismatch},
         .example = kStyle + "assert(style:head() == head)"},
        style_save_method(),
        {.name = "stats",
         .body = style_stats,
         .summary = "Sizes of the grid and of the system.",
         .results = {{"lissom.HairstyleStats", "stats", "Numbers."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "assert(style:stats().curves == 1)"}};
}

}  // namespace

Type hairstyle_type() {
    Type type{
        .name = "lissom.Hairstyle",
        .summary =
            "Style curves on a head, and the hair that follows them. It is made for "
            "the shape that the head had then. Lengths among its options are in "
            "metres of an average head, so that a style fits any head; points are in "
            "mesh units.",
        .close = [](void* object) { static_cast<HairstyleObject*>(object)->content.reset(); }};
    for (const auto& list : {plain_methods(), adding_methods(), style_field_methods(),
                             style_growth_methods(), style_stroke_methods()}) {
        type.methods.insert(type.methods.end(), list.begin(), list.end());
    }
    type.operators = {{"__tostring", style_text, "tostring(style)", "its size"}};
    return type;
}

std::vector<Record> hairstyle_records() {
    std::vector<Record> records{
        {"lissom.StyleConstraint",
         "A vector that a hairstyle gives its field at a grid point.",
         {{"number[]", "point", "{x, y, z}, in mesh units."},
          {"number[]", "vector", "{x, y, z}: the field there, of length 1 at most."},
          {"string", "kind",
           "Its source: \"stream\", along a stream curve; \"stop\", vanishing beyond its end; "
           "\"parting\", along the Gaussian beside a dividing curve, and \"separation\" above "
           "it; \"section\", \"spine\" and \"gather\" of a ponytail: near its cross sections, "
           "along the rest of its spine, into its tie; \"scalp\", of avoid_scalp."},
          {"integer?", "curve", "Place of the curve among style:curves(); nil for the scalp's."},
          {"number", "weight", "Weight with which it is kept."}}},
        {"lissom.HairstyleStats",
         "Sizes of a hairstyle.",
         {{"string", "fidelity", "\"default\" or \"thesis\"."},
          {"integer", "curves", "Number of curves."},
          {"integer", "constraints", "Constrained grid points of the last solve."},
          {"integer", "grid_points", "Points of the grid."},
          {"number", "step",
           "Distance of neighbouring grid points, in metres of an average "
           "head."}}}};
    for (Record& record : style_stroke_records()) records.push_back(std::move(record));
    return records;
}

}  // namespace lissom::lua
