// lissom.merge and lissom.merger.
#include <algorithm>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/thesis_parts.h"
#include "bindings/lua/merge/merge_object.h"
#include "kernel/merge/merge_once.h"
#include "kernel/merge/merge_within.h"

namespace lissom::lua {

Merger& MergerObject::merger() {
    if (!content) throw Error(ErrorCode::handle_removed, "the merger was closed; make a new one");
    return *content;
}

namespace {

constexpr std::pair<const char*, const char*> kDirections[] = {{"source_up", "target_up"},
                                                               {"source_front", "target_front"}};

// A direction of one model says nothing without one of the other.
void check_directions(const Call& call) {
    for (const auto& [source, target] : kDirections) {
        if (call.has(source) == call.has(target)) continue;
        call.reject(call.has(source) ? source : target,
                    "directions come in pairs: source_up with target_up, source_front with "
                    "target_front");
    }
}

std::vector<DirectionPair> given_directions(const Call& call) {
    std::vector<DirectionPair> pairs;
    for (const auto& [source, target] : kDirections) {
        if (call.has(source)) pairs.push_back({call.vector(source), call.vector(target)});
    }
    return pairs;
}

// Those whose defaults the fidelity changes.
void read_steps(const Call& call, MergeOptions& options) {
    if (call.has("features")) options.feature_motion = call.choice<FeatureMotion>("features");
    if (call.has("frames")) options.turn_frames = call.integer("frames") == 0;
    if (call.has("seam")) options.seam = call.choice<SeamKind>("seam");
    if (call.has("collar")) options.collar = call.boolean("collar");
    if (call.has("trim")) options.trim = call.boolean("trim");
    if (call.has("subdivide")) options.refine = call.boolean("subdivide");
    // The thesis smooths seams without a transition only.
    if (options.thesis && call.has("transition")) options.smooth = 0;
    if (call.has("smooth")) options.smooth = call.integer("smooth");
}

MergeOptions merge_options(const Call& call) {
    const auto configuration = call.choice<Configuration>("configuration");
    MergeOptions options;
    if (call.integer("fidelity") == 1) options = MergeOptions::literal(configuration);
    options.configuration = configuration;
    options.overlap = thesis_overlap();
    options.place = call.choice<Place>("place");
    read_steps(call, options);
    if (call.has("transition") && call.kind("transition") == Kind::boolean) {
        options.suit_transition = true;
    } else if (call.has("transition")) {
        options.source_transition = call.number("transition.source");
        options.target_transition = call.number("transition.target");
        options.transition_weight = call.number("transition.weight");
    }
    options.greatest_turn = call.number("greatest_turn") * kPi / 180.0;
    options.find_intersections = call.boolean("intersections");
    // A seam that is asked for is made.
    options.mend = call.boolean("mend") && !call.has("seam") && !call.has("transition");
    return options;
}

MeshObject& mesh_of(Holder* holder) {
    return *Ref<PathObject>(holder)->mesh;
}

// Arguments of a call of lissom.merge or lissom.merger, as plain data.
struct MergeCall {
    std::span<const JoinSpec> joins;
    MeshObject* source;
    MeshObject* const* targets;
    std::size_t target_count;
    const RegionObject* const* fixed;
    std::size_t fixed_count;
};

// The meshes of a merge: those that the boundaries of its joins belong to.
struct MeshesOfJoins {
    MeshObject* source = nullptr;
    std::vector<MeshObject*> targets;

