// lissom.Scalp: the hairy part of a head, and its frame.
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/hair/hair_object.h"
#include "kernel/hair/scalp/hairline_shape.h"

namespace lissom::lua {
namespace {

const Scalp& scalp_of(const Call& call) {
    return *call.self<ScalpObject>()->scalp;
}

constexpr const char* kHairlineWords[] = {"forehead",  "recession", "peak",
                                          "sideburns", "nape",      "irregular"};

std::vector<HairlinePoint> listed_hairline(const Call& call) {
    if (!call.has("hairline")) return default_hairline();
    std::vector<HairlinePoint> points;
    for (const auto& place : call.pixels("hairline")) {
        points.push_back({place[0] * kDegree, place[1] * kDegree});
    }
    return points;
}

// `options` are those of the head without a hairline of its own.
std::vector<HairlinePoint> drawn_on(const Call& call, std::vector<HairlinePoint> hairline,
                                    const Mesh& head, const ScalpOptions& options) {
    if (!call.has("drawn")) return hairline;
    ScalpOptions plain = options;
    plain.region = Region::all(head.shared_topology());
    const Scalp frame(head, plain);
    std::vector<Vec3> line;
    for (const Vec3& point : call.points("drawn")) line.push_back(frame.to_metres(point));
    return drawn_hairline(hairline, line);
}

std::vector<HairlinePoint> hairline_of(const Call& call, const Mesh& head,
                                       const ScalpOptions& options) {
    const HairlineShape shape{call.number("forehead"), call.number("recession"),
                              call.number("peak"),     call.number("sideburns"),
                              call.number("nape"),     call.number("irregular")};
    return shaped_hairline(drawn_on(call, listed_hairline(call), head, options), shape);
}

void require_one_outline(const Call& call) {
    bool shaped = call.has("hairline") || call.has("drawn");
    for (const char* word : kHairlineWords) shaped = shaped || call.number(word) != 0.0;
    if (shaped && call.has("region")) {
        call.reject("region", "a region is the hairy part as it is: give it, or a hairline");
    }
}

int make_scalp(Call& call) {
    const auto head = call.object<MeshObject>("head");
    require_one_outline(call);
    const auto result = call.create<ScalpObject>();
    const bool done = call.attempt([&] {
        ScalpOptions options;
        if (call.has("region")) options.region = call.object<RegionObject>("region")->current();
        if (call.has("up")) options.hints.up = call.vector("up");
        if (call.has("front")) options.hints.front = call.vector("front");
        if (call.has("unit")) options.unit = call.number("unit");
        options.softness = call.number("softness");
        options.hairline = hairline_of(call, head->mesh, options);
        auto scalp = std::make_shared<const Scalp>(head->mesh, options, call.context());
        result.set(std::make_shared<ScalpObject>(head.share(), std::move(scalp)));
    });
    return done ? 1 : call.fail();
}

int scalp_at(Call& call) {
    return push_point_at(call, scalp_of(call));
}
int scalp_normal_at(Call& call) {
    return push_normal_at(call, scalp_of(call));
}

int scalp_region(Call& call) {
    const auto scalp = call.self<ScalpObject>();
    const auto result = call.create<RegionObject>();
    const bool done = call.attempt_quick(
        [&] { result.set(std::make_shared<RegionObject>(scalp->head, scalp->scalp->region())); });
    return done ? 1 : call.fail();
}

int scalp_head(Call& call) {
    return push_owner(call, call.self<ScalpObject>()->head);
}

int scalp_center(Call& call) {
    return call.push_vector(scalp_of(call).frame().center);
}
int scalp_up(Call& call) {
    return call.push_vector(scalp_of(call).frame().up());
}
int scalp_front(Call& call) {
    return call.push_vector(scalp_of(call).frame().front());
}
int scalp_left(Call& call) {
    return call.push_vector(scalp_of(call).frame().left());
}
int scalp_unit(Call& call) {
    return call.push(scalp_of(call).unit());
}
int scalp_knows_unit(Call& call) {
    return call.push(scalp_of(call).knows_unit());
}
int scalp_confidence(Call& call) {
    return call.push(scalp_of(call).confidence());
}
int scalp_doubt(Call& call) {
    return call.push(scalp_of(call).frame().doubt);
}
int scalp_scale(Call& call) {
    return call.push(scalp_of(call).scale());
}
int scalp_guessed(Call& call) {
    return call.push(scalp_of(call).guessed());
}

int scalp_from_metres(Call& call) {
    return call.push_vector(scalp_of(call).from_metres(call.vector("point")));
}
int scalp_to_metres(Call& call) {
    return call.push_vector(scalp_of(call).to_metres(call.vector("point")));
}

int scalp_text(Call& call) {
    const auto scalp = call.self<ScalpObject>();
    lua_pushfstring(call.lua(), "lissom.Scalp: %d vertices, %s", scalp->scalp->region().size(),
                    scalp->scalp->guessed() ? "guessed" : "given");
    return 1;
}

const std::string kScalp = R"(local head = lissom.shapes.head{ vertices = 3000 }
local scalp = lissom.scalp(head)
)";

std::vector<Function> scalp_methods() {
    const std::vector<Result> direction = {{"number[]", "direction", "{x, y, z}, of length 1."}};
    return {
        point_at_method(scalp_at, kScalp + "local p = scalp:at{ azimuth = 90, elevation = 30 }"),
        normal_at_method(scalp_normal_at,
                         kScalp + "local n = scalp:normal_at{ azimuth = 90, elevation = 30 }"),
        {.name = "region",
         .body = scalp_region,
         .summary = "The hairy region.",
         .results = {{"lissom.Region", "region", "Vertices of the head."}},
         .example = kScalp + "assert(#scalp:region() > 0)"},
        {.name = "head",
         .body = scalp_head,
         .summary = "The mesh of the head.",
         .results = {{"lissom.Mesh", "head", "The mesh."}},
         .errors = {ErrorCode::topology_mismatch},
         .example = kScalp + "assert(scalp:head() == head)"},
        {.name = "guessed",
         .body = scalp_guessed,
         .summary = "Whether the region was guessed from an average hairline.",
         .results = {{"boolean", "guessed", "False if a region was given or named."}},
         .example = kScalp + "assert(not scalp:guessed())"},
        {.name = "confidence",
         .body = scalp_confidence,
         .summary = "Certainty of the head's place and direction of view. Making a scalp whose "
                    "confidence is below 0.5 gives a warning: look at `up` and `front`, or give "
                    "them, and the region.",
         .results = {{"number", "confidence",
                      "Near 1 for a whole bald head, near 0 for masks, halves of heads, heads with "
                      "modelled hair, and other shapes."}},
         .example = kScalp + "assert(scalp:confidence() > 0.5)"},
        {.name = "doubt",
         .body = scalp_doubt,
         .summary = "Reason for a low confidence.",
         .results = {{"string", "doubt", "Empty if there is none."}},
         .example = kScalp + "print(scalp:doubt())"},
        {.name = "center",
         .body = scalp_center,
         .summary = "The center of the frame, about the middle between the ears.",
         .results = {{"number[]", "center", "{x, y, z}, in mesh units."}},
         .example = kScalp + "assert(#scalp:center() == 3)"},
        {.name = "up",
         .body = scalp_up,
         .summary = "Direction upwards.",
         .results = direction,
         .example = kScalp + "assert(scalp:up()[2] > 0.99)"},
        {.name = "front",
         .body = scalp_front,
         .summary = "Direction that the head looks in.",
         .results = direction,
         .example = kScalp + "assert(scalp:front()[3] > 0.99)"},
        {.name = "left",
         .body = scalp_left,
         .summary = "The head's left.",
         .results = direction,
         .example = kScalp + "assert(scalp:left()[1] > 0.99)"},
        {.name = "unit",
         .body = scalp_unit,
         .summary = "Length of a unit of the mesh.",
         .results = {{"number", "unit", "Metres in one unit of the mesh."}},
         .example = kScalp + "assert(scalp:unit() == 1)"},
        {.name = "knows_unit",
         .body = scalp_knows_unit,
         .summary = "Whether the unit was given, or a usual one makes this the width of a head. "
                    "Otherwise `unit` is that of an average head, and making the scalp gives a "
                    "warning.",
         .results = {{"boolean", "known", "False for models of some other size."}},
         .example = kScalp + "assert(scalp:knows_unit())"},
        {.name = "scale",
         .body = scalp_scale,
         .summary = "Size of the head: styles are made in metres of an average head.",
         .results = {{"number", "scale", "Mesh units in one metre of a style."}},
         .example = kScalp + "assert(scalp:scale() > 0.9 and scalp:scale() < 1.1)"},
        {.name = "from_metres",
         .body = scalp_from_metres,
         .summary = "A point given in metres of an average head: x to the head's left, y up, z to "
                    "the front of the center.",
         .arguments = {vector("point", "Three numbers or {x, y, z}.").in("metres")},
         .results = {{"number[]", "point", "{x, y, z}, in mesh units."}},
         .example = kScalp + "local behind = scalp:from_metres(0, 0.02, -0.15)"},
        {.name = "to_metres",
         .body = scalp_to_metres,
         .summary = "A point of the mesh in metres of an average head, from the center.",
         .arguments = {vector("point", "Three numbers or {x, y, z}.").in("mesh units")},
         .results = {{"number[]", "point", "{x, y, z}, in metres."}},
         .example = kScalp + "assert(scalp:to_metres(scalp:center())[1] == 0)"}};
}

}  // namespace

