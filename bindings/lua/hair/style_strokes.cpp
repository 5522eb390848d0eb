// lissom.Hairstyle: strokes on a whole style: painting masks and combing.
#include <string>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"
#include "kernel/hair/comb.h"

namespace lissom::lua {
namespace {

constexpr const char* kMaskKinds[] = {"length", "density"};

std::vector<Vec3> points_in_metres(const Call& call, const Scalp& scalp) {
    std::vector<Vec3> points;
    for (const Vec3& p : call.points("points")) points.push_back(scalp.to_metres(p));
    return points;
}

// ---- Masks

int add_mask(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const bool done = call.attempt([&] {
        MaskStroke stroke;
        stroke.kind = call.choice<MaskKind>("kind");
        stroke.points = points_in_metres(call, style->style().scalp());
        stroke.value = call.number("value");
        stroke.radius = call.number("radius");
        stroke.softness = call.number("softness");
        style->edit(call, [&](Hairstyle& own) { own.add_mask(std::move(stroke)); });
    });
    return done ? call.push_argument() : call.fail();
}

int push_mask(const Call& call, const Scalp& scalp, const MaskStroke& mask) {
    lua_State* L = call.lua();
    lua_createtable(L, 0, 5);
    push_list(call, mask.points,
              [&](const Vec3& point) { call.push_vector(scalp.from_metres(point)); });
    call.set_field("points");
    call.set_field("kind", call.push(kMaskKinds[static_cast<int>(mask.kind)]));
    call.set_field("value", call.push(mask.value));
    call.set_field("radius", call.push(mask.radius));
    call.set_field("softness", call.push(mask.softness));
    return 1;
}

int list_masks(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const Hairstyle* own = nullptr;
    if (!call.attempt_quick([&] { own = &style->style(); })) return call.fail();
    push_list(call, own->masks(), [&](const auto& mask) { push_mask(call, own->scalp(), mask); });
    return 1;
}

int clear_masks(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const bool done = call.attempt([&] {
        for (const MaskKind kind : {MaskKind::length, MaskKind::density}) {
            const bool wanted = !call.has("kind") || call.choice<MaskKind>("kind") == kind;
            if (wanted) style->style().clear_masks(kind);
        }
    });
    if (!done) return call.fail();
    call.charge(style);
    return call.push_argument();
}

// ---- The comb

int push_comb(Call& call, const std::shared_ptr<HairstyleObject>& style, const CombReport& report) {
    lua_State* L = call.lua();
    lua_createtable(L, 0, 5);
    lua_createtable(L, count_of(report.bent), 0);
    for (std::size_t i = 0; i < report.bent.size(); ++i) {
        if (!push_curve(call, style, report.bent[i])) return call.fail();
        lua_rawseti(L, -2, index_of(i) + 1);
    }
    call.set_field("bent");
    if (report.added) {
        if (!push_curve(call, style, *report.added)) return call.fail();
        call.set_field("added");
    }
    call.set_field("before", call.push(report.before / kDegree));
    call.set_field("after", call.push(report.after / kDegree));
    call.set_field("change", call.push(report.change));
    return 1;
}

int comb_style(Call& call) {
    const auto style = call.self<HairstyleObject>();
    auto& report = call.hold<CombReport>();
    auto& owner = call.hold<std::shared_ptr<HairstyleObject>>();
    const bool done = call.attempt([&] {
        CombOptions options;
        options.by = call.choice<CombBy>("by");
        options.reach = call.number("reach");
        options.tolerance = call.number("tolerance") * kDegree;
        style->edit(call, [&](Hairstyle& own) {
            report = comb(own, points_in_metres(call, own.scalp()), options, call.context());
        });
        owner = style.share();
    });
    if (!done) return call.fail();
    call.charge(style);
    return push_comb(call, owner, report);
}

// ---- Descriptions

const std::vector<Result> kMaskedStyle = {{"lissom.Hairstyle", "style", "The hairstyle itself."}};

Parameter mask_kind() {
    return choice("kind", {"length", "density"},
                  "Factors of the length of hair, or the relative density of its roots.");
}

std::string mask_example() {
    return kStyle + R"(style:mask{ kind = "length", value = 0.3, radius = 0.03,
    points = { style:at{ azimuth = 0, elevation = 60 } } }
)";
}

