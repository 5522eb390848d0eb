// Growth of a hairstyle.
#include <algorithm>
#include <cmath>
#include <string>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/parse/expectation.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_object.h"

namespace lissom::lua {
namespace {

// The first number of an attribute at every vertex.
std::vector<double> attribute_factors(const Mesh& head, std::string_view name) {
    const Attribute* found = head.attributes().find(name);
    if (!found || found->domain != Domain::vertex) {
        std::vector<std::string_view> names;
        for (const Attribute& one : head.attributes().all()) {
            if (one.domain == Domain::vertex) names.push_back(one.name);
        }
        refuse_absent("attribute of vertices", name, names);
    }
    std::vector<double> factors;
    for (Index v = 0; v < head.vertex_count(); ++v) factors.push_back(found->at(v)[0]);
    return factors;
}

// Factors for the vertices of the head: a list, the name of an attribute, or a function, which was
// asked before.
std::vector<double> vertex_factors(const Call& call, const char* path, const Mesh& head,
                                   std::span<const double> asked) {
    if (!call.has(path)) return {};
    if (call.kind(path) == Kind::numbers) {
        const auto given = call.numbers(path);
        return {given.begin(), given.end()};
    }
    if (call.kind(path) == Kind::function) return {asked.begin(), asked.end()};
    return attribute_factors(head, call.string(path));
}

// Lengths in metres, one for all hair or by the script's function, and factors of them.
void set_lengths(const Call& call, std::span<const double> lengths, std::vector<double> factors,
                 GrowthOptions& growth) {
    growth.length_map = std::move(factors);
    if (!call.has("length")) return;
    if (call.kind("length") != Kind::function) {
        growth.length = call.number("length");
        return;
    }
    growth.length = lengths.empty() ? 0.0 : *std::max_element(lengths.begin(), lengths.end());
    growth.length_map.resize(lengths.size(), 1.0);
    for (std::size_t v = 0; v < lengths.size() && growth.length > 0.0; ++v) {
        growth.length_map[v] *= lengths[v] / growth.length;
    }
}

// Values of the script's function at every vertex; runs before any C++ object is alive.
std::span<const double> ask_factors(Call& call, const char* path) {
    if (!call.has(path) || call.kind(path) != Kind::function) return {};
    lua_State* L = call.lua();
    const auto style = call.self<HairstyleObject>();
    const Index count = style->head->mesh.vertex_count();
    auto* factors = call.scratch<double>(at(count));
    for (Index v = 0; v < count; ++v) {
        if (!style.get() || style->head->mesh.vertex_count() != count) {
            call.reject(path, "the function must change neither the style nor its head");
        }
        lua_pushvalue(L, call.stack_index(path));
        call.push_id(v);
        call.push_coordinates(style->head->mesh.position(v));
        lua_call(L, 4, 1);
        if (lua_type(L, -1) != LUA_TNUMBER) {
            call.reject(path, lua_pushfstring(L,
                                              "its function must return a number, not %s, for "
                                              "vertex %d",
                                              luaL_typename(L, -1), index_of(v) + 1));
        }
        factors[v] = lua_tonumber(L, -1);
        lua_pop(L, 1);
    }
    if (!style.get()) call.reject(path, "the function must not close the style");
    return {factors, at(count)};
}

// How high hair lies over the head, which it knows only while it keeps outside.
void read_heights(const Call& call, GrowthOptions& growth) {
    if (call.has("avoid")) growth.avoid = call.boolean("avoid");
    const auto take = [&](const char* option, double& target) {
        if (!call.has(option)) return;
        require(growth.avoid, "option '" + std::string(option) +
                                  "' needs avoid = true: without it hair follows the field alone");
        target = call.number(option);
    };
    take("clearance", growth.clearance);
    take("layer", growth.layer);
    take("ramp", growth.ramp);
}

void read_growth(const Call& call, const Scalp& scalp, GrowthOptions& growth) {
    growth.seed = static_cast<std::uint64_t>(call.integer("seed"));
    if (call.has("variation")) growth.variation = call.number("variation");
    growth.segment = call.number("segment");
    growth.min_speed = call.number("min_speed");
    if (call.has("lift")) growth.lift = call.number("lift");
    read_heights(call, growth);
    if (call.has("max_turn")) {
        growth.max_turn = call.number("max_turn") * kPi / 180.0;
    }
    growth.max_segments = call.integer("max_segments");
    if (call.has("cut")) {
        HairCut cut;
        cut.point = scalp.to_metres(call.vector("cut.point"));
        if (call.has("cut.normal")) {
            cut.normal = scalp.frame().axes.transpose() * call.vector("cut.normal");
        }
        cut.ragged = call.number("cut.ragged");
        growth.cuts.push_back(cut);
    }
}

int grow_hair(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const auto density = ask_factors(call, "density");
    const auto factors = ask_factors(call, "lengths");
    const auto lengths = ask_factors(call, "length");
    const bool reuse = call.has("into");
    const auto result = reuse ? call.object<StrandsObject>("into") : call.create<StrandsObject>();
    const bool done = call.attempt([&] {
        Hairstyle& own = style->style();
        HairOptions options = own.default_hair();
        options.roots.count = call.integer("count");
        options.roots.seed = static_cast<std::uint64_t>(call.integer("seed"));
        if (call.has("roots")) options.roots.pattern = call.choice<RootPattern>("roots");
        options.roots.density = vertex_factors(call, "density", style->head->mesh, density);
        read_growth(call, own.scalp(), options.growth);
        set_lengths(call, lengths, vertex_factors(call, "lengths", style->head->mesh, factors),
                    options.growth);
        if (!reuse) result.set(std::make_shared<StrandsObject>(Strands()));
        own.grow(options, result->strands, call.context());
        result->grown_on = own.shared_scalp();
    });
    if (!done) return call.fail();
    call.charge(result);
    call.charge(style);
    if (reuse) lua_pushvalue(call.lua(), call.stack_index("into"));
    return 1;
}

// ---- Descriptions

constexpr const char* kOfVertex = "fun(vertex: integer, x: number, y: number, z: number): number";

Parameter factors_option(const std::string& name, const std::string& help) {
    return either(
               name,
               {numbers("list", "One for each vertex of the head."),
                string("attribute", "Name of an attribute of vertices."),
                function("factor", kOfVertex,
                         "Asked for each vertex of the head with its number and its place in mesh "
                         "units.")},
               help)
        .optional("1 everywhere");
}

Parameter metres(const std::string& name, double value, const std::string& help) {
    return number(name, help).in("metres").defaults(value).at_least(0);
}

// Over the head, for hair that keeps outside of it.
Parameter height(const std::string& name, double value, const std::string& help) {
    return number(name, help + " For `avoid`.")
        .in("metres")
        .optional(plain_number(value))
        .at_least(0);
}

std::vector<Parameter> growth_fields() {
    const GrowthOptions defaults;
    const std::string by_vertex =
        " For the vertices of the head: a list, the name of an attribute, or function(vertex, x, "
        "y, z), asked with the vertex's number and its place in mesh units.";
    return {
        integer("seed", "Another seed gives other roots and other chance.").defaults(1).at_least(0),
        either("length",
               {number("metres", "Length of every strand.").in("metres").at_least(0),
                function("metres", kOfVertex,
                         "Asked for each vertex of the head with its number and its place in mesh "
                         "units; gives metres.")},
               "Length of a strand, at most twice the diagonal of the volume. By function(vertex, "
               "x, y, z) in metres, for instance for a fringe that is shorter than the rest: it is "
               "asked for each vertex of the head with its number and its place in mesh units.")
            .in("metres")
            .optional(plain_number(defaults.length))
            .thesis("4.6", "as the field carries it"),
        number("variation", "Share by which strands are longer or shorter at most.")
            .optional(plain_number(defaults.variation))
            .thesis("4.6", "0")
            .between(0, 1),
        choice("roots", {"poisson", "angles", "steps"},
               "Evenly spread; a root at a random place of each cell of polar angles; or in equal "
               "steps of the angles with little randomness, as in the thesis: of steps the first n "
               "of more are spread alike, but not the same.")
            .optional("\"poisson\"")
            .thesis("4.6", "\"steps\""),
        factors_option("density", "Relative density of hair." + by_vertex),
        factors_option("lengths", "Factors of the length." + by_vertex),
        options("cut",
                {vector("point", "A point of the plane.").in("mesh units"),
                 vector("normal", "Direction without hair.").optional("down"),
                 metres("ragged", 0.006, "Strands meet the plane moved by this at most.")},
                "Cuts hair off along a plane, but for tails.")
            .optional(),
        boolean("avoid", "Keeps strands outside the head while they grow.")
            .optional("true")
            .thesis("4.6", "false"),
        height("clearance", defaults.clearance, "The lowest strands lie this high."),
        height("layer", defaults.layer, "The highest lie higher by this."),
        height("ramp", defaults.ramp, "Length over which strands rise to their height."),
        number("lift", "Share of the normal of the head in the first segment.")
            .optional(plain_number(defaults.lift))
            .thesis("4.6", "0")
            .at_least(0),
        number("segment", "Length of a segment, in steps of the grid.")
            .defaults(defaults.segment)
            .between(kMinSegment, kMaxSegment),
        number("min_speed", "A strand ends if the field is shorter than this.")
            .defaults(defaults.min_speed)
            .between(0, 0.99),
        number(
            "max_turn",
            "A strand ends before a segment that turns by more than this, as about a sink of the "
            "field; 180 lets strands turn as they like.")
            .in("degrees")
            .optional(plain_number(std::round(defaults.max_turn * 180.0 / kPi)))
            .thesis("4.6", "180")
            .between(0, 180),
        integer("max_segments", "A strand has no more segments.")
            .defaults(index_of(defaults.max_segments))
            .at_least(1),
        object("into", "lissom.Strands",
               "Strands whose place the new ones take. After an error they are as they were, or "
               "empty if growth had begun.")
            .optional("new strands")};
}

}  // namespace

std::vector<Function> style_growth_methods() {
    return {{.name = "grow",
             .body = grow_hair,
             .summary =
                 "Grows hair that follows the field from its roots on the scalp. Lengths are those "
                 "of a style, in metres of an average head. Strands that pass through the tie of "
                 "a ponytail are in the group of its name.",
             .arguments = {integer("count", "Number of strands; the first n of more are the same.")
                               .defaults(index_of(RootOptions{}.count))
                               .between(0, kMaximumRoots)},
             .named_arguments = true,
             .options = growth_fields(),
             .results = {{"lissom.Strands", "hair", "The strands."}},
             .effect = Effect::changes,
             .errors = {ErrorCode::invalid_argument, ErrorCode::region_empty,
                        ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                        ErrorCode::handle_removed, ErrorCode::cancelled},
             .example = kStyle + "local hair = style:grow{ count = 1000, length = 0.2 }\n"
                                 "assert(#hair == 1000)"}};
}

}  // namespace lissom::lua
