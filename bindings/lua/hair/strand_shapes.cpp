// lissom.Strands: operators that bend, cut, remove and collide.
#include "bindings/lua/hair/strand_effect.h"
#include "kernel/hair/operators/strand_bend.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/operators/strand_cut.h"
#include "kernel/hair/operators/strand_layer.h"
#include "kernel/hair/strands/strand_edge.h"

namespace lissom::lua {
namespace {

template <typename Options, typename Work>
int run_shape_operator(Call& call, bool lengths, const Work& work) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        Options options;
        read_effect(call, asked, options, lengths);
        work(strands, options);
    });
}

int straighten_strands(Call& call) {
    return run_shape_operator<StrandOperatorOptions>(
        call, true, [&](Strands& strands, const StrandOperatorOptions& options) {
            straighten(strands, options, call.context());
        });
}

int rotate_strands(Call& call) {
    return run_shape_operator<RotateOptions>(
        call, false, [&](Strands& strands, RotateOptions& options) {
            if (call.has("axis")) options.axis = call.vector("axis");
            options.angle = call.number("angle") * kDegree;
            options.variation = call.number("variation") * kDegree;
            rotate(strands, options, call.context());
        });
}

int roll_strands(Call& call) {
    return run_shape_operator<RollOptions>(call, false,
                                           [&](Strands& strands, RollOptions& options) {
                                               options.radius = call.number("radius");
                                               options.start = call.number("start");
                                               options.outward = call.boolean("outward");
                                               if (call.has("center"))
                                                   options.center = call.vector("center");
                                               roll(strands, options, call.context());
                                           });
}

int puff_strands(Call& call) {
    return run_shape_operator<PuffOptions>(call, true, [&](Strands& strands, PuffOptions& options) {
        options.amount = call.number("amount");
        if (call.has("center")) options.center = call.vector("center");
        puff(strands, options, call.context());
    });
}

int displace_strands(Call& call) {
    return run_shape_operator<DisplaceOptions>(
        call, true, [&](Strands& strands, DisplaceOptions& options) {
            if (call.has("offset")) options.offset = call.vector("offset");
            if (call.has("offsets")) {
                const auto offsets = call.points("offsets");
                options.offsets.assign(offsets.begin(), offsets.end());
            }
            displace(strands, options, call.context());
        });
}

int set_strand_lengths(Call& call) {
    return run_shape_operator<LengthOptions>(call, false,
                                             [&](Strands& strands, LengthOptions& options) {
                                                 if (call.has("length"))
                                                     options.length = call.number("length");
                                                 options.scale = call.number("scale");
                                                 options.variation = call.number("variation");
                                                 set_length(strands, options, call.context());
                                             });
}

// ---- Cuts

// Maps metres of strands to metres of a scalp's frame.
Affine frame_of(const Scalp& scalp) {
    const Mat3 axes = scalp.frame().axes.transpose();
    return {axes / (scalp.scale() * scalp.unit()), -(axes * scalp.frame().center) / scalp.scale()};
}

Affine cut_frame(const Call& call) {
    return call.has("scalp") ? frame_of(*call.object<ScalpObject>("scalp")->scalp) : Affine();
}

// Asks the script's function about every point; runs before any C++ object is alive.
std::span<const float> ask_about_points(Call& call) {
    if (!call.has("inside")) return {};
    lua_State* L = call.lua();
    const auto self = call.self<StrandsObject>();
    const Affine frame = cut_frame(call);
    const Index count = self->strands.point_count(), size = self->strands.size();
    auto* inside = call.scratch<float>(at(count) + 1);
    for (Index s = 0; s < size; ++s) {
        for (Index k = 0; k < self->strands.point_count(s); ++k) {
            lua_pushvalue(L, call.stack_index("inside"));
            call.push_coordinates(frame(point_of(self->strands.strand(s), k)));
            call.push_id(s);
            lua_call(L, 4, 1);
            if (!self.get() || self->strands.point_count() != count ||
                self->strands.size() != size) {
                call.reject("inside", "the function must not change or close the strands");
            }
            const bool yes = lua_toboolean(L, -1) != 0;
            inside[self->strands.first_point(s) + k] = lua_type(L, -1) == LUA_TNUMBER
                                                           ? static_cast<float>(lua_tonumber(L, -1))
                                                           : (yes ? 1.0f : -1.0f);
            lua_pop(L, 1);
        }
    }
    return {inside, at(count)};
}