    Index target_of(Holder* holder) const {
        const auto at = std::find(targets.begin(), targets.end(), &mesh_of(holder));
        return index_of(at - targets.begin());
    }
};

MeshesOfJoins meshes_of(const MergeCall& asked) {
    MeshesOfJoins meshes;
    if (asked.joins.empty()) {
        meshes.source = asked.source;
        meshes.targets.assign(asked.targets, asked.targets + asked.target_count);
        return meshes;
    }
    for (const JoinSpec& join : asked.joins) {
        MeshObject& source = mesh_of(join.source);
        if (meshes.source && meshes.source != &source) {
            throw Error(ErrorCode::invalid_argument,
                        "the boundaries that joins call source lie on different meshes; append "
                        "these to one first");
        }
        meshes.source = &source;
        MeshObject* target = &mesh_of(join.target);
        if (std::find(meshes.targets.begin(), meshes.targets.end(), target) ==
            meshes.targets.end()) {
            meshes.targets.push_back(target);
        }
    }
    return meshes;
}

void require_named(const MeshObject* named, const std::vector<MeshObject*>& used,
                   const char* side) {
    if (!named || std::find(used.begin(), used.end(), named) != used.end()) return;
    throw Error(ErrorCode::invalid_argument,
                std::string("no join has a boundary of the ") + side +
                    "; take boundaries from this mesh, or leave the option out");
}

// Without joins each target meets the source at their nearest boundaries.
std::vector<Join> nearest_joins(const MeshesOfJoins& meshes, const Context& context) {
    std::vector<Join> joins;
    for (std::size_t i = 0; i < meshes.targets.size(); ++i) {
        joins.push_back(nearest_join(meshes.source->mesh, meshes.targets[i]->mesh, context));
        joins.back().target_mesh = index_of(i);
    }
    return joins;
}

std::vector<Join> joins_of(const MergeCall& asked, const MeshesOfJoins& meshes,
                           const Context& context) {
    if (asked.joins.empty()) return nearest_joins(meshes, context);
    std::vector<Join> joins;
    for (const JoinSpec& spec : asked.joins) {
        joins.push_back({Ref<PathObject>(spec.source)->current(),
                         Ref<PathObject>(spec.target)->current(), meshes.target_of(spec.target),
                         spec.key_pairs()});
    }
    return joins;
}

MergeCall read_merge(const Call& call) {
    check_directions(call);
    MergeCall asked{{}, nullptr, nullptr, 0, nullptr, 0};
    if (call.has("joins")) asked.joins = read_joins(call, "joins");
    if (call.has("source")) asked.source = call.object<MeshObject>("source").get();
    if (call.has("target")) {
        const bool list = call.kind("target") == Kind::objects;
        asked.target_count = list ? call.object_count("target") : 1;
        auto* targets = call.scratch<MeshObject*>(asked.target_count + 1);
        for (std::size_t i = 0; i < asked.target_count; ++i) {
            targets[i] = list ? call.object_at<MeshObject>("target", i).get()
                              : call.object<MeshObject>("target").get();
        }
        asked.targets = targets;
    }
    if (!call.has("joins") && !(asked.source && asked.targets)) {
        call.raise("a merge needs a source and a target, as in lissom.merge(head, body), or joins");
    }
    if (call.has("fixed")) {
        asked.fixed_count = call.object_count("fixed");
        auto* fixed = call.scratch<const RegionObject*>(asked.fixed_count + 1);
        for (std::size_t i = 0; i < asked.fixed_count; ++i) {
            fixed[i] = call.object_at<RegionObject>("fixed", i).get();
        }
        asked.fixed = fixed;
    }
    return asked;
}

std::shared_ptr<MergerObject> make_merger(const Call& call, const MergeCall& asked) {
    MergeOptions options = merge_options(call);
    options.directions = given_directions(call);
    if (call.has("reach")) options.reach = call.number("reach");
    const MeshesOfJoins meshes = meshes_of(asked);
    require_named(asked.source, {meshes.source}, "source");
    for (std::size_t i = 0; i < asked.target_count; ++i) {
        require_named(asked.targets[i], meshes.targets, "target");
    }
    for (std::size_t i = 0; i < asked.fixed_count; ++i) {
        options.fixed.push_back(asked.fixed[i]->current());
    }
    const auto merger = std::make_shared<MergerObject>();
    std::vector<const Mesh*> targets;
    for (const MeshObject* target : meshes.targets) targets.push_back(&target->mesh);
    merger->content.emplace(meshes.source->mesh, targets, joins_of(asked, meshes, call.context()),
                            options, call.context());
    targets.push_back(&meshes.source->mesh);
    for (const Mesh* mesh : targets) {
        merger->inputs.vertices.push_back(mesh->vertex_count());
        merger->inputs.faces.push_back(mesh->face_count());
    }
    return merger;
}

// Boundaries of one mesh are bridged: options of deforming and sewing a source do not apply.
void require_bridge_options(const Call& call) {
    constexpr const char* kDeforming[] = {"source_up", "target_up", "source_front", "target_front",
                                          "fixed",     "features",  "reach",        "frames",
                                          "seam",      "smooth",    "collar",       "transition",
                                          "trim",      "subdivide"};
    const auto refuse = [](const std::string& name) {
        throw Error(ErrorCode::invalid_argument,
                    name +
                        " does not apply if source and target are one mesh: its boundaries are "
                        "bridged and nothing is deformed; leave it out, or merge a copy");
    };
    for (const char* name : kDeforming) {
        if (call.has(name)) refuse(name);
    }
    const MergeOptions options = merge_options(call), defaults;
    if (options.configuration != defaults.configuration) refuse("configuration = \"fixed\"");
    if (options.place != defaults.place) refuse("place = \"shape\"");
    if (options.thesis) refuse("fidelity = \"thesis\"");
}

// The one mesh that all boundaries lie on, or null.
MeshObject* mesh_within(const MergeCall& asked) {
    const MeshesOfJoins meshes = meshes_of(asked);
    const bool one = meshes.targets.size() == 1 && meshes.targets.front() == meshes.source;
    return one ? meshes.source : nullptr;
}

MergeResult merged_within(const Call& call, const MergeCall& asked, const Mesh& mesh,
                          MergeInputs& inputs) {
    require_bridge_options(call);
    const MeshesOfJoins meshes = meshes_of(asked);
    require_named(asked.source, {meshes.source}, "source");
    for (std::size_t i = 0; i < asked.target_count; ++i) {
        require_named(asked.targets[i], meshes.targets, "target");
    }
    inputs = {{mesh.vertex_count(), mesh.vertex_count()}, {mesh.face_count(), mesh.face_count()}};
    return merge_within(mesh, joins_of(asked, meshes, call.context()),
                        call.boolean("intersections"), call.context());
}

int merge_meshes(Call& call) {
    const MergeCall asked = read_merge(call);
    auto& inputs = call.hold<MergeInputs>();
    auto& merger = call.hold<std::shared_ptr<MergerObject>>();
    auto& result = call.hold<std::unique_ptr<MergeResult>>();
    const bool done = call.attempt([&] {
        if (const MeshObject* mesh = mesh_within(asked)) {
            result = std::make_unique<MergeResult>(merged_within(call, asked, mesh->mesh, inputs));
            return;
        }
        merger = make_merger(call, asked);
        inputs = merger->inputs;
        result = std::make_unique<MergeResult>(merger->merger().solve(call.context()));
    });
    return done ? push_merge_result(call, *result, inputs) : call.fail();
}

int new_merger(Call& call) {
    const MergeCall asked = read_merge(call);
    const auto result = call.create<MergerObject>();
    if (!call.attempt([&] { result.set(make_merger(call, asked)); })) return call.fail();
    call.charge(result);
    return 1;
}

// ---- Merger

int set_merger_keys(Call& call) {
    const auto merger = call.self<MergerObject>();
    const Index join = call.id("join");
    const JoinSpec keys = read_keys(call, "keys");
    const bool done =
        call.attempt_quick([&] { merger->merger().set_keys(join, keys.key_pairs()); });
    return done ? call.push_argument() : call.fail();
}

int solve_merger(Call& call) {
    const auto merger = call.self<MergerObject>();
    auto& result = call.hold<std::unique_ptr<MergeResult>>();
    const bool done = call.attempt(
        [&] { result = std::make_unique<MergeResult>(merger->merger().solve(call.context())); });
    return done ? push_merge_result(call, *result, merger->inputs) : call.fail();
}

int merger_warnings(Call& call) {
    const auto merger = call.self<MergerObject>();
    auto& warnings = call.hold<std::vector<std::string>>();
    if (!call.attempt_quick([&] { warnings = merger->merger().warnings(); })) return call.fail();
    lua_createtable(call.lua(), count_of(warnings), 0);
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        call.push(warnings[i]);
        lua_rawseti(call.lua(), -2, index_of(i) + 1);
    }
    return 1;
}

void close_merger(void* object) {
    static_cast<MergerObject*>(object)->content.reset();
}

// ---- Descriptions

std::vector<Parameter> merge_arguments() {
    return {object("source", "lissom.Mesh", "The mesh that is deformed.")
                .optional("the mesh of the joins' sources"),
            either("target",
                   {object("target", "lissom.Mesh", ""), objects("target", "lissom.Mesh", "")},
                   "The mesh, or the meshes, that stay.")
                .optional("the meshes of the joins' targets")};
}

// A merge that is dragged leaves out slow steps.
std::vector<Parameter> merge_parameters(bool intersections) {
    return {
        table("joins",
              "List of { source = boundary, target = boundary, keys = { { s, t }, ... } }: which "
              "boundaries meet, and points that do: vertices of the boundaries, or points {x, y, "
              "z} on them, the source's first. Between keys arc length decides. Without keys the "
              "directions below decide, or else `place`; the report says which turn was taken and "
              "how certain it is. All sources lie on one mesh; targets may lie on several, and "
              "each boundary is in one join.")
            .optional("the boundaries of source and target that lie nearest to each other, one "
                      "join for each target"),
        choice("place", {"as placed", "shape"},
               "How joins without keys and directions are turned about the axis of the boundary. "
               "as placed: least from how the source lies beside the target, so that a part that "
               "was laid roughly, or both as they were modelled, come right; the result is the "
               "same if both are moved together, or if the source is moved without a turn and "
               "scaled. shape: as the shapes of both parts suggest, the same wherever the source "
               "lies; the report says how certain that is. A part that must be turned over by "
               "more than 150 degrees is placed by shape as well.")
            .defaults("as placed"),
        axis("source_up",
             "A direction of the source that is to lie the way `target_up` does, for joins without "
             "keys. It counts as far as it lies in the plane of the boundary: that of a neck's "
             "axis says little.")
            .optional(),
        axis("target_up", "The direction of the targets that belongs to it.").optional(),
        axis("source_front", "Another direction of the source: the view of a face.").optional(),
        axis("target_front", "The direction of the targets that belongs to it.").optional(),
        choice("configuration", {"free", "fixed"},
               "free: the source comes from any place, turned and scaled to fit (thesis 3.3.1). "
               "fixed: it stays in place and bends near the boundaries (3.3.2).")
            .defaults("free"),
        objects("fixed", "lissom.Region",
                "Regions of the source that keep their shape: in the free configuration each "
                "moves as a whole, in the fixed one it stays.")
            .optional("none"),
        choice("features", {"common", "fitted"},
               "How those of the free configuration find the similarity they move by. common: each "
               "has one deformation gradient, an unknown of the systems (thesis 3.5). fitted: the "
               "surface is deformed without them first, and again with the fitted similarity: "
               "less distortion around them, by 5 to 44 % on four merges of real models, in up "
               "to twice the time.")
            .optional("\"fitted\"")
            .thesis("3.5", "\"common\""),
        number("reach",
               "fixed configuration: how far from its boundaries the source deforms, along edges.")
            .above(0)
            .in("units of the source")
            .optional("all of it if `fixed` is given, else three radii of the boundary"),
        choice("frames", {"turn", "keep"},
               "fixed configuration: whether the surface at the boundary turns to meet the "
               "target's, or keeps its directions as in the thesis, which leaves a crease.")
            .optional("\"turn\"")
            .thesis("3.3.2", "\"keep\""),
        choice(
            "seam", {"conform", "fair", "band"},
            "conform: vertices of both boundaries are inserted into the faces of the other "
            "side. fair: then the surface around the seam is bent smooth, unless a transition does "
            "that. band: a band of the "
            "target's faces is replaced, as in the thesis.")
            .optional("\"conform\"")
            .thesis("3.3.1", "\"band\""),
        integer(
            "smooth",
            "Umbrella steps at the seam, at most: the first that would fold it is the last. With "
            "0 and without a collar no vertex of the target moves.")
            .between(0, 1000)
            .optional("3"),
        boolean("collar",
                "Makes the faces of a side anew if its edges are more than 1.5 times as long as "
                "the seam's, from small to large; sharp edges keep their shape.")
            .optional("true")
            .thesis("3.3.1", "false"),
        options("transition",
                {number("source", "Width on the source.")
                     .at_least(0)
                     .in("units of the source")
                     .defaults(0.0),
                 number("target", "Width on the target.")
                     .at_least(0)
                     .in("units of the target")
                     .defaults(0.0),
                 number("weight",
                        "w_T of thesis 3.3.3, for fidelity = \"thesis\", which needs both widths.")
                     .above(0)
                     .defaults(0.1)},
                "Bands on either side of the seam in which details of both fade into each other; "
                "`true` chooses widths that suit each seam: .9 of its radius, at least three "
                "edges, at most half of the side. If the surface has no room for a width, the "
                "band is narrower and a warning says so.")
            .or_true()
            .optional("none"),
        boolean("trim",
                "Boundaries with teeth are cut to smooth lines first, and the report says "
                "so.")
            .optional("true")
            .thesis("3.3.1", "false"),
        number("greatest_turn",
               "Mean turn of a boundary at its vertices above which it is trimmed.")
            .between(0, 180)
            .in("degrees")
            .defaults(20.0),
        boolean("subdivide",
                "Faces of the source at a boundary are split once if its edges are more than "
                "1.5 times as long as those they meet. Edges more than 3 times as long as edges "
                "inside the source are split until they are not, and those of the target with "
                "them (thesis 2.5).")
            .optional("true")
            .thesis("2.5", "false, as which boundaries have too few vertices is not said"),
        boolean("intersections",
                "Looks for faces that run through one another and did not before, for the report.")
            .defaults(intersections),
        boolean("mend",
                "If the verdict finds fault with the surface around the seams, and neither `seam` "
                "nor `transition` is given, sews again with the seam fair and then with a "
                "transition, and keeps the result with fewest faults; a warning says so. Takes the "
                "time "
                "of sewing up to three times. Not without smoothing or collar.")
            .defaults(intersections),
        choice("fidelity", {"default", "thesis"},
               "thesis: section 3.3 to the letter, for comparison, unless another option "
               "differs; the page thesis.md of the reference names all of it.")
            .defaults("default")};
}

std::vector<ErrorCode> merge_errors() {
    return {ErrorCode::not_a_boundary,   ErrorCode::boundary_conflict, ErrorCode::key_conflict,
            ErrorCode::skin_mismatch,    ErrorCode::topology_mismatch, ErrorCode::handle_overlap,
            ErrorCode::invalid_argument, ErrorCode::unconstrained,     ErrorCode::zero_area,
            ErrorCode::nonmanifold_edge, ErrorCode::memory_limit,      ErrorCode::cancelled};
}

constexpr const char* kHalves = R"(local ball = lissom.shapes.sphere{ segments = 24 }
local half = ball:cut{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
local bowl = half:copy():transform{ rotate = { axis = "x", angle = 180 }, scale = 3 }
)";

}  // namespace

