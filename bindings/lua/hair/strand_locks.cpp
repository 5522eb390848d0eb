// lissom.Strands: guides, and operators of locks and curls.
#include "bindings/lua/hair/strand_effect.h"
#include "kernel/hair/operators/strand_curl.h"
#include "kernel/hair/operators/strand_frizz.h"
#include "kernel/hair/operators/strand_gather.h"
#include "kernel/hair/strands/strand_guides.h"

namespace lissom::lua {
namespace {

// Reads the shared options of an operator and runs `work(strands, options)`.
template <typename Options, typename Work>
int run_lock_operator(Call& call, const Options& (*defaults)(), const Work& work) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        Options options = defaults();
        read_effect(call, asked, options);
        options.guides = call.has("guides") ? call.integer("guides") : 0;
        work(strands, options);
    });
}

template <typename Options>
const Options& usual() {
    static const Options options;
    return options;
}

const CurlOptions& usual_wave() {
    static const CurlOptions options = wave_options();
    return options;
}

int assign_strand_guides(Call& call) {
    return change_strands(call, [&](Strands& strands) {
        GuideOptions options;
        options.count = call.integer("count");
        options.apart = call.number("apart");
        options.radius = call.number("radius");
        options.within_groups = call.boolean("within_groups");
        assign_guides(strands, options, call.context());
    });
}

int gather_strands(Call& call) {
    return run_lock_operator<GatherOptions>(call, usual<GatherOptions>,
                                            [&](Strands& strands, GatherOptions& options) {
                                                options.ramp = call.number("ramp");
                                                options.spread = call.number("spread");
                                                gather(strands, options, call.context());
                                            });
}

int twist_strands(Call& call) {
    return run_lock_operator<TwistOptions>(call, usual<TwistOptions>,
                                           [&](Strands& strands, TwistOptions& options) {
                                               options.wavelength = call.number("wavelength");
                                               options.ramp = call.number("ramp");
                                               twist(strands, options, call.context());
                                           });
}

int pinch_strands(Call& call) {
    return run_lock_operator<PinchOptions>(call, usual<PinchOptions>,
                                           [&](Strands& strands, PinchOptions& options) {
                                               options.place = call.number("place");
                                               options.width = call.number("width");
                                               pinch(strands, options, call.context());
                                           });
}

void read_begin(const Call& call, std::span<const float> asked, std::vector<float>& begin) {
    if (!call.has("begin")) return;
    begin.assign(asked.begin(), asked.end());
    if (call.kind("begin") == Kind::function) return;
    for (const double turns : call.numbers("begin")) begin.push_back(static_cast<float>(turns));
}

int wind_strands(Call& call, const CurlOptions& (*defaults)()) {
    const std::span<const float> begin = ask_roots(call, "begin");
    return run_lock_operator<CurlOptions>(
        call, defaults, [&](Strands& strands, CurlOptions& options) {
            options.radius = call.number("radius");
            options.wavelength = call.number("wavelength");
            options.tip = call.number("tip");
            options.start = call.number("start");
            options.ramp = call.number("ramp");
            options.hang = call.number("hang");
            options.variation = call.number("variation");
            options.phase = call.number("phase");
            options.depth = call.number("depth");
            options.together = call.boolean("together");
            options.hand = call.choice<CurlHand>("hand");
            read_begin(call, begin, options.begin);
            options.points_per_turn = call.integer("points_per_turn");
            curl(strands, options, call.context());
        });
}

int curl_strands(Call& call) {
    return wind_strands(call, usual<CurlOptions>);
}
int wave_strands(Call& call) {
    return wind_strands(call, usual_wave);
}

int frizz_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    return change_strands(call, [&](Strands& strands) {
        FrizzOptions options;
        read_effect(call, asked, options);
        options.amplitude = call.number("amplitude");
        options.wavelength = call.number("wavelength");
        options.flyaways = call.number("flyaways");
        options.flyaway = call.number("flyaway");
        frizz(strands, options, call.context());
    });
}

// ---- Descriptions

Parameter guides_field() {
    return integer("guides",
                   "Assigns so many guides, which stay with the strands: those of the "
                   "lowest ids.")
        .at_least(1)
        .optional("the guides that strands have, else 400");
}

std::vector<Parameter> lock_fields(const StrandOperatorOptions& d, std::vector<Parameter> own) {
    own.push_back(guides_field());
    return with_fields(std::move(own), effect_fields(d));
}

std::vector<Parameter> winding_fields(const CurlOptions& d) {
    static constexpr const char* kHands[] = {"random", "left", "right", "mirrored"};
    return lock_fields(
        d,
        {meters("radius", "From the course of the strand to the curl.")
             .defaults(d.radius)
             .at_least(0),
         meters("wavelength", "Length along the course of one turn.")
             .defaults(d.wavelength)
             .above(0),
         number("tip", "Radius at the tip as a part of `radius`.").defaults(d.tip).at_least(0),
         meters("start", "Distance from the root at which it begins.")
             .defaults(d.start)
             .at_least(0),
         meters("ramp", "Length over which it reaches its radius.").defaults(d.ramp).at_least(0),
         number("hang", "Turns are longer at the root and shorter at the tip by this part.")
             .defaults(d.hang)
             .between(0, 1.5),
         number("variation", "Radius and wavelength of a guide are up to this part more or less.")
             .defaults(d.variation)
             .between(0, 0.99),
         number("phase",
                "Part of a turn by which strands of a guide differ: .06 is a wire, .2 a "
                "ribbon, .5 a coil, 1 fuzz.")
             .defaults(d.phase)
             .between(0, 1),
         number("depth", "1 is a helix, 0 a wave in a surface.").defaults(d.depth).between(0, 1),
         boolean("together", "Neighbouring guides begin their turns alike.").defaults(d.together),
         either("begin",
                {numbers("begin", "One number for each strand."),
                 function("begin", "fun(strand: integer, x: number, y: number, z: number): number",
                          "Asked with the root of each strand.")},
                "Turns that strands have at their roots: if they grow with the way from a line, "
                "crests run along it, as in finger waves.")
             .optional("those of the guide"),
         choice(
             "hand", {"random", "left", "right", "mirrored"},
             "Sense of the turns: mirrored is right for roots with x above 0, and left for others.")
             .defaults(kHands[static_cast<int>(d.hand)]),
         integer("points_per_turn", "Strands with fewer points get more; 0 keeps them.")
             .defaults(d.points_per_turn)
             .between(0, 64)});
}