std::vector<Parameter> direction_fields() {
    return {number("azimuth", "0 in front, 90 at the head's left, 180 behind.").in("degrees"),
            number("elevation", "0 is level, 90 up.").in("degrees"),
            number("lift", "Height above the head.").in("metres").defaults(0.0)};
}

Function point_at_method(Body body, const std::string& example) {
    return {.name = "at",
            .body = body,
            .summary =
                "Returns a point over the head, in a direction from the center of its "
                "frame.",
            .options = direction_fields(),
            .results = {{"number[]", "point", "{x, y, z}, in mesh units."}},
            .errors = {ErrorCode::out_of_range, ErrorCode::handle_removed},
            .example = example};
}

Function normal_at_method(Body body, const std::string& example) {
    return {.name = "normal_at",
            .body = body,
            .summary = "Returns the normal of the head below the point that `at` returns.",
            .options = direction_fields(),
            .results = {{"number[]", "normal", "{x, y, z}, outward, of length 1."}},
            .errors = {ErrorCode::out_of_range, ErrorCode::handle_removed},
            .example = example};
}

namespace {

// Finds the point of the call's direction; null if there is none.
const ScalpPoint* point_at(Call& call, const Scalp& scalp) {
    const ScalpDirection direction{call.number("azimuth") * kDegree,
                                   call.number("elevation") * kDegree};
    ScalpPoint* found = call.scratch<ScalpPoint>(1);
    const bool done =
        call.attempt_quick([&] { *found = scalp.at(direction, call.number("lift")); });
    return done ? found : nullptr;
}

}  // namespace

