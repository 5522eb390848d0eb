// lissom.merge and lissom.merger.
#include <algorithm>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/merge/merge_object.h"
#include "bindings/lua/merge/merge_options.h"
#include "kernel/merge/merge_once.h"
#include "kernel/merge/merge_within.h"

namespace lissom::lua {

Merger& MergerObject::merger() {
    if (!content) throw Error(ErrorCode::handle_removed, "the merger was closed; make a new one");
    return *content;
}

namespace {

MeshObject& mesh_of(Holder* holder) {
    return *Ref<PathObject>(holder)->mesh;
}

// Arguments of a call of lissom.merge or lissom.merger, as plain data.
struct MergeCall {
    std::span<const JoinSpec> joins;
    MeshObject* source;
    MeshObject* const* targets;
    std::size_t target_count;
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
    MergeCall asked{{}, nullptr, nullptr, 0};
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
    return asked;
}

std::shared_ptr<MergerObject> make_merger(const Call& call, const MergeCall& asked) {
    const MergeOptions options = merge_options(call);
    const MeshesOfJoins meshes = meshes_of(asked);
    require_named(asked.source, {meshes.source}, "source");
    for (std::size_t i = 0; i < asked.target_count; ++i) {
        require_named(asked.targets[i], meshes.targets, "target");
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
    return push_list(call, warnings, [&](const auto& warning) { call.push(warning); });
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
         .options = described_merge_options(true),
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
         .options = described_merge_options(false),
         .results = {{"lissom.Merger", "merger", "The merger, not solved yet."}},
         .errors = merge_errors(),
         .example = halves + R"(local merger = lissom.merger(half, bowl)
assert(merger:solve():is_closed()))"}};
}

}  // namespace lissom::lua