Function guides_method() {
    const GuideOptions d;
    return {.name = "guides",
            .body = assign_strand_guides,
            .summary =
                "Lets each strand follow the nearest of some guides from now on; operators, "
                "copies and files keep them, and strands:root tells them.",
            .options = {integer("count", "Number of guides: the strands of the lowest ids.")
                            .defaults(d.count)
                            .at_least(1),
                        number("apart",
                               "Weight of it in the choice of a guide that strands are "
                               "combed apart, as at a parting.")
                            .defaults(d.apart)
                            .at_least(0),
                        meters("radius", "Strands rooted further from a guide follow none.")
                            .defaults(d.radius)
                            .above(0)
                            .or_infinite(),
                        boolean("within_groups", "Guides are of the strand's own group.")
                            .defaults(d.within_groups)},
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands +
                       "hair:guides{ count = 1 }\nassert(hair:root(2).guide == hair:root(1).id)"};
}

Function gather_method() {
    const GatherOptions d;
    return {.name = "gather",
            .body = gather_strands,
            .summary =
                "Gathers strands to locks around their guides, from the end of a ramp on; "
                "roots stay.",
            .options = lock_fields(
                d, {meters("ramp", "Length over which strands come to their guide.")
                        .defaults(d.ramp)
                        .at_least(0),
                    meters("spread", "Random distance of strands from their guide, about.")
                        .defaults(d.spread)
                        .at_least(0)}),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:gather{ guides = 1, spread = 0.0005 }"};
}

Function twist_method() {
    const TwistOptions d;
    return {
        .name = "twist",
        .body = twist_strands,
        .summary = "Turns strands about their guide, as hair twisted to a rope; guides stay.",
        .options = lock_fields(
            d,
            {meters("wavelength", "Length of one turn; negative turns the other way.")
                 .defaults(d.wavelength),
             meters("ramp", "Length over which the turning begins.").defaults(d.ramp).at_least(0)}),
        .results = kSelfStrands,
        .errors = kOperatorErrors,
        .example = kTwoStrands + "hair:twist{ guides = 1, wavelength = 0.1 }"};
}

Function pinch_method() {
    const PinchOptions d;
    return {.name = "pinch",
            .body = pinch_strands,
            .summary = "Pulls strands to their guide at one place along them, as a tie does.",
            .options = lock_fields(
                d, {number("place", "0 at the root, 1 at the tip.").defaults(d.place).between(0, 1),
                    number("width", "Part of the length over which the pull falls off.")
                        .defaults(d.width)
                        .above(0)}),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:pinch{ guides = 1, place = 0.7 }"};
}

Function frizz_method() {
    const FrizzOptions d;
    return {.name = "frizz",
            .body = frizz_strands,
            .summary = "Lets single hairs leave their lock, each on its own.",
            .options = with_fields(
                {meters("amplitude", "Distance, about, that tips move.")
                     .defaults(d.amplitude)
                     .at_least(0),
                 meters("wavelength", "Length along the strand of one bend.")
                     .defaults(d.wavelength)
                     .above(0),
                 number("flyaways", "Part of the strands that move more.")
                     .defaults(d.flyaways)
                     .between(0, 1),
                 number("flyaway", "Factor of their moves.").defaults(d.flyaway).at_least(0)},
                effect_fields(d)),
            .results = kSelfStrands,
            .errors = kOperatorErrors,
            .example = kTwoStrands + "hair:frizz{ amplitude = 0.002, seed = 3 }"};
}

}  // namespace

std::vector<Function> strand_lock_methods() {
    return {guides_method(),
            gather_method(),
            twist_method(),
            pinch_method(),
            {.name = "curl",
             .body = curl_strands,
             .summary = "Winds strands around their course, those of a guide together; with "
                        "keep_length hair becomes shorter on the head.",
             .options = winding_fields(CurlOptions()),
             .results = kSelfStrands,
             .errors = kOperatorErrors,
             .example = kTwoStrands + "hair:curl{ guides = 1, radius = 0.004, wavelength = 0.02 }"},
            {.name = "wave",
             .body = wave_strands,
             .summary = "Curls with the defaults of waves: wide, flat, and alike for neighbours.",
             .options = winding_fields(wave_options()),
             .results = kSelfStrands,
             .errors = kOperatorErrors,
             .example = kTwoStrands + "hair:wave{ guides = 1, radius = 0.006 }"},
            frizz_method()};
}

}  // namespace lissom::lua
