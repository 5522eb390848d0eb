// lissom.HairDynamics: guides in motion, and their rig for engines.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/core/engine_library.h"
#include "bindings/lua/hair/engine/guide_set_object.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strand_effect.h"
#include "bindings/lua/hair/strands_methods.h"
#include "bindings/lua/mesh/transform_options.h"
#include "kernel/hair/dynamics/hair_dynamics.h"
#include "kernel/hair/strands/strand_resample.h"
#include "kernel/io/hair/rig_file.h"

namespace lissom::lua {
namespace {

constexpr double kEarthGravity = 9.81;
// Radius of a ball that holds the hair in a ponytail's tie, in those of the tie.
constexpr double kTieRoom = 1.5;

struct HairDynamicsObject {
    static constexpr const char* kTypeName = "lissom.HairDynamics";

    HairDynamicsObject(std::shared_ptr<GuideSetObject> guides, HairDynamics made)
        : set(std::move(guides)), content(std::move(made)) {}

    std::shared_ptr<GuideSetObject> set;
    HairDynamics content;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return content.memory_bytes(); }
};

// A tie as a script gives it, as plain data.
struct TieSpec {
    const char* name;
    Vec3 center;
    double radius;
};

std::span<const TieSpec> read_ties(Call& call) {
    if (!call.has("ties")) return {};
    const std::size_t count = raw_length(call.lua(), call.stack_index("ties"));
    auto* const ties = call.scratch<TieSpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("ties", index_of(i) + 1);
        ties[i] = {call.string("ties.name"), call.vector("ties.center"),
                   call.number("ties.radius")};
    }
    return {ties, count};
}

void read_motion(const Call& call, HairDynamicsOptions& options) {
    const auto set_number = [&](const char* name, double& value) {
        if (call.has(name)) value = call.number(name);
    };
    if (call.has("gravity")) options.gravity = call.vector("gravity");
    if (call.has("wind")) options.wind = call.vector("wind");
    set_number("gusts", options.gusts);
    set_number("stiffness", options.stiffness);
    set_number("hold", options.hold);
    set_number("drag", options.drag);
    set_number("cohesion", options.cohesion);
    set_number("friction", options.friction);
    set_number("clearance", options.clearance);
    if (call.has("substeps")) options.substeps = call.integer("substeps");
    if (call.has("seed")) options.seed = static_cast<std::uint64_t>(call.integer("seed"));
}

HairRigOptions read_rig(const Call& call, std::span<const TieSpec> ties) {
    HairRigOptions options;
    for (const TieSpec& tie : ties) options.ties.push_back({tie.name, tie.center, tie.radius});
    if (call.has("bound")) {
        for (const char* name : call.strings("bound")) options.bound.emplace_back(name);
    }
    options.reach = call.number("reach");
    options.links = call.integer("links");
    options.capsules.count = call.integer("capsules");
    return options;
}

// Ties of the style's ponytails that hold a point of a guide.
std::vector<RigTie> ties_of(const Hairstyle& style, const GuideSet& set) {
    std::vector<RigTie> ties;
    const Scalp& scalp = style.scalp();
    for (const CurveId id : style.curves()) {
        const StyleCurve& curve = style.curve(id);
        if (!curve.enabled || !std::holds_alternative<Ponytail>(curve.shape)) continue;
        const HairTie& tie = style.tie(id);
        const RigTie made{curve.name, scalp.unit() * scalp.from_metres(tie.center),
                          kTieRoom * tie.radius * scalp.scale() * scalp.unit()};
        const bool holds =
            std::any_of(set.curves.begin(), set.curves.end(), [&](const Eigen::Vector3f& p) {
                return (p.cast<double>() - made.center).norm() <= made.radius;
            });
        if (holds) ties.push_back(made);
    }
    return ties;
}