std::vector<Function> mask_methods() {
    return {
        {.name = "mask",
         .body = add_mask,
         .summary = "Paints on the scalp with a round brush to make hair shorter, longer or "
                    "thinner. A style keeps its strokes, in metres of an average head, and hair "
                    "grows by them besides `lengths` and `density` of `grow`.",
         .options = {mask_kind(),
                     points("points", "The way of the brush over the head; one point is a dab.")
                         .in("mesh units"),
                     number("value",
                            "Painted value: to 4 for the length, to 1 for the density; 1 erases.")
                         .defaults(MaskStroke{}.value)
                         .between(0, kMaxLengthMask),
                     number("radius", "Radius of the brush.")
                         .in("metres")
                         .defaults(MaskStroke{}.radius)
                         .above(0),
                     number("softness", "The share of the radius over which the brush fades.")
                         .defaults(MaskStroke{}.softness)
                         .between(0, 1)},
         .results = kMaskedStyle,
         .errors = {ErrorCode::not_finite, ErrorCode::invalid_argument, ErrorCode::handle_removed},
         .example = mask_example() + "assert(style:masks()[1].value == 0.3)"},
        {.name = "masks",
         .body = list_masks,
         .summary = "The masks painted on the scalp, in their order.",
         .results = {{"lissom.ScalpMask[]", "masks", "Same as given to `mask`."}},
         .errors = {ErrorCode::handle_removed},
         .example = mask_example() + "assert(#style:masks() == 1)"},
        {.name = "clear_masks",
         .body = clear_masks,
         .summary = "Erases the masks of the scalp.",
         .options = {mask_kind().optional("both")},
         .results = kMaskedStyle,
         .errors = {ErrorCode::handle_removed},
         .example = mask_example() + "assert(#style:clear_masks():masks() == 0)"}};
}

Function comb_method() {
    const CombOptions defaults;
    return {.name = "comb",
            .body = comb_style,
            .summary =
                "Makes hair flow along a stroke, which runs as hair grows. Hair that follows it "
                "already does not change; otherwise streams beside it are bent, or one is added "
                "along it, whichever explains the stroke and changes the rest of the hair least.",
            .options =
                {points("points",
                        "The stroke, in the hair: `camera:stroke{ on = strands }` puts it there.")
                     .in("mesh units"),
                 choice("by", {"least", "bend", "add"},
                        "least: the smallest change; bent streams alone; or an added one.")
                     .defaults("least"),
                 number("reach",
                        "Streams nearer to the stroke than this are bent: wholly up to half of it, "
                        "less and less beyond.")
                     .in("metres")
                     .defaults(defaults.reach)
                     .above(0),
                 number("tolerance",
                        "Hair follows the stroke if it runs within this angle of it, root of the "
                        "mean square.")
                     .in("degrees")
                     .defaults(15)
                     .between(1, 90)},
            .results = {{"lissom.CombReport", "report", "The changes made."}},
            .effect = Effect::changes,
            .errors = {ErrorCode::not_finite, ErrorCode::invalid_argument, ErrorCode::out_of_range,
                       ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                       ErrorCode::handle_removed, ErrorCode::cancelled},
            .example = kStyle + R"(local report = style:comb{ points = {
    style:at{ azimuth = 90, elevation = 30, lift = 0.02 },
    style:at{ azimuth = 140, elevation = 20, lift = 0.02 } } }
assert(report.after < report.before))"};
}

}  // namespace

std::vector<Function> style_stroke_methods() {
    std::vector<Function> methods = mask_methods();
    methods.push_back(comb_method());
    return methods;
}

std::vector<Record> style_stroke_records() {
    return {{"lissom.ScalpMask",
             "A stroke of a brush on a scalp.",
             {{"string", "kind", "\"length\" or \"density\"."},
              {"number[][]", "points", "Its way, in mesh units."},
              {"number", "value", "Painted value."},
              {"number", "radius", "Radius of the brush, in metres of an average head."},
              {"number", "softness", "The share of the radius over which it fades."}}},
            {"lissom.CombReport",
             "Changes made by a comb.",
             {{"lissom.Curve[]", "bent", "Streams that it has bent."},
              {"lissom.Curve?", "added", "The stream that it has added."},
              {"number", "before",
               "The angle between the field and the stroke along it, root of the mean square, in "
               "degrees."},
              {"number", "after", "The same afterwards."},
              {"number", "change",
               "How much the field has changed beyond the reach of the stroke, root of the mean "
               "square; vectors near curves are of length 1."}}}};
}

}  // namespace lissom::lua
