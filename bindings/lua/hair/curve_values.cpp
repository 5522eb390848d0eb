// lissom.Curve: the options of a curve as they act.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/hair/hair_object.h"

namespace lissom::lua {
namespace {

// Sets fields of the table on top of the stack, under the names that curve:set takes.
class CurveFields {
  public:
    CurveFields(const Call& call, const Hairstyle& style, CurveId id)
        : call_(call), style_(style), id_(id), step_(style.layout().step) {}

    void operator()(const StreamCurve& stream) const {
        number("stop", stream.options.stop_length);
        number("clearance", stream.clearance);
        number("weight", stream.options.weight);
    }
    void operator()(const DividingCurve& dividing) const {
        const TiltFit& fit = style_.tilt(id_);
        angles("left", fit.left.tilt);
        angles("right", fit.right.tilt);
        const DividingOptions o = with_lengths(dividing.options, step_);
        number("sigma", *o.sigma);
        number("height", *o.height);
        number("reach", *o.reach);
        number("thickness", *o.thickness);
        number("separation", o.separation);
        number("wall_width", *o.wall_width);
        number("wall_height", *o.wall_height);
        number("ramp", *o.ramp);
        number("gap", dividing.gap);
        number("weight", o.weight);
    }
    void operator()(const Ponytail& ponytail) const {
        const PonytailOptions o = with_lengths(ponytail.options, step_);
        const HairTie& tie = style_.tie(id_);
        number("stop", o.stop_length);
        number("radius", tie.radius);
        number("share", o.share);
        number("fullness", o.fullness);
        number("inner", o.inner);
        number("outer", o.outer);
        number("ring", *o.ring);
        number("free", *o.clearance);
        number("lead", *o.lead);
        number("grip", o.grip);
        number("spread", o.spread);
        number("tightness", o.tightness);
        if (tie.tail_length) number("tail_length", *tie.tail_length);
        number("ragged", ponytail.ragged);
        number("weight", o.weight);
    }

  private:
    void number(const char* key, double value) const { call_.set_field(key, call_.push(value)); }
    void angles(const char* key, const DividingOptions::Tilt& tilt) const {
        const double degrees[] = {tilt.start / kDegree, tilt.end / kDegree};
        call_.set_field(key, call_.push_numbers(degrees));
    }

    const Call& call_;
    const Hairstyle& style_;
    CurveId id_;
    double step_;
};

int curve_options(Call& call) {
    const auto curve = call.self<CurveObject>();
    const Hairstyle* style = nullptr;
    const StyleCurve* found = nullptr;
    const bool done = call.attempt_quick([&] {
        style = &curve->owner->style();
        found = &style->curve(curve->id);
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 17);
    call.set_field("name", call.push(std::string_view(found->name)));
    call.set_field("enabled", call.push(found->enabled));
    std::visit(CurveFields(call, *style, curve->id), found->shape);
    return 1;
}

int curve_tie(Call& call) {
    const auto curve = call.self<CurveObject>();
    const HairTie* tie = nullptr;
    const Scalp* scalp = nullptr;
    const bool done = call.attempt_quick([&] {
        tie = &curve->owner->style().tie(curve->id);
        scalp = &curve->owner->style().scalp();
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 3);
    call.set_field("center", call.push_vector(scalp->from_metres(tie->center)));
    call.set_field("direction",
                   call.push_vector(scalp->frame().axes * tie->direction.normalized()));
    call.set_field("radius", call.push(tie->radius));
    return 1;
}

// Finds the options of a ponytail and the scalp that its points lie over.
bool find_tail(Call& call, const PonytailOptions*& options, const Scalp*& scalp) {
    const auto curve = call.self<CurveObject>();
    return call.attempt_quick([&] {
        const Hairstyle& style = curve->owner->style();
        (void)style.tie(curve->id);
        options = &std::get<Ponytail>(style.curve(curve->id).shape).options;
        scalp = &style.scalp();
    });
}

int push_in_mesh_units(const Call& call, const Scalp& scalp, const std::vector<Vec3>& metres) {
    return push_list(call, metres,
                     [&](const Vec3& point) { call.push_vector(scalp.from_metres(point)); });
}

int curve_section(Call& call) {
    const PonytailOptions* options = nullptr;
    const Scalp* scalp = nullptr;
    if (!find_tail(call, options, scalp)) return call.fail();
    return push_in_mesh_units(call, *scalp, options->section);
}

int curve_profiles(Call& call) {
    const PonytailOptions* options = nullptr;
    const Scalp* scalp = nullptr;
    if (!find_tail(call, options, scalp)) return call.fail();
    lua_createtable(call.lua(), 2, 0);
    for (int side = 0; side < 2; ++side) {
        push_in_mesh_units(call, *scalp, options->profiles[side]);
        lua_rawseti(call.lua(), -2, side + 1);
    }
    return 1;
}

std::string tail_example() {
    return kStyle + R"(local tie = style:at{ azimuth = 180, elevation = 25, lift = 0.02 }
local tail = style:add_ponytail{ spine = { tie, { tie[1], tie[2] - 0.1, tie[3] - 0.05 } } }
)";
}

}  // namespace

std::vector<Function> option_methods() {
    const std::vector<ErrorCode> errors = {ErrorCode::invalid_argument, ErrorCode::handle_removed};
    return {{.name = "options",
             .body = curve_options,
             .summary = "Its effective options, by the names and in the units of `set`: also "
                        "defaults, and those that follow from the drawn points.",
             .results = {{"table", "options", "A table of its own."}},
             .errors = {ErrorCode::handle_removed},
             .example = kParting + "assert(parting:options().separation == 0.3)"},
            {.name = "tie",
             .body = curve_tie,
             .summary = "The point at which a ponytail is tied.",
             .results = {{"lissom.HairTie", "tie", "Its first cross section."}},
             .errors = errors,
             .example = tail_example() + "assert(tail:tie().radius > 0)"},
            {.name = "section",
             .body = curve_section,
             .summary = "The curve that was drawn around the spine of a ponytail.",
             .results = {{"number[][]", "points", "In mesh units; none if there are none."}},
             .errors = errors,
             .example = tail_example() + "assert(#tail:section() == 0)"},
            {.name = "profiles",
             .body = curve_profiles,
             .summary = "The curves that were drawn along a ponytail, as `set` takes them.",
             .results = {{"number[][][]", "profiles",
                          "Two lists of points in mesh units, each empty if there is none."}},
             .errors = errors,
             .example = tail_example() + "assert(#tail:profiles()[1] == 0)"}};
}

}  // namespace lissom::lua
