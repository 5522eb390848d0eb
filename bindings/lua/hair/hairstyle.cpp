// lissom.Hairstyle: style curves, the field that they determine, and growth.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "bindings/lua/core/file_path.h"
#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/hair/hair_object.h"
#include "bindings/lua/hair/strands_object.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/style_file.h"

namespace lissom::lua {

Hairstyle& HairstyleObject::style() {
    if (content) return *content;
    throw Error(ErrorCode::handle_removed, "the hairstyle was closed; make a new one");
}

namespace {

// ---- lissom.hairstyle

HairstyleOptions style_options(const Call& call) {
    const bool thesis = call.integer("fidelity") == 1;
    HairstyleOptions options =
        style_options_with(thesis ? HairFidelity::thesis : HairFidelity::lissom);
    options.resolution = call.integer("resolution");
    if (call.has("volume"))
        options.volume = Box{call.vector("volume.min"), call.vector("volume.max")};
    options.field.solver = call.choice<GridSolver>("solver");
    if (call.has("boundary")) options.field.boundary = call.choice<GridBoundary>("boundary");
    if (call.has("tension")) options.field.tension = call.number("tension");
    return options;
}

int make_hairstyle(Call& call) {
    const auto head = call.object<MeshObject>("head");
    const auto result = call.create<HairstyleObject>();
    const bool done = call.attempt([&] {
        const HairstyleOptions options = style_options(call);
        const auto scalp = call.has("scalp") ? call.object<ScalpObject>("scalp")->scalp
                                             : std::make_shared<const Scalp>(
                                                   head->mesh, ScalpOptions{}, call.context());
        Hairstyle style(head->mesh, scalp, options, call.context());
        result.set(std::make_shared<HairstyleObject>(head.share(), std::move(style)));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

// ---- Files

int save_style(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const char* path = call.string("path");
    const char* head = call.has("head") ? call.string("head") : "";
    const bool done = call.attempt([&] {
        lissom::save_style(content_of(style->style(), head), call.file(path, FileUse::write),
                           call.context());
    });
    return done ? call.push_argument() : call.fail();
}

// The head that a style names, relative paths beside the style's file.
std::shared_ptr<MeshObject> named_head(const Call& call, const std::filesystem::path& style,
                                       const StyleContent& content) {
    if (content.head.empty()) {
        throw Error(ErrorCode::invalid_argument,
                    display_name(style) + ": the style names no head; give one");
    }
    return std::make_shared<MeshObject>(load_mesh(
        call.file(display_name(style.parent_path() / file_path(content.head)), FileUse::read), {},
        call.context()));
}

bool refuses_a_value(ErrorCode code) {
    return code == ErrorCode::invalid_argument || code == ErrorCode::out_of_range ||
           code == ErrorCode::region_empty || code == ErrorCode::singular_transform;
}

// The hairstyle of a file. Values that no style can have are the file's mistake, not the script's.
Hairstyle style_of(const std::filesystem::path& path, const StyleContent& content, const Mesh& head,
                   const std::shared_ptr<const Scalp>& scalp, const Context& context) {
    try {
        return make_style(content, head, scalp, context);
    } catch (const Error& error) {
        if (!refuses_a_value(error.code())) throw;
        const std::string file = display_name(path);
        throw FileError(ErrorCode::file_syntax, file, file + ": " + error.message());
    }
}

int load_style(Call& call) {
    const std::string_view path = call.string("path");
    const bool has_head = call.has("head"), has_scalp = call.has("scalp");
    const auto head = call.object<MeshObject>("head");
    const auto result = call.create<HairstyleObject>();
    const bool done = call.attempt([&] {
        const std::filesystem::path file = call.file(path, FileUse::read);
        const StyleContent content = lissom::load_style(file, call.context());
        const auto mesh = has_head ? head.share() : named_head(call, file, content);
        const auto scalp =
            has_scalp ? call.object<ScalpObject>("scalp")->scalp
                      : std::make_shared<const Scalp>(mesh->mesh, ScalpOptions{}, call.context());
        result.set(std::make_shared<HairstyleObject>(
            mesh, style_of(file, content, mesh->mesh, scalp, call.context())));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

// ---- Curves

template <typename Shape>
int add_curve(Call& call, bool ponytails) {
    const auto style = call.self<HairstyleObject>();
    const CurveReader reader(call, ponytails);
    const auto result = call.create<CurveObject>();
    const bool done = call.attempt([&] {
        StyleCurve curve{curve_with<Shape>(style->style().options().fidelity)};
        reader.read(style->style().scalp(), curve);
        const CurveId id = style->style().add(std::move(curve));
        result.set(std::make_shared<CurveObject>(CurveObject{style.share(), id}));
    });
    return done ? 1 : call.fail();
}

int add_stream(Call& call) {
    return add_curve<StreamCurve>(call, false);
}
int add_dividing(Call& call) {
    return add_curve<DividingCurve>(call, false);
}
int add_ponytail(Call& call) {
    return add_curve<Ponytail>(call, true);
}

int style_curves(Call& call) {
    const auto style = call.self<HairstyleObject>();
    auto& ids = call.hold<std::vector<CurveId>>();
    auto& owner = call.hold<std::shared_ptr<HairstyleObject>>();
    const bool done = call.attempt_quick([&] {
        const auto all = style->style().curves();
        ids.assign(all.begin(), all.end());
        owner = style.share();
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), count_of(ids), 0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (!push_curve(call, owner, ids[i])) return call.fail();
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

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

// ---- The field

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

// ---- Growth

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
    });
    if (!done) return call.fail();
    call.charge(result);
    call.charge(style);
    if (reuse) lua_pushvalue(call.lua(), call.stack_index("into"));
    return 1;
}

// ---- The rest

int style_at(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const Scalp* scalp = nullptr;
    if (!call.attempt_quick([&] { scalp = &style->style().scalp(); })) return call.fail();
    return push_point_at(call, *scalp);
}

int style_normal_at(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const Scalp* scalp = nullptr;
    if (!call.attempt_quick([&] { scalp = &style->style().scalp(); })) return call.fail();
    return push_normal_at(call, *scalp);
}

int style_scalp(Call& call) {
    const auto style = call.self<HairstyleObject>();
    const auto result = call.create<ScalpObject>();
    const bool done = call.attempt_quick([&] {
        result.set(std::make_shared<ScalpObject>(style->head, style->style().shared_scalp()));
    });
    return done ? 1 : call.fail();
}

int style_head(Call& call) {
    return push_owner(call, call.self<HairstyleObject>()->head);
}

std::string_view fidelity_name(const Hairstyle& style) {
    return style.options().fidelity == HairFidelity::thesis ? "thesis" : "default";
}

int style_stats(Call& call) {
    const auto style = call.self<HairstyleObject>();
    GridLayout layout;
    int constraints = 0, curves = 0;
    std::string_view fidelity;
    const bool done = call.attempt_quick([&] {
        const Hairstyle& own = style->style();
        layout = own.layout();
        fidelity = fidelity_name(own);
        constraints = own.field().grid().constraint_count();
        curves = index_of(own.curves().size());
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 5);
    call.set_field("fidelity", call.push(fidelity));
    call.set_field("curves", call.push(curves));
    call.set_field("constraints", call.push(constraints));
    call.set_field("grid_points", call.push(layout.size()));
    call.set_field("step", call.push(layout.step));
    return 1;
}

int style_text(Call& call) {
    const auto style = call.self<HairstyleObject>();
    int curves = 0, points = 0;
    bool thesis = false;
    const bool open = call.attempt_quick([&] {
        curves = index_of(style->style().curves().size());
        points = style->style().layout().size();
        thesis = style->style().options().fidelity == HairFidelity::thesis;
    });
    if (!open) return call.push("lissom.Hairstyle (closed)");
    lua_pushfstring(call.lua(), "lissom.Hairstyle: %d curves, %d grid points%s", curves, points,
                    thesis ? ", as in the thesis" : "");
    return 1;
}

// ---- Descriptions

const std::vector<ErrorCode> kAddErrors = {ErrorCode::not_finite, ErrorCode::invalid_argument,
                                           ErrorCode::out_of_range, ErrorCode::handle_removed,
                                           ErrorCode::memory_limit};
const std::vector<ErrorCode> kFieldErrors = {ErrorCode::not_positive_definite,
                                             ErrorCode::memory_limit, ErrorCode::handle_removed,
                                             ErrorCode::cancelled};
const std::vector<Result> kSelfStyle = {{"lissom.Hairstyle", "style", "The hairstyle itself."}};

// The points of a curve, which are an argument, and its options.
std::vector<Parameter> first_of(const std::vector<Parameter>& fields) {
    return {fields.front()};
}
std::vector<Parameter> rest_of(const std::vector<Parameter>& fields) {
    return {fields.begin() + 1, fields.end()};
}

std::vector<Function> adding_methods() {
    const std::vector<Result> curve = {{"lissom.Curve", "curve", "The curve, behind all others."}};
    return {
        {.name = "add_stream",
         .body = add_stream,
         .summary = "Adds a stream curve: hair flows along it.",
         .arguments = first_of(stream_fields()),
         .named_arguments = true,
         .options = rest_of(stream_fields()),
         .results = curve,
         .effect = Effect::changes,
         .errors = kAddErrors,
         .example = kStyle},
        {.name = "add_dividing",
         .body = add_dividing,
         .summary = "Adds a dividing curve: hair parts along it. In a grid of more points the same "
                    "lengths in metres mean the same style; the defaults follow the grid.",
         .arguments = first_of(dividing_fields()),
         .named_arguments = true,
         .options = rest_of(dividing_fields()),
         .results = curve,
         .effect = Effect::changes,
         .errors = kAddErrors,
         .example = kStyle + R"(local parting = {}
for i, elevation in ipairs{ 40, 60, 80 } do
    parting[i] = style:at{ azimuth = 0, elevation = elevation }
end
style:add_dividing{ points = parting, tilt = { 20, 40 } })"},
        {.name = "add_ponytail",
         .body = add_ponytail,
         .summary = "Adds a ponytail: hair is drawn into a tie and goes on along a spine.",
         .arguments = first_of(ponytail_fields()),
         .named_arguments = true,
         .options = rest_of(ponytail_fields()),
         .results = curve,
         .effect = Effect::changes,
         .errors = kAddErrors,
         .example = kStyle + R"(local behind = { azimuth = 180, elevation = 25, lift = 0.02 }
local tie, out = style:at(behind), style:normal_at(behind)
local spine = { tie }
for i = 1, 3 do
    spine[i + 1] = { tie[1], tie[2] - 0.02 * i * i, tie[3] + 0.04 * i * out[3] }
end
style:add_ponytail{ spine = spine, radius = 0.016 })"}};
}

std::vector<Function> field_methods() {
    return {
        {.name = "solve",
         .body = solve_style,
         .summary = "Brings the field up to date with the curves. `grow` and `field` do so by "
                    "themselves.",
         .results = kSelfStyle,
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
         .results = kSelfStyle,
         .errors = kFieldErrors,
         .example = kStyle + "style:avoid_scalp()"},
        {.name = "forget_scalp",
         .body = forget_scalp,
         .summary = "Undoes avoid_scalp.",
         .results = kSelfStyle,
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "style:avoid_scalp():forget_scalp()"}};
}

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

std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

// Over the head, for hair that keeps outside of it.
Parameter height(const std::string& name, double value, const std::string& help) {
    return number(name, help + " For `avoid`.").in("metres").optional(shown(value)).at_least(0);
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
            .optional(shown(defaults.length))
            .thesis("4.6", "as the field carries it"),
        number("variation", "Share by which strands are longer or shorter at most.")
            .optional(shown(defaults.variation))
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
            .optional(shown(defaults.lift))
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
            .optional(shown(std::round(defaults.max_turn * 180.0 / kPi)))
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

std::vector<Function> growth_methods() {
    return {{.name = "grow",
             .body = grow_hair,
             .summary =
                 "Grows hair that follows the field from its roots on the scalp. Lengths are those "
                 "of a style, in metres of an average head. Strands that pass through the tie of "
                 "a ponytail are in the group of its name.",
             .arguments = {integer("count", "How many strands; the first n of more are the same.")
                               .defaults(100000)
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

std::vector<Function> plain_methods() {
    return {
        point_at_method(style_at, kStyle + "local p = style:at{ azimuth = 90, elevation = 30 }"),
        normal_at_method(style_normal_at,
                         kStyle + "local n = style:normal_at{ azimuth = 90, elevation = 30 }"),
        {.name = "curves",
         .body = style_curves,
         .summary = "Its curves in their order.",
         .results = {{"lissom.Curve[]", "curves", "A list."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "assert(style:curves()[1] == curve)"},
        {.name = "constraints",
         .body = style_constraints,
         .summary = "Constraints of the field from the enabled curves and avoid_scalp: one "
                    "vector a constrained grid point. `lissom.render{ style = }` draws them.",
         .results = {{"lissom.StyleConstraint[]", "constraints", "A list."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + R"(local first = style:constraints()[1]
assert(first.curve == 1 and (first.kind == 'stream' or first.kind == 'stop')))"},
        {.name = "scalp",
         .body = style_scalp,
         .summary = "The scalp that it was made for.",
         .results = {{"lissom.Scalp", "scalp", "The scalp."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "local center = style:scalp():center()"},
        {.name = "head",
         .body = style_head,
         .summary = "The mesh of the head.",
         .results = {{"lissom.Mesh", "head", "The mesh."}},
         .errors = {ErrorCode::topology_mismatch},
         .example = kStyle + "assert(style:head() == head)"},
        {.name = "save",
         .body = save_style,
         .summary = "Writes curves and options as JSON that people can read and edit, in metres "
                    "of an average head. See `lissom.load_style`.",
         .arguments = {string("path", "The file.")},
         .options = {string("head",
                            "Path of the head's mesh as the file shall have it, best "
                            "beside it.")
                         .optional("none")},
         .results = kSelfStyle,
         .errors = {ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                    ErrorCode::handle_removed, ErrorCode::cancelled},
         .example = kStyle + "local path = os.tmpname()\nstyle:save(path)\nos.remove(path)"},
        {.name = "stats",
         .body = style_stats,
         .summary = "Sizes of the grid and of the system.",
         .results = {{"lissom.HairstyleStats", "stats", "Numbers."}},
         .errors = {ErrorCode::handle_removed},
         .example = kStyle + "assert(style:stats().curves == 1)"}};
}

std::vector<Parameter> style_fields() {
    return {
        object("scalp", "lissom.Scalp", "The scalp.").optional("guessed"),
        integer("resolution",
                "Grid points of the field. 25,000 do for smooth styles, 50,000 for ponytails.")
            .defaults(index_of(HairstyleOptions{}.resolution))
            .between(kMinimumResolution, kMaximumResolution),
        options("volume", {vector("min", "A corner."), vector("max", "The opposite corner.")},
                "A box in metres of an average head, around the center of its frame: x to its "
                "left, y up, z to the front. Hair ends at its faces.")
            .optional("around the head, down to the chest"),
        choice("solver", {"dual", "cholesky"},
               "dual is fast; cholesky is the thesis's way, a reference: it updates its factor, "
               "or makes it again in a build without CHOLMOD.")
            .defaults("dual"),
        choice("boundary", {"zero_flux", "thesis"}, "How the field behaves at the box.")
            .optional("\"zero_flux\"")
            .thesis("4.4.1", "\"thesis\""),
        number("tension", "Keeps the field from growing far from the curves.")
            .optional(shown(HairField::default_options().tension))
            .thesis("4.4.1", "0")
            .at_least(0),
        choice("fidelity", {"default", "thesis"},
               "thesis: chapter 4 to the letter, for comparison. It changes the defaults, also "
               "for the curves and for `grow`; the page thesis.md of the reference names all of "
               "it.")
            .defaults("default")};
}

}  // namespace

Type hairstyle_type() {
    Type type{
        .name = "lissom.Hairstyle",
        .summary =
            "Style curves on a head, and the hair that follows them. It is made for "
            "the shape that the head had then. Lengths among its options are in "
            "metres of an average head, so that a style fits any head; points are in "
            "mesh units.",
        .close = [](void* object) { static_cast<HairstyleObject*>(object)->content.reset(); }};
    for (const auto& list : {plain_methods(), adding_methods(), field_methods(), growth_methods(),
                             style_stroke_methods()}) {
        type.methods.insert(type.methods.end(), list.begin(), list.end());
    }
    type.operators = {{"__tostring", style_text, "tostring(style)", "its size"}};
    return type;
}

std::vector<Record> hairstyle_records() {
    std::vector<Record> records{
        {"lissom.StyleConstraint",
         "A vector that a hairstyle gives its field at a grid point.",
         {{"number[]", "point", "{x, y, z}, in mesh units."},
          {"number[]", "vector", "{x, y, z}: the field there, of length 1 at most."},
          {"string", "kind",
           "Its source: \"stream\", along a stream curve; \"stop\", vanishing beyond its end; "
           "\"parting\", along the Gaussian beside a dividing curve, and \"separation\" above "
           "it; \"section\", \"spine\" and \"gather\" of a ponytail: near its cross sections, "
           "along the rest of its spine, into its tie; \"scalp\", of avoid_scalp."},
          {"integer?", "curve", "Place of the curve among style:curves(); nil for the scalp's."},
          {"number", "weight", "How strictly it is kept."}}},
        {"lissom.HairstyleStats",
         "Sizes of a hairstyle.",
         {{"string", "fidelity", "\"default\" or \"thesis\"."},
          {"integer", "curves", "Number of curves."},
          {"integer", "constraints", "Constrained grid points of the last solve."},
          {"integer", "grid_points", "Points of the grid."},
          {"number", "step",
           "Distance of neighbouring grid points, in metres of an average "
           "head."}}}};
    for (Record& record : style_stroke_records()) records.push_back(std::move(record));
    return records;
}

std::vector<Function> hairstyle_functions() {
    return {
        {.name = "load_style",
         .body = load_style,
         .summary = "Reads a style that `save` wrote.",
         .arguments = {string("path", "The JSON file."),
                       object("head", "lissom.Mesh", "The head that it goes on.")
                           .optional("the one that the file names, beside it")},
         .options = {object("scalp", "lissom.Scalp", "The scalp.").optional("guessed")},
         .results = {{"lissom.Hairstyle", "style", "The hairstyle."}},
         .errors = {ErrorCode::file_not_found, ErrorCode::file_is_directory, ErrorCode::file_empty,
                    ErrorCode::file_unreadable, ErrorCode::file_syntax, ErrorCode::unsupported,
                    ErrorCode::invalid_argument, ErrorCode::out_of_range, ErrorCode::mesh_empty,
                    ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kStyle + R"(local path = os.tmpname()
style:save(path)
local copy = lissom.load_style(path, head)
assert(#copy:curves() == 1)
os.remove(path))"},
        {.name = "hairstyle",
         .body = make_hairstyle,
         .summary = "Starts a hairstyle without curves on a head.",
         .arguments = {object("head", "lissom.Mesh", "The head; its shape is copied.")},
         .options = style_fields(),
         .results = {{"lissom.Hairstyle", "style", "The hairstyle."}},
         .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example = kStyle}};
}

}  // namespace lissom::lua
