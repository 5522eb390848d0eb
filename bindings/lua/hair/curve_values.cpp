// lissom.Curve: the options of a curve as they act.
#include "bindings/lua/core/library.h"
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
        number("tail_length", tie.tail_length);
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

}  // namespace

std::vector<Function> option_methods() {
    return {
        {.name = "options",
         .body = curve_options,
         .summary = "Its options as they act, by the names and in the units of `set`: also "
                    "those that were not given, and those that follow from what was drawn.",
         .results = {{"table", "options", "A table of its own."}},
         .errors = {ErrorCode::handle_removed},
         .example = kParting + "assert(parting:options().separation == 0.3)"},
        {.name = "tie",
         .body = curve_tie,
         .summary = "Where a ponytail is tied.",
         .results = {{"lissom.HairTie", "tie", "Its first cross section."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::handle_removed},
         .example = kStyle + R"(local tie = style:at{ azimuth = 180, elevation = 25, lift = 0.02 }
local tail = style:ponytail{ spine = { tie, { tie[1], tie[2] - 0.1, tie[3] - 0.05 } } }
assert(tail:tie().radius > 0))"}};
}

}  // namespace lissom::lua
