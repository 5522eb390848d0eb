// lissom.Strands: braids and buns.
#include "bindings/lua/hair/strand_effect.h"
#include "kernel/hair/operators/strand_braid.h"
#include "kernel/hair/operators/strand_feed.h"

namespace lissom::lua {
namespace {

// Points of a head, in the unit of its mesh, become metres of its strands.
double metres_of(const Call& call) {
    return call.has("scalp") ? call.object<ScalpObject>("scalp")->scalp->unit() : 1.0;
}

int push_report(Call& call, bool done, const BraidReport& report) {
    if (!done) return call.fail();
    call.charge(call.self<StrandsObject>());
    call.push_argument();
    call.push(report.braided);
    return 2;
}

void read_mask(const Call& call, std::span<const float> asked, StrandOperatorOptions& options) {
    read_part(call, asked, options);
    options.seed = static_cast<std::uint64_t>(call.integer("seed"));
}

// With a scalp: throws if much of a spine, in metres, is in the head.
void require_outside(const Call& call, const std::vector<Vec3>& spine) {
    constexpr double kDeep = 0.005, kMuch = 1.0 / 3.0;
    if (!call.has("scalp")) return;
    const auto object = call.object<ScalpObject>("scalp");
    const Scalp& scalp = *object->scalp;
    double inside = 0.0;
    for (const Vec3& p : spine) {
        const Vec3 place = p / scalp.unit();
        const SurfacePoint foot = scalp.tree().nearest(place);
        const Vec3 out = scalp.normal_at(foot.triangle, foot.barycentric);
        const bool is_inside = (place - foot.position).dot(out) < 0.0;
        if (is_inside && foot.distance * scalp.unit() > kDeep) inside += 1.0;
    }
    if (inside <= kMuch * double(spine.size())) return;
    throw Error(ErrorCode::invalid_argument,
                std::to_string(static_cast<int>(inside)) + " of " + std::to_string(spine.size()) +
                    " points of the spine lie more than 5 mm inside the head; lift them, as "
                    "scalp:at{ lift = } does");
}

// The course of a braid, and what all braids have.
template <typename Options>
Options read_course(Call& call, std::span<const float> asked) {
    Options options;
    read_mask(call, asked, options);
    for (const Vec3& p : call.points("spine")) options.spine.push_back(metres_of(call) * p);
    require_outside(call, options.spine);
    options.across = call.vector("across");
    options.radius = call.number("radius");
    if (call.has("wavelength")) options.wavelength = call.number("wavelength");
    options.blend = call.number("blend");
    options.loose = call.number("loose");
    options.step = call.number("step");
    return options;
}

int braid_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    BraidReport report;
    const bool done = call.attempt([&] {
        auto options = read_course<BraidOptions>(call, asked);
        if (call.has("reach")) options.reach = call.number("reach");
        options.length = call.number("length");
        options.tuft = call.number("tuft");
        options.taper = call.number("taper");
        options.early = call.number("early");
        report = braid(call.self<StrandsObject>()->strands, options, call.context());
    });
    return push_report(call, done, report);
}

int bun_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    BraidReport report;
    const bool done = call.attempt([&] {
        BunOptions options;
        read_mask(call, asked, options);
        options.tie.center = metres_of(call) * call.vector("center");
        options.tie.direction = call.vector("direction");
        options.tie.reach = call.number("reach");
        options.radius = call.number("radius");
        options.tube = call.number("tube");
        options.lift = call.number("lift");
        options.turn = call.number("turn") * kDegree;
        options.locks = call.integer("locks");
        options.loose = call.number("loose");
        options.points = call.integer("points");
        report = bun(call.self<StrandsObject>()->strands, options, call.context());
    });
    return push_report(call, done, report);
}

int feed_strands(Call& call) {
    const std::span<const float> asked = ask_mask(call);
    BraidReport report;
    const bool done = call.attempt([&] {
        auto options = read_course<FeedBraidOptions>(call, asked);
        if (call.has("wide")) options.wide = call.number("wide");
        if (call.has("high")) options.high = call.number("high");
        options.reach = call.number("reach");
        options.joined = call.number("joined");
        options.min_run = call.number("min_run");
        options.max_run = call.number("max_run");
        options.tail = call.number("tail");
        options.begin = call.number("begin_size");
        options.end = call.number("end_size");
        options.drop_others = call.boolean("drop_others");
        report = feed_braid(call.self<StrandsObject>()->strands, options, call.context());
    });
    return push_report(call, done, report);
}

const std::vector<Result> kBraidResults = {
    {"lissom.Strands", "strands", "The strands themselves."},
    {"integer", "count", "Number of strands that pass the tie."}};

// A sheaf of five strands through a tie at the height 0.1.
const std::string kSheaf = R"(local points, counts = {}, {}
for s = 1, 5 do
    for k = 0, 4 do points[#points + 1] = { 0.004 * s - 0.012, 0.05 * k, 0.002 * (s % 2) } end
    counts[s] = 5
end
local hair = lissom.strands{ points = points, counts = counts }
)";

std::vector<Parameter> braid_fields() {
    return with_fields({object("scalp", "lissom.Scalp",
                               "Points are in the unit of its head, as scalp:at gives them.")
                            .optional("points are in metres of the strands"),
                        integer("seed", "Another seed gives another braid.").defaults(1)},
                       part_fields());
}