std::vector<HemPlace> hem_of(const Call& call) {
    std::vector<HemPlace> places;
    for (const auto& place : call.pixels("hem")) places.push_back({place[0] * kDegree, place[1]});
    return places;
}

CutShape cut_shape(const Call& call, std::span<const float> asked) {
    if (call.has("plane")) {
        return inside_plane(call.vector("plane.point"), call.vector("plane.normal"));
    }
    if (call.has("ellipsoid")) {
        return inside_ellipsoid(call.vector("ellipsoid.center"), call.vector("ellipsoid.radii"));
    }
    if (call.has("hem")) return above_hem(hem_of(call));
    return [asked](const Vec3&, Index point) { return double(asked[at(point)]); };
}

int cut_strands(Call& call) {
    const int shapes = int(call.has("plane")) + int(call.has("ellipsoid")) + int(call.has("hem")) +
                       int(call.has("inside"));
    if (shapes != 1) call.reject("inside", "give one of 'plane', 'ellipsoid', 'hem' and 'inside'");
    const std::span<const float> inside = ask_about_points(call), asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        StrandCutOptions options;
        read_part(call, asked, options);
        options.seed = static_cast<std::uint64_t>(call.integer("seed"));
        options.inside = cut_shape(call, inside);
        options.frame = cut_frame(call);
        options.jitter = call.number("jitter");
        options.guide_jitter = call.number("guide_jitter");
        options.least = call.number("least");
        cut(strands, options, call.context());
    });
}

int cull_strands(Call& call) {
    if (!call.has("mask") && !call.has("part")) call.reject("part", "give 'part', 'mask' or both");
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        StrandOperatorOptions options;
        read_part(call, asked, options);
        require_operator(strands, options);
        const double part = call.has("part") ? call.number("part") : 1.0;
        std::vector<char> marks = random_marks(strands, part * options.factor,
                                               static_cast<std::uint64_t>(call.integer("seed")));
        for (std::size_t s = 0; s < options.mask.size(); ++s) {
            if (options.mask[s] < 0.5f) marks[s] = 0;
        }
        cull(strands, marks, call.boolean("locks"));
    });
}

// ---- Collision

// Distances to a style's head in metres of strands: to the surface, and, roughly, by the grid.
void set_body(const Hairstyle& style, PushOutOptions& options) {
    const Scalp& scalp = style.scalp();
    const double metre = scalp.scale() * scalp.unit();
    options.distance = distance_to_head(style);
    if (!style.solved()) return;
    const Affine frame = frame_of(scalp);
    const DistanceGrid& grid = style.field().distances();
    options.rough = [&grid, frame, metre](const Vec3& p) { return metre * grid.value(frame(p)); };
    options.rough_error = metre * grid.layout().step;
}

// Lifts strands over hair of a layer below. Both are measured by the grid, which costs less.
void lift_over_layer(Strands& strands, const Hairstyle& style, const Strands& lower,
                     const PushOutOptions& body, const Context& context) {
    const Scalp& scalp = style.scalp();
    LiftOverOptions options;
    static_cast<StrandOperatorOptions&>(options) = body;
    options.distance = body.rough ? body.rough : body.distance;
    options.gap = body.clearance;
    const Vec3 center = scalp.unit() * scalp.frame().center;
    const LayerThickness layer(lower, options.distance, center, context);
    options.layer = &layer;
    lift_over(strands, options, context);
}

int push_strands_out(Call& call) {
    return run_shape_operator<PushOutOptions>(
        call, true, [&](Strands& strands, PushOutOptions& options) {
            const Hairstyle& style = call.object<HairstyleObject>("head")->style();
            set_body(style, options);
            options.clearance = call.number("clearance");
            options.ramp = call.number("ramp");
            if (call.has("layer")) {
                const auto lower = call.object<StrandsObject>("layer");
                require(&lower->strands != &strands,
                        "hair cannot lie over itself; give the hair of a layer below");
                lift_over_layer(strands, style, lower->strands, options, call.context());
            }
            push_out(strands, options, call.context());
        });
}

int soften_strands(Call& call) {
    const auto style = call.object<HairstyleObject>("head");
    return change_strands(call, [&](Strands& strands) {
        StrandEdgeOptions options;
        options.width = call.number("width");
        options.length = call.number("length");
        options.baby = call.number("baby");
        options.baby_length = call.number("baby_length");
        options.stray = call.number("stray");
        options.seed = static_cast<std::uint64_t>(call.integer("seed"));
        const Scalp& scalp = style->style().scalp();
        const std::vector<float> inside =
            inside_hairline(strands, style->head->mesh, scalp, call.number("reach"));
        soften_edge(strands, inside, options, call.context());
    });
}