Type merger_type() {
    const std::string halves = kHalves;
    const std::string made = halves + R"(local merger = lissom.merger{
    joins = { { source = half:boundaries()[1], target = bowl:boundaries()[1] } },
}
)";
    return {
        .name = "lissom.Merger",
        .summary =
            "A merge that is solved again, without factoring again, after its keys have "
            "moved: for a tool while the user drags a key.",
        .methods = {{.name = "set_keys",
                     .body = set_merger_keys,
                     .summary =
                         "Replaces the keys of one join, and returns the merge. Keys that do "
                         "not fit are an error at once, and those of before stay.",
                     .arguments = {id("join", "Number of the join, from 1."),
                                   table("keys", "List of { s, t }, as in lissom.merge.")},
                     .results = {{"lissom.Merger", "merger", "The same merger."}},
                     .errors = {ErrorCode::out_of_range, ErrorCode::key_conflict,
                                ErrorCode::handle_removed},
                     .example = made + R"(local s, t = half:boundaries()[1], bowl:boundaries()[1]
merger:set_keys(1, { { s:vertices()[1], t:vertices()[5] } })
assert(merger:solve():is_closed()))"},
                    {.name = "solve",
                     .body = solve_merger,
                     .summary = "Merges, and returns a new mesh and a report.",
                     .results = {{"lissom.Mesh", "mesh", "The merged mesh."},
                                 {"lissom.MergeReport", "report", "Measures and results."}},
                     .errors = merge_errors(),
                     .example = made + R"(local mesh, report = merger:solve()
assert(mesh:is_closed() and report.free_vertices > 0))"},
                    {.name = "warnings",
                     .body = merger_warnings,
                     .summary = "Returns findings of the preparation, such as a thin outline "
                                "that is to meet a round one; the report has them as well.",
                     .results = {{"string[]", "warnings", "In plain words."}},
                     .errors = {ErrorCode::handle_removed},
                     .example = made + "assert(#merger:warnings() == 0)"}},
        .close = close_merger};
}