int push_point_at(Call& call, const Scalp& scalp) {
    const ScalpPoint* found = point_at(call, scalp);
    return found ? call.push_vector(found->position) : call.fail();
}

int push_normal_at(Call& call, const Scalp& scalp) {
    const ScalpPoint* found = point_at(call, scalp);
    return found ? call.push_vector(found->normal) : call.fail();
}

Type scalp_type() {
    return {.name = "lissom.Scalp",
            .summary =
                "The hairy part of a head, and the frame in which styles fit any head. It is "
                "that of the head's shape when it was made.",
            .methods = scalp_methods(),
            .operators = {{"__tostring", scalp_text, "tostring(scalp)", "its size"}}};
}

namespace {

Parameter hairline_change(const char* name, const char* help) {
    return number(name, help)
        .in("metres")
        .defaults(0.0)
        .between(-kMaxHairlineChange, kMaxHairlineChange);
}

}  // namespace

std::vector<Function> scalp_functions() {
    return {
        {.name = "scalp",
         .body = make_scalp,
         .summary = "Finds the scalp of a bald head, bust or body, and which way it looks.",
         .arguments = {object("head", "lissom.Mesh", "The head.")},
         .options = {object("region", "lissom.Region", "The hairy part.")
                         .optional("the region \"scalp\", or the part above an average hairline"),
                     axis("up", "Direction upwards.").optional("guessed"),
                     axis("front", "Direction that the head looks in.").optional("guessed"),
                     number("unit", "Length of a unit of the mesh.")
                         .above(0)
                         .in("metres")
                         .optional("m, cm, mm, dm or inch, if one makes this the width of a head; "
                                   "else that of an average head"),
                     number("softness",
                            "Width of the band over which hair thins out at the "
                            "hairline.")
                         .in("metres")
                         .defaults(ScalpOptions{}.softness)
                         .between(0, 0.1),
                     pixels(
                         "hairline",
                         "The edge of the hair: {azimuth, elevation} in degrees around the head, "
                         "smooth between. Without negative azimuths both sides are alike. This "
                         "and the following count before a region \"scalp\" of the mesh.")
                         .optional("an average hairline"),
                     points("drawn",
                            "A line on the head through which the hairline runs; on one side it "
                            "counts for both.")
                         .in("mesh units")
                         .optional(),
                     hairline_change("forehead", "Rise of the hairline over the forehead."),
                     hairline_change("recession", "Depth of the bays beside the middle."),
                     hairline_change("peak", "Depth of a widow's peak."),
                     hairline_change("sideburns", "Length added to the hair in front of the ears."),
                     hairline_change("nape", "Length added to the hair at the nape."),
                     number("irregular",
                            "Height by which the hairline wanders up and down around the head: "
                            "hair grows up to no ruled line.")
                         .in("metres")
                         .defaults(0)
                         .between(0, kMaxHairlineChange)},
         .results = {{"lissom.Scalp", "scalp", "The scalp."}},
         .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::region_empty, ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = kScalp + "print(scalp:region())"}};
}

}  // namespace lissom::lua