int shrinkwrap_strands(Call& call) {
    return run_shape_operator<ShrinkwrapOptions>(
        call, true, [&](Strands& strands, ShrinkwrapOptions& options) {
            options.distance = distance_to_head(call.object<HairstyleObject>("head")->style());
            options.lift = call.number("lift");
            shrinkwrap(strands, options, call.context());
        });
}

// ---- Descriptions

Parameter center_field() {
    return vector("center", "Inside of the head, in metres of the strands.")
        .optional("the middle of all roots");
}

Parameter head_field() {
    return object("head", "lissom.Hairstyle", "A style on the head that they grew on.");
}

Function straighten_method() {
    return {.name = "straighten",
            .body = straighten_strands,
            .summary = "Stretches strands out towards the line from their root to their tip.",
            .options = effect_fields(StrandOperatorOptions()),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:straighten{ factor = 0.8 }"};
}

Function rotate_method() {
    return {
        .name = "rotate",
        .body = rotate_strands,
        .summary = "Turns strands about their roots; lengths stay.",
        .options = with_fields(
            {axis("axis", "Axis of the turn.").optional("the direction of each strand at its root"),
             number("angle", "Angle of the turn.").defaults(0.0).in("degrees"),
             number("variation", "Each strand turns up to this more or less, at random.")
                 .defaults(0.0)
                 .in("degrees")},
            effect_fields(StrandOperatorOptions(), false)),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands + "hair:rotate{ axis = \"z\", angle = 20, shape = 1 }"};
}

Function roll_method() {
    const RollOptions d;
    return {
        .name = "roll",
        .body = roll_strands,
        .summary = "Rolls up the ends of strands, as on curlers; lengths stay.",
        .options = with_fields(
            {meters("radius", "Radius of the roll.").defaults(d.radius).above(0),
             number("start", "Its beginning: 0 at the root, 1 at the tip.")
                 .defaults(d.start)
                 .between(0, 0.999),
             boolean("outward", "Rolls away from the head.").defaults(d.outward), center_field()},
            effect_fields(d, false)),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands + "hair:roll{ radius = 0.02, start = 0.6 }"};
}

Function puff_method() {
    const PuffOptions d;
    return {.name = "puff",
            .body = puff_strands,
            .summary = "Lifts strands off the head.",
            .options = with_fields(
                {meters("amount", "Distance that strands rise; negative lets them sink.")
                     .defaults(d.amount),
                 center_field()},
                effect_fields(d)),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:puff{ amount = 0.01, center = { 0, -0.1, 0 } }"};
}

Function displace_method() {
    const DisplaceOptions d;
    return {.name = "displace",
            .body = displace_strands,
            .summary = "Moves strands by vectors, tips the most; roots stay.",
            .options = with_fields(
                {vector("offset", "That all tips move, in metres.").optional("none"),
                 points("offsets", "Besides, one vector for each strand.").optional("none")},
                effect_fields(d)),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:displace{ offset = { 0.02, 0, 0 } }"};
}

Function set_length_method() {
    const LengthOptions d;
    return {.name = "set_length",
            .body = set_strand_lengths,
            .summary = "Makes strands longer or shorter by scaling them about their roots.",
            .options = with_fields(
                {meters("length", "Length of each strand.").above(0).optional("as it is"),
                 number("scale", "Factor of the length.").defaults(d.scale).above(0),
                 number("variation", "Each is up to this part longer or shorter, at random.")
                     .defaults(d.variation)
                     .between(0, 0.99)},
                effect_fields(d, false)),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands +
                       "assert(math.abs(hair:set_length{ length = 0.1 }:stats().max_length - 0.1) "
                       "< 1e-6)"};
}

Function cut_method() {
    const StrandCutOptions d;
    Parameter hem = pixels("hem",
                           "A hem around the head: {azimuth in degrees, height in metres}, linear "
                           "between; hair below is cut off. Without negative azimuths both "
                           "sides are alike.");
    return {
        .name = "cut",
        .body = cut_strands,
        .summary = "Cuts strands off where they first leave a shape.",
        .options = with_fields(
            {options("plane",
                     {vector("point", "A point of the plane."),
                      vector("normal", "Points to the side that is cut off.")},
                     "Hair beyond a plane is cut off.")
                 .optional(),
             options("ellipsoid",
                     {vector("center", "Its center."), vector("radii", "Along the axes.")},
                     "Hair outside of an ellipsoid is cut off.")
                 .optional(),
             hem.optional(),
             function("inside",
                      "fun(x: number, y: number, z: number, strand: integer): number|boolean",
                      "Asked with each point; below 0, or false, is cut off.")
                 .optional(),
             object("scalp", "lissom.Scalp",
                    "The shape is in metres of this scalp's frame: x to the left of the head, y "
                    "up, z to the front.")
                 .optional("in metres and along the axes of the strands"),
             meters("jitter", "Each strand meets the shape moved by up to this, at random.")
                 .defaults(d.jitter)
                 .at_least(0),
             meters("guide_jitter", "The same for each guide with its strands.")
                 .defaults(d.guide_jitter)
                 .at_least(0),
             meters("least", "No strand becomes shorter.").defaults(d.least).above(0),
             integer("seed", "Another seed gives another result of the same kind.").defaults(1)},
            part_fields()),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands +
                   "hair:cut{ inside = function(_, y) return 0.15 - y end }\n"
                   "assert(hair:bounds().max[2] < 0.1501)"};
}

Function cull_method() {
    return {.name = "cull",
            .body = cull_strands,
            .summary = "Removes strands: a part of them at random, or those of a mask.",
            .options = with_fields(
                {number("part", "Part of the strands that goes.")
                     .between(0, 1)
                     .optional("all of the mask"),
                 boolean("locks", "All strands of a guide go if one goes.").defaults(false),
                 integer("seed", "Another seed removes others.").defaults(1)},
                part_fields()),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands +
                       "assert(#hair:cull{ mask = function(_, x) return x > 0.005 end } == 1)"};
}

Function push_out_method() {
    const PushOutOptions d;
    return {
        .name = "push_out",
        .body = push_strands_out,
        .summary =
            "Moves hair that lies in the head, the neck or the shoulders out of them; "
            "segments between points count too.",
        .options = with_fields(
            {head_field(),
             object("layer", "lissom.Strands",
                    "Hair below: strands are lifted over it first, by the clearance above the "
                    "thickness that it has over the head, and by up to 6 mm more at random.")
                 .optional("none"),
             meters("clearance", "Distance that hair stays off the surface.")
                 .defaults(d.clearance)
                 .at_least(0),
             meters("ramp", "Length from the root over which it comes to stay off so far.")
                 .defaults(d.ramp)
                 .at_least(0)},
            effect_fields(d)),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kStyle + "local hair = style:grow{ count = 20 }\nhair:push_out{ head = style }"};
}

Function soften_edge_method() {
    const StrandEdgeOptions d;
    return {
        .name = "soften_edge",
        .body = soften_strands,
        .summary = "Makes strands at the hairline finer and shorter, and some of them baby hair.",
        .options =
            {head_field(),
             meters("reach", "Distance inside the hairline from which hair is as usual.")
                 .defaults(0.02)
                 .above(0),
             number("width", "Factor of the widths at the edge.")
                 .defaults(d.width)
                 .between(0.01, 1),
             number("length", "Factor of the lengths at the edge.")
                 .defaults(d.length)
                 .between(0.01, 1),
             number("baby", "Share of the strands at the edge that are baby hair.")
                 .defaults(d.baby)
                 .between(0, 1),
             meters("baby_length", "Length of baby hair, at most.")
                 .defaults(d.baby_length)
                 .above(0),
             meters("stray", "Distance that tips of baby hair lean away.")
                 .defaults(d.stray)
                 .at_least(0),
             integer("seed", "Another seed gives another result of the same kind.").defaults(1)},
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example =
            kStyle + "local hair = style:grow{ count = 20 }\nhair:soften_edge{ head = style }"};
}

Function shrinkwrap_method() {
    const ShrinkwrapOptions d;
    return {
        .name = "shrinkwrap",
        .body = shrinkwrap_strands,
        .summary = "Draws strands onto the head.",
        .options = with_fields(
            {head_field(),
             meters("lift", "Distance above the surface.").defaults(d.lift).at_least(0)},
            effect_fields(d)),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kStyle +
                   "local hair = style:grow{ count = 20 }\nhair:shrinkwrap{ head = style, lift = "
                   "0.004 }"};
}

}  // namespace

std::vector<Function> strand_shape_methods() {
    return {straighten_method(), rotate_method(),      roll_method(),      puff_method(),
            displace_method(),   set_length_method(),  cut_method(),       cull_method(),
            push_out_method(),   soften_edge_method(), shrinkwrap_method()};
}

}  // namespace lissom::lua
