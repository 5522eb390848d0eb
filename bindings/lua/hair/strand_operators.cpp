// lissom.Strands: operators.
#include "kernel/hair/strands/strand_operators.h"
#include "bindings/lua/hair/strand_effect.h"
#include "kernel/hair/strands/strand_clump.h"
#include "kernel/hair/strands/strand_noise.h"
#include "kernel/hair/strands/strand_trim.h"

namespace lissom::lua {
namespace {

std::uint64_t seed(const Call& call) {
    return call.integer("seed");
}

int clump_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        ClumpOptions options;
        options.clumps = call.has("clumps") ? call.integer("clumps") : 0;
        options.strength = call.number("strength");
        options.variation = call.number("variation");
        options.shape = call.number("shape");
        options.radius = call.number("radius");
        options.apart = call.number("apart");
        options.tip_spread = call.number("tip_spread");
        options.offset = call.number("offset");
        options.within_groups = call.boolean("within_groups");
        options.keep_length = call.boolean("keep_length");
        options.seed = seed(call);
        read_part(call, asked, options.effect);
        clump(strands, options, call.context());
    });
}

int noise_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        NoiseOptions options;
        options.amplitude = call.number("amplitude");
        options.across = call.number("across");
        options.along = call.number("along");
        options.shape = call.number("shape");
        options.cumulative = call.boolean("cumulative");
        options.keep_length = call.boolean("keep_length");
        options.seed = seed(call);
        read_part(call, asked, options.effect);
        noise(strands, options, call.context());
    });
}

int taper_strands(Call& call) {
    const TaperOptions options{call.number("tip"), call.number("start"), call.number("shape")};
    return change_strands(call, [&](Strands& s) { taper(s, options); });
}

int trim_strands(Call& call) {
    StrandTrimOptions options;
    if (call.has("length")) options.length = call.number("length");
    options.factor = call.number("factor");
    options.variation = call.number("variation");
    if (call.has("plane")) {
        options.plane = StrandTrimPlane{call.vector("plane.point"), call.vector("plane.normal")};
    }
    options.jitter = call.number("jitter");
    options.least = call.number("least");
    options.seed = seed(call);
    return change_strands(call, [&](Strands& s) { trim(s, options, call.context()); });
}

int smooth_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        StrandSmoothOptions options;
        options.iterations = call.integer("iterations");
        options.strength = call.number("strength");
        read_part(call, asked, options.effect);
        smooth(strands, options, call.context());
    });
}

Parameter shape_field(double value, const std::string& help) {
    return number("shape", help).defaults(value).above(0);
}
Parameter seed_field() {
    return integer("seed", "Another seed gives another result of the same kind.").defaults(1);
}
Parameter keep_length_field() {
    return boolean("keep_length", "Segments keep their lengths.").defaults(true);
}

Function clump_method() {
    const ClumpOptions d;
    return {
        .name = "clump",
        .body = clump_strands,
        .summary = "Gathers strands around guides; roots stay.",
        .options = with_fields(
            {integer("clumps", "Number of guides: the strands of the lowest ids.")
                 .at_least(1)
                 .optional("the guides that strands have, else 900, at most one for eight strands"),
             number("strength", "Part of the way to the guide that tips move.")
                 .defaults(d.strength)
                 .between(0, 1),
             number("variation",
                    "The strength of a clump is up to this fraction higher or "
                    "lower, at random.")
                 .defaults(d.variation)
                 .between(0, 1),
             shape_field(d.shape,
                         "The pull grows with this power of the place along the "
                         "strand."),
             meters("radius", "Strands rooted further from their guide stay.")
                 .defaults(d.radius)
                 .above(0)
                 .or_infinite(),
             number("apart",
                    "Weight of it in the choice of a guide that strands are "
                    "combed apart, as at a parting.")
                 .defaults(d.apart)
                 .at_least(0),
             meters("tip_spread", "Random distance by which tips miss their guide.")
                 .defaults(d.tip_spread)
                 .at_least(0),
             meters("offset", "Random distance by which the tip of a whole clump moves.")
                 .defaults(d.offset)
                 .at_least(0),
             boolean("within_groups", "Guides are of the strand's own group.")
                 .defaults(d.within_groups),
             keep_length_field(), seed_field()},
            part_fields()),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands + "hair:clump{ clumps = 1, strength = 0.5 }"};
}