std::vector<Function> merge_functions() {
    const std::string halves = kHalves;
    return {
        {.name = "merge",
         .body = merge_meshes,
         .summary =
             "Joins a source to one or several targets along open boundaries, into a new mesh. The "
             "source is deformed so that its boundaries meet those of the targets, wherever it "
             "lies and whatever its size; the targets stay. Vertices and faces of the targets come "
             "first, in their order, then those of the source; attributes, labels and regions of "
             "all are kept. A side without colors becomes white, one without texture "
             "coordinates gets 0, 0, and a warning says so. If source and target are one mesh, "
             "two of its boundaries are joined by a bridge of triangles, and nothing moves: "
             "options that say how a source is deformed are refused.",
         .arguments = merge_arguments(),
         .named_arguments = true,
         .options = merge_parameters(true),
         .results = {{"lissom.Mesh", "mesh", "The merged mesh."},
                     {"lissom.MergeReport", "report", "Measures and results."}},
         .errors = merge_errors(),
         .example = halves + R"(local mesh, report = lissom.merge(half, bowl)
assert(mesh:is_closed() and mesh:genus() == 0)
assert(math.abs(report.joins[1].scale - 3) < 1e-6)
if not report.ok then print(report.verdict) end)"},
        {.name = "merger",
         .body = new_merger,
         .summary = "Like lissom.merge, but returns an object that keeps its preparation, so "
                    "that a moved key costs a fraction of the first merge.",
         .arguments = merge_arguments(),
         .named_arguments = true,
         .options = merge_parameters(false),
         .results = {{"lissom.Merger", "merger", "The merger, not solved yet."}},
         .errors = merge_errors(),
         .example = halves + R"(local merger = lissom.merger(half, bowl)
assert(merger:solve():is_closed()))"}};
}

}  // namespace lissom::lua