int make_dynamics(Call& call) {
    const std::span<const TieSpec> ties = read_ties(call);
    const auto result = call.create<HairDynamicsObject>();
    const bool done = call.attempt([&] {
        HairRigOptions rigged = read_rig(call, ties);
        HairDynamicsOptions options;
        if (call.has("head")) {
            const Hairstyle& style = call.object<HairstyleObject>("head")->style();
            rigged.body = distance_to_head(style);
            if (!call.has("ties")) rigged.ties = ties_of(style, call.self<GuideSetObject>()->set);
            options.gravity = -kEarthGravity * style.scalp().frame().axes.col(1);
        }
        read_motion(call, options);
        const auto set = call.self<GuideSetObject>();
        HairRig rig = make_hair_rig(set->set, rigged, call.context());
        HairDynamics made(std::move(rig), rigged.body, options, call.context());
        result.set(std::make_shared<HairDynamicsObject>(set.share(), std::move(made)));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// The place that the options of a step have for the head.
Affine head_of(const Call& call, const Affine& now) {
    if (call.has("head")) return call.affine("head");
    if (!call.has("translate") && !call.has("rotate")) return now;
    const Vec3 by = call.has("translate") ? call.vector("translate") : Vec3(Vec3::Zero());
    Affine turned;
    if (call.has("rotate")) {
        const Vec3 about =
            call.has("rotate.about") ? call.vector("rotate.about") : Vec3(Vec3::Zero());
        turned =
            rotation(call.vector("rotate.axis"), call.number("rotate.angle") * kPi / 180.0, about);
    }
    return translation(by) * turned;
}

int step_dynamics(Call& call) {
    const auto self = call.self<HairDynamicsObject>();
    const double seconds = call.number("seconds");
    const bool done = call.attempt(
        [&] { self->content.step(seconds, head_of(call, self->content.head()), call.context()); });
    return done ? call.push_argument() : call.fail();
}

int set_dynamics(Call& call) {
    const auto self = call.self<HairDynamicsObject>();
    const bool done = call.attempt_quick([&] {
        HairDynamicsOptions options = self->content.options();
        read_motion(call, options);
        self->content.set_options(options);
    });
    return done ? call.push_argument() : call.fail();
}

int reset_dynamics(Call& call) {
    call.self<HairDynamicsObject>()->content.reset();
    return call.push_argument();
}

int dynamics_guides(Call& call) {
    return new_strands(call, [&] {
        const auto self = call.self<HairDynamicsObject>();
        Strands made =
            even_strands(self->content.curves(), self->content.rig().points, call.context());
        made.set_ids(self->content.rig().ids);
        return made;
    });
}

// Strands of the set have its number, and the ids of its strands in their order.
void require_same_strands(const Strands& strands, const GuideSet& set) {
    require(strands.size() == count_of(set.guided),
            "'into' has " + std::to_string(strands.size()) + " strands; the set was made of " +
                std::to_string(set.guided.size()) + ": give those, or a copy of them");
    Elements others{ElementKind::strand, 0, {}};
    for (Index s = 0; s < strands.size(); ++s) {
        if (strands.id(s) != set.guided[at(s)].id) others.add(s);
    }
    if (others.count == 0) return;
    const std::string names = describe(others);
    throw Error(ErrorCode::invalid_argument,
                "'into' has other strands than the set was made of, by the ids of " + names +
                    "; give those, or a copy of them",
                std::move(others));
}

// Gives strands of the set new places, and leaves all else that they hold.
void move_strands(Strands& strands, const HairDynamicsObject& moving, bool details,
                  const Context& context) {
    const GuideSet& set = moving.set->set;
    require_same_strands(strands, set);
    const std::vector<Eigen::Vector3f> curves = moving.content.curves();
    const auto points = rebuild_strands(set, {curves, details}, context);
    const auto is_even = [&](Index s) {
        return strands.point_count(s) == set.points || strands.point_count(s) == 1;
    };
    bool all_even = true;
    for (Index s = 0; s < strands.size() && all_even; ++s) all_even = is_even(s);
    if (!all_even) strands = resample(strands, {.count = set.points}, context);
    // A strand of one point stays one.
    for (Index s = 0; s < strands.size(); ++s) {
        StrandEdit strand = strands.edit_strand(s);
        for (Index k = 0; k < index_of(strand.cols()); ++k) {
            strand.col(k) = points[at(s * set.points + k)];
        }
    }
}

int dynamics_strands(Call& call) {
    const auto self = call.self<HairDynamicsObject>();
    const bool details = call.boolean("details");
    if (!call.has("into")) {
        return new_strands(call, [&] {
            const std::vector<Eigen::Vector3f> curves = self->content.curves();
            return rebuilt_strands(self->set->set, {curves, details}, call.context());
        });
    }
    const auto into = call.object<StrandsObject>("into");
    const bool done =
        call.attempt([&] { move_strands(into->strands, *self, details, call.context()); });
    if (!done) return call.fail();
    call.charge(into);
    lua_pushvalue(call.lua(), call.stack_index("into"));
    return 1;
}

int dynamics_motion(Call& call) {
    HairMotion found;
    const auto self = call.self<HairDynamicsObject>();
    if (!call.attempt_quick([&] { found = self->content.motion(); })) return call.fail();
    lua_createtable(call.lua(), 0, 7);
    call.set_field("time", call.push(found.time));
    call.set_field("rms", call.push(found.rms));
    call.set_field("max", call.push(found.max));
    call.set_field("speed", call.push(found.speed));
    call.set_field("stretch", call.push(found.stretch));
    call.set_field("depth", call.push(found.depth));
    if (found.guide != kNoIndex) call.set_field("guide", call.push_id(found.guide));
    return 1;
}

void push_capsules(Call& call, const HairRig& rig) {
    lua_createtable(call.lua(), count_of(rig.capsules), 0);
    for (Index i = 0; i < count_of(rig.capsules); ++i) {
        const Capsule& capsule = rig.capsules[at(i)];
        lua_createtable(call.lua(), 0, 3);
        call.set_field("a", call.push_vector(capsule.a));
        call.set_field("b", call.push_vector(capsule.b));
        call.set_field("radius", call.push(capsule.radius));
        lua_rawseti(call.lua(), -2, i + 1);
    }
}

void push_ties(Call& call, const HairRig& rig) {
    lua_createtable(call.lua(), count_of(rig.ties), 0);
    for (Index i = 0; i < count_of(rig.ties); ++i) {
        const TiedPoints& tied = rig.ties[at(i)];
        lua_createtable(call.lua(), 0, 4);
        call.set_field("name", call.push(tied.tie.name));
        call.set_field("center", call.push_vector(tied.tie.center));
        call.set_field("radius", call.push(tied.tie.radius));
        call.set_field("points", call.push_ids(tied.points));
        lua_rawseti(call.lua(), -2, i + 1);
    }
}

int dynamics_rig(Call& call) {
    const HairRig& rig = call.self<HairDynamicsObject>()->content.rig();
    lua_createtable(call.lua(), 0, 7);
    call.set_field("guides", call.push(rig.guide_count()));
    call.set_field("points", call.push(rig.points));
    call.set_field("links", call.push(count_of(rig.links)));
    Index bound = 0;
    for (const HairLink& link : rig.links) bound += link.bound ? 1 : 0;
    call.set_field("bound_links", call.push(bound));
    push_ties(call, rig);
    call.set_field("ties");
    push_capsules(call, rig);
    call.set_field("capsules");
    call.set_field("capsule_cover", call.push(rig.capsule_cover));
    return 1;
}

int save_dynamics(Call& call) {
    const char* path = call.string("path");
    const bool done = call.attempt([&] {
        save_rig(call.self<HairDynamicsObject>()->content.rig(), call.file(path, FileUse::write),
                 call.context());
    });
    return done ? call.push_argument() : call.fail();
}

int dynamics_text(Call& call) {
    char text[96];
    const HairDynamics& content = call.self<HairDynamicsObject>()->content;
    const int length = std::snprintf(text, sizeof text, "lissom.HairDynamics: %d guides, %g s",
                                     content.rig().guide_count(), content.motion().time);
    return call.push(std::string_view(text, at(length)));
}

// ---- Descriptions

// Options that a step reads. With `defaults` they are those of a new one, else all may be absent.
std::vector<Parameter> motion_fields(bool defaults) {
    const HairDynamicsOptions d;
    const auto own = [&](Parameter parameter, auto value) {
        return defaults ? parameter.defaults(value) : parameter.optional("as it is");
    };
    return {
        vector("gravity", "Gravity in the world.")
            .in("m/s^2")
            .optional(defaults ? "9.81 down, by the head, else along -y" : "as it is"),
        vector("wind", "Speed of the air in the world.")
            .in("m/s")
            .optional(defaults ? "{0, 0, 0}" : "as it is"),
        own(number("gusts", "Part of the wind that comes and goes.").between(0, 1), d.gusts),
        own(meters("stiffness",
                   "Length of a straight strand that droops by an eighth of it if its root is held "
                   "level. Hair as it is: 0.05; with gel: 0.2.")
                .between(0.001, 10),
            d.stiffness),
        own(number("hold",
                   "Part of the weight at rest that the style carries: with 1 it stays as it is "
                   "until head or wind move it.")
                .between(0, 1),
            d.hold),
        own(number("drag", "Rate at which hair takes the speed of the air.")
                .in("1/s")
                .between(0, 50),
            d.drag),
        own(number("cohesion", "Strength of links between guides that are not bound.")
                .between(0, 1),
            d.cohesion),
        own(number("friction", "Friction at the body.").between(0, 10), d.friction),
        own(meters("clearance", "Distance that hair stays off the body, if it did so at rest.")
                .between(0, 1),
            d.clearance),
        own(integer("substeps", "Steps in a thirtieth of a second.").between(16, 1000), d.substeps),
        own(integer("seed", "Seed of the gusts."), static_cast<int>(d.seed))};
}

std::vector<Parameter> rig_fields() {
    const HairRigOptions d;
    return {
        object("head", "lissom.Hairstyle",
               "A style on the head that they grew on: its body keeps the hair out.")
            .optional("no body"),
        option_list("ties",
                    {string("name", "Name, for messages and files.").defaults("tie"),
                     vector("center", "Its center, in metres of the strands."),
                     meters("radius", "Its radius.").defaults(RigTie().radius).above(0)},
                    "Balls that hold the hair in them to the head, as elastics and pins do.")
            .optional("those of the ponytails of `head`"),
        strings("bound",
                "Groups of strands whose guides are bound to one another wherever they touch, "
                "as in a braid.")
            .optional("none"),
        meters("reach", "Distance of points of two guides up to which they are linked.")
            .defaults(d.reach)
            .at_least(0),
        integer("links", "Links of a point to others, at most.").defaults(d.links).between(0, 8),
        integer("capsules", "Capsules that stand for the body in files, at most.")
            .defaults(d.capsules.count)
            .between(1, 64)};
}

const std::string kDynamics =
    kStyle +
    "local hair = style:grow{ count = 60 }\n"
    "local dynamics = hair:guide_set{ count = 20 }:dynamics{ head = style }\n";

std::vector<Function> dynamics_methods() {
    return {
        {.name = "step",
         .body = step_dynamics,
         .summary = "Moves the hair on, while the head goes evenly from its present place to the "
                    "one given. The same for any number of threads.",
         .arguments = {number("seconds", "Time of the step.").above(0).between(0, 10)},
         .options = {affine("head",
                            "Place of the head in the world, metres; instead of the others.")
                         .optional("that of the others"),
                     vector("translate",
                            "Translation of the head in the world, from its place at "
                            "the beginning; added last.")
                         .in("metres")
                         .optional("with rotate none, else that of the present place"),
                     options("rotate", rotation_fields("the origin"),
                             "Rotation of the head from that at the beginning.")
                         .optional("with translate none, else that of the present place")},
         .results = {{"lissom.HairDynamics", "dynamics", "The dynamics itself."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite, ErrorCode::cancelled},
         .example = kDynamics +
                    "for i = 1, 3 do\n"
                    "    dynamics:step(1 / 30, { rotate = { axis = \"y\", angle = 5 * i } })\n"
                    "end\n"
                    "assert(dynamics:motion().stretch < 0.01)"},
        {.name = "set",
         .body = set_dynamics,
         .summary = "Changes options of the next steps.",
         .options = motion_fields(false),
         .results = {{"lissom.HairDynamics", "dynamics", "The dynamics itself."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite},
         .example = kDynamics + "dynamics:set{ wind = { 3, 0, 0 } }:step(0.1)"},
        {.name = "reset",
         .body = reset_dynamics,
         .summary = "Puts hair and head back to the beginning.",
         .results = {{"lissom.HairDynamics", "dynamics", "The dynamics itself."}},
         .example = kDynamics + "assert(dynamics:step(0.1):reset():motion().max == 0)"},
        {.name = "guides",
         .body = dynamics_guides,
         .summary = "The guides as they are now, in the space of the head.",
         .results = {{"lissom.Strands", "guides", "As `guides` of the set."}},
         .errors = {ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kDynamics + "assert(#dynamics:guides() == 20)"},
        {.name = "strands",
         .body = dynamics_strands,
         .summary = "All strands as they are now, in the space of the head, as `rebuild` of the "
                    "set makes them.",
         .options = {boolean("details", "Adds the differences of the strands from their sums.")
                         .defaults(true),
                     object("into", "lissom.Strands",
                            "Strands of the set, which take the new places and keep all else.")
                         .optional("new strands")},
         .results = {{"lissom.Strands", "strands", "In the order of the strands."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kDynamics + "assert(#dynamics:step(0.1):strands{ into = hair } == 60)"},
        {.name = "motion",
         .body = dynamics_motion,
         .summary = "How far the hair is from the style at rest, and how fast it moves.",
         .results = {{"lissom.HairMotion", "motion", "As seen from the head."}},
         .example = kDynamics + "assert(dynamics:motion().max == 0)"},
        {.name = "rig",
         .body = dynamics_rig,
         .summary = "Ties, links and capsules, as a simulation of an engine takes them.",
         .results = {{"lissom.HairRig", "rig", "A copy."}},
         .example = kDynamics + "assert(#dynamics:rig().capsules > 0)"},
        {.name = "save",
         .body = save_dynamics,
         .summary = "Writes the rig as JSON, whole or not at all: guides with lengths and root "
                    "frames, ties, links, capsules, and the length of each strand at rest.",
         .arguments = {string("path", "The file.")},
         .results = {{"lissom.HairDynamics", "dynamics", "The dynamics itself."}},
         .errors = {ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                    ErrorCode::not_finite, ErrorCode::cancelled},
         .example = kDynamics + "local path = os.tmpname()\ndynamics:save(path)\nos.remove(path)"}};
}

}  // namespace

Function dynamics_method() {
    std::vector<Parameter> fields = rig_fields();
    for (Parameter& field : motion_fields(true)) fields.push_back(std::move(field));
    return {.name = "dynamics",
            .body = make_dynamics,
            .summary =
                "Prepares the guides to move: rods that gravity, wind and the motion of the head "
                "bend, to see whether a style holds.",
            .options = std::move(fields),
            .results = {{"lissom.HairDynamics", "dynamics", "The hair at rest."}},
            .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite,
                       ErrorCode::handle_removed, ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = kDynamics + "dynamics:step(1 / 30)"};
}

Type hair_dynamics_type() {
    return {.name = "lissom.HairDynamics",
            .summary = "Guides in motion, and their rig.",
            .methods = dynamics_methods(),
            .operators = {{"__tostring", dynamics_text, "tostring(dynamics)", "counts"}}};
}

std::vector<Record> hair_dynamics_records() {
    return {
        {"lissom.HairMotion",
         "Hair in motion against the style at rest, as seen from the head; metres.",
         {{"number", "time", "Seconds since the beginning."},
          {"number", "rms", "Root of the mean square of the points' distances from their places."},
          {"number", "max", "The greatest of them."},
          {"integer|nil", "guide", "The guide that has it."},
          {"number", "speed", "Root of the mean square of the points' speeds, in m/s."},
          {"number", "stretch", "Greatest change of a segment's length, as a part of it."},
          {"number", "depth", "Depth of the deepest point in the body, beyond that at rest."}}},
        {"lissom.HairRig",
         "All that holds guides; metres, in the space of the head.",
         {{"integer", "guides", "Number of guides."},
          {"integer", "points", "Points of each."},
          {"integer", "links", "Number of links between points of two guides."},
          {"integer", "bound_links", "Those of them within bound groups."},
          {"lissom.RigTie[]", "ties", "Ties with the points that they hold."},
          {"lissom.Capsule[]", "capsules", "Capsules that stand for the body."},
          {"number", "capsule_cover", "Part of the body around the guides that they cover."}}},
        {"lissom.RigTie",
         "A tie of hair.",
         {{"string", "name", "Its name."},
          {"lissom.Vector", "center", "Its center."},
          {"number", "radius", "Its radius."},
          {"integer[]", "points", "Points of guides, numbered over all of them."}}},
        {"lissom.Capsule",
         "All points near a segment.",
         {{"lissom.Vector", "a", "One end of the segment."},
          {"lissom.Vector", "b", "The other end, which may be the same."},
          {"number", "radius", "Greatest distance of its points from the segment."}}}};
}

}  // namespace lissom::lua
