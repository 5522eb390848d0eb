// The field of a hairstyle and its constraints.
#include <algorithm>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/hair/hair_object.h"

namespace lissom::lua {
namespace {

// Places of curves among all of a style, from 0.
Index place_of(std::span<const CurveId> order, CurveId id) {
    return index_of(std::find(order.begin(), order.end(), id) - order.begin());
}

int style_constraints(Call& call) {
    const auto style = call.self<HairstyleObject>();
    auto& list = call.hold<std::vector<StyleConstraint>>();
    const Hairstyle* own = nullptr;
    const bool done = call.attempt_quick([&] {
        own = &style->style();
        list = own->constraints();
    });
    if (!done) return call.fail();
    const Scalp& scalp = own->scalp();
    lua_createtable(call.lua(), count_of(list), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const StyleConstraint& one = list[i];
        lua_createtable(call.lua(), 0, 5);
        call.set_field("point", call.push_vector(scalp.from_metres(one.point)));
        call.set_field("vector", call.push_vector(scalp.frame().axes * one.vector));
        call.set_field("kind", call.push(kind_name(one.kind)));
        call.set_field("weight", call.push(one.weight));
        if (one.curve) call.set_field("curve", call.push_id(place_of(own->curves(), *one.curve)));
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

// Runs work(Hairstyle&) and returns the style.
template <typename Work>
int change_style(Call& call, const Work& work) {
    const auto style = call.self<HairstyleObject>();
    if (!call.attempt([&] { work(style->style()); })) return call.fail();
    call.charge(style);
    return call.push_argument();
}

int solve_style(Call& call) {
    return change_style(call, [&](Hairstyle& style) { style.solve(call.context()); });
}

int avoid_scalp(Call& call) {
    const double magnitude = call.number("magnitude");
    const bool has_band = call.has("band");
    const double band = has_band ? call.number("band") : 0.0;
    return change_style(call, [&](Hairstyle& style) {
        ScalpStepOptions all;
        all.magnitude = magnitude;
        if (has_band) all.band = band;
        style.avoid_scalp(all, call.context());
    });
}

int forget_scalp(Call& call) {
    return change_style(call, [](Hairstyle& style) { style.forget_scalp(); });
}

int style_field(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const Vec3 point = call.vector("point");
    Vec3 direction = Vec3::Zero();
    double distance = 0.0;
    const bool done = call.attempt([&] {
        Hairstyle& own = style->style();
        own.solve(call.context());
        const HairField::Sample here = own.field().sample(own.scalp().to_metres(point));
        direction = own.scalp().frame().axes * here.direction;
        distance = here.distance * own.scalp().scale();
    });
    if (!done) return call.fail();
    call.push_vector(direction);
    call.push(distance);
    return 2;
}

// ---- Descriptions

const std::vector<ErrorCode> kFieldErrors = {ErrorCode::not_positive_definite,
                                             ErrorCode::memory_limit, ErrorCode::handle_removed,
                                             ErrorCode::cancelled};
const std::vector<Result> kSolvedStyle = {{"lissom.Hairstyle", "style", "The hairstyle itself."}};

}  // namespace

std::vector<Function> style_field_methods() {
    return {
        {.name = "constraints",
         .body = style_constraints,
         .summary = "Constraints of the field from the enabled curves and avoid_scalp: one "
                    "vector a constrained grid point. `lissom.render{ style = }` draws them.",
         .results = {{"lissom.StyleConstraint[]", "constraints", "A list."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + R"(local first = style:constraints()[1]
assert(first.curve == 1 and (first.kind == 'stream' or first.kind == 'stop')))"},
        {.name = "solve",
         .body = solve_style,
         .summary = "Brings the field up to date with the curves. `grow` and `field` do so by "
                    "themselves.",
         .results = kSolvedStyle,
         .effect = Effect::changes,
         .errors = kFieldErrors,
         .example = kStyle + "style:solve()"},
        {.name = "field",
         .body = style_field,
         .summary = "The field at a point: which way hair grows there.",
         .arguments = {vector("point", "Three numbers or {x, y, z}.").in("mesh units")},
         .results = {{"number[]", "direction", "{x, y, z}; of length 1 near curves."},
                     {"number", "distance", "To the head, in mesh units; negative inside of it."}},
         .errors = kFieldErrors,
         .example = kStyle + "local v, d = style:field(curve:course()[2])\nassert(d > 0)"},
        {.name = "avoid_scalp",
         .body = avoid_scalp,
         .summary = "Turns the field along the head at points at which it points into the head "
                    "(section 4.6 of the thesis), also on the neck, past which hair only flows. "
                    "For the end of a design: it stays as it is until it is done again. Hair "
                    "that grows with `avoid` stays outside anyway.",
         .options = {number("magnitude",
                            "Length of the vectors that do so: small, so that they "
                            "change little elsewhere.")
                         .defaults(ScalpStepOptions{}.magnitude)
                         .above(0)
                         .between(0, 1),
                     number("band", "Grid points nearer to the head than this, on either side.")
                         .in("metres")
                         .above(0)
                         .optional("a grid step")},
         .results = kSolvedStyle,
         .errors = kFieldErrors,
         .example = kStyle + "style:avoid_scalp()"},
        {.name = "forget_scalp",
         .body = forget_scalp,
         .summary = "Undoes avoid_scalp.",
         .results = kSolvedStyle,
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "style:avoid_scalp():forget_scalp()"}};
}

}  // namespace lissom::lua