Function noise_method() {
    const NoiseOptions d;
    return {
        .name = "noise",
        .body = noise_strands,
        .summary = "Lets strands wander off their course, neighbours together; roots stay.",
        .options = with_fields(
            {meters("amplitude",
                    "Greatest distance, about, that a tip moves. It moves less if that "
                    "would turn a segment by more than 27 degrees; a warning says so.")
                 .defaults(d.amplitude)
                 .at_least(0),
             meters("across", "Distance of roots that wander apart.").defaults(d.across).above(0),
             meters("along", "Length along a strand of one deviation.").defaults(d.along).above(0),
             shape_field(d.shape,
                         "The amplitude grows with this power of the place "
                         "along the strand."),
             boolean("cumulative", "Deviations add up along the strand.").defaults(d.cumulative),
             keep_length_field(), seed_field()},
            part_fields()),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands + "hair:noise{ amplitude = 0.003, seed = 7 }"};
}

Function trim_method() {
    const StrandTrimOptions d;
    return {
        .name = "trim",
        .body = trim_strands,
        .summary = "Cuts strands off at the tip, by the first of the options that applies.",
        .options = {meters("length", "Longest length that is left.").above(0).optional("no limit"),
                    number("factor", "Part of its length that each strand keeps.")
                        .defaults(d.factor)
                        .between(0, 1),
                    number("variation", "Each strand keeps up to this fraction less, at random.")
                        .defaults(d.variation)
                        .between(0, 1),
                    options("plane",
                            {vector("point", "A point of the plane."),
                             vector("normal", "Points to the side that is cut off.")},
                            "The part beyond a plane is cut off.")
                        .optional(),
                    meters("jitter", "Each strand meets the plane moved by at most this.")
                        .defaults(d.jitter)
                        .at_least(0),
                    meters("least", "No strand becomes shorter.").defaults(d.least).above(0),
                    seed_field()},
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands + "assert(hair:trim{ length = 0.15 }:stats().max_length < 0.1501)"};
}

}  // namespace

std::vector<Function> strand_operator_methods() {
    const TaperOptions taper_defaults;
    const StrandSmoothOptions smooth_defaults;
    return {
        clump_method(),
        noise_method(),
        {.name = "taper",
         .body = taper_strands,
         .summary = "Makes strands thinner towards their tips.",
         .options = {number("tip", "Width of the tip as a fraction of its former width.")
                         .defaults(taper_defaults.tip)
                         .above(0),
                     number("start", "Start of the taper: 0 is the root, 1 the tip.")
                         .defaults(taper_defaults.start)
                         .between(0, 0.999),
                     shape_field(taper_defaults.shape, "1 is a cone, 2 stays wide for longer.")},
         .results = kSelfStrands,
         .errors = {ErrorCode::invalid_argument},
         .example = kTwoStrands + "hair:taper{ tip = 0.3 }"},
        trim_method(),
        {.name = "smooth",
         .body = smooth_strands,
         .summary = "Evens out kinks along each strand; roots and tips stay.",
         .options = with_fields({integer("iterations", "Number of passes.")
                                     .defaults(smooth_defaults.iterations)
                                     .at_least(0),
                                 number("strength",
                                        "Fraction of the way to the middle of its neighbours that "
                                        "a point moves in a pass.")
                                     .defaults(smooth_defaults.strength)
                                     .between(0, 1)
                                     .above(0)},
                                part_fields()),
         .results = kSelfStrands,
         .errors = kOperatorErrors,
         .example = kTwoStrands + "hair:smooth{ iterations = 5 }"}};
}

}  // namespace lissom::lua