Function feed_braid_method() {
    const FeedBraidOptions d;
    return {
        .name = "feed_braid",
        .body = feed_strands,
        .summary = "Braids strands that join along a spine, as in crown braids and cornrows.",
        .options = with_fields(
            {points("spine", "The middle of the braid."),
             vector("across", "Direction across the braid at its beginning: its widest."),
             meters("radius", "Radius of each of the three tubes.").defaults(d.radius).above(0),
             meters("wide", "From the spine to the middle of a tube, across.")
                 .above(0)
                 .optional("1.25 radii"),
             meters("high", "The same towards the viewer.").above(0).optional("0.8 radii"),
             meters("wavelength", "Length of one turn of a tube.").above(0).optional("7 radii"),
             meters("reach",
                    "A strand joins where it first comes so near to the spine, else at its nearest "
                    "point within 2.5 times of it.")
                 .defaults(d.reach)
                 .above(0),
             number("joined",
                    "Part of the spine within which strands join; below 1 a ring closes that ends "
                    "on its beginning.")
                 .defaults(d.joined)
                 .between(0.001, 1),
             meters("blend", "Over which hair comes into its tube.").defaults(d.blend).above(0),
             meters("min_run", "Least length that a strand runs in the braid.")
                 .defaults(d.min_run)
                 .above(0),
             meters("max_run", "Greatest one.").defaults(d.max_run).above(0),
             number("tail", "Part of the strands that run to the end.")
                 .defaults(d.tail)
                 .between(0, 1),
             number("begin_size", "Size at the beginning as a part of that further on.")
                 .defaults(d.begin)
                 .above(0),
             number("end_size", "The same at the end.").defaults(d.end).above(0),
             number("loose", "Part of the strands that lie loosely.")
                 .defaults(d.loose)
                 .between(0, 1),
             meters("step", "Between points.").defaults(d.step).above(0),
             boolean("drop_others", "Removes strands of the mask that come nowhere near the spine.")
                 .defaults(d.drop_others)},
            braid_fields()),
        .results = {{"lissom.Strands", "strands", "The strands themselves."},
                    {"integer", "count", "Number of strands that joined."}},
        .errors = kOperatorErrors,
        .example = kSheaf +
                   "local _, count = hair:feed_braid{ spine = { { -0.1, 0.1, 0 }, { 0.2, 0.1, 0 } "
                   "},\n    across = { 0, 1, 0 } }\nassert(count == 5)"};
}

}  // namespace

std::vector<Function> strand_braid_methods() {
    const BraidOptions d;
    const BunOptions b;
    return {
        feed_braid_method(),
        {.name = "braid",
         .body = braid_strands,
         .summary = "Braids the strands that pass a tie at the beginning of a spine; others stay.",
         .options = with_fields(
             {points("spine", "The middle of the braid, from its tie on."),
              vector("across", "Direction across the braid: its widest."),
              meters("radius", "Radius of each of the three tubes.").defaults(d.radius).above(0),
              meters("reach", "Distance from the spine within which strands pass the tie.")
                  .above(0)
                  .optional("2.86 radii"),
              meters("length", "From the tie to the lower tie.").defaults(d.length).above(0),
              meters("tuft", "Below the lower tie.").defaults(d.tuft).at_least(0),
              meters("wavelength", "Length of one turn of a tube.").above(0).optional("7 radii"),
              number("taper", "Part by which it is narrower at its end.")
                  .defaults(d.taper)
                  .between(0, 0.99),
              meters("blend", "Over which hair comes into its tube.").defaults(d.blend).above(0),
              number("loose", "Part of the strands that lie loosely.")
                  .defaults(d.loose)
                  .between(0, 1),
              number("early", "Part of the strands that end early.")
                  .defaults(d.early)
                  .between(0, 1),
              meters("step", "Between points.").defaults(d.step).above(0)},
             braid_fields()),
         .results = kBraidResults,
         .errors = kOperatorErrors,
         .example =
             kSheaf +
             "local _, count = hair:braid{ spine = { { 0, 0.1, 0 }, { 0, 0.5, 0 } }, across = {\n"
             "    1, 0, 0 }, length = 0.2 }\nassert(count == 5)"},
        {.name = "bun",
         .body = bun_strands,
         .summary = "Winds the strands that pass a tie over a torus around it; others stay.",
         .options = with_fields(
             {vector("center", "Center of the tie."),
              vector("direction", "Direction in which hair passes it."),
              meters("reach", "Distance from the center within which strands pass the tie.")
                  .defaults(b.tie.reach)
                  .above(0),
              meters("radius", "From the axis to the middle of the torus.")
                  .defaults(b.radius)
                  .above(0),
              meters("tube", "Radius of its tube.").defaults(b.tube).above(0),
              meters("lift", "Height of its middle above the tie.").defaults(b.lift),
              number("turn", "Turn of hair around the axis.").defaults(165.0).in("degrees"),
              integer("locks", "Number of its locks.").defaults(b.locks).at_least(1),
              number("loose", "Part of the strands that lie loosely.")
                  .defaults(b.loose)
                  .between(0, 1),
              integer("points", "Number of points of each strand in the bun.")
                  .defaults(b.points)
                  .between(4, 10000)},
             braid_fields()),
         .results = kBraidResults,
         .errors = kOperatorErrors,
         .example = kSheaf +
                    "local _, count = hair:bun{ center = { 0, 0.1, 0 }, direction = { 0, 1, 0 } }\n"
                    "assert(count == 5)"}};
}

}  // namespace lissom::lua
