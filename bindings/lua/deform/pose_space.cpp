// lissom.pose_space: blends of posed meshes.
#include "kernel/deform/poses/pose_space.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/core/push_list.h"
#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/io/poses/pose_targets.h"

namespace lissom::lua {
namespace {

struct PoseSpaceObject {
    static constexpr const char* kTypeName = "lissom.PoseSpace";

    explicit PoseSpaceObject(PoseSpace content) : space(std::move(content)) {}

    PoseSpace space;
    std::size_t charged_bytes = 0;

    std::size_t memory_bytes() const { return space.memory_bytes(); }
};

constexpr const char* kExpectedPoses =
    "poses by name expected: { smile = mesh, bent = { mesh, mesh } }";
constexpr const char* kExpectedWeights = "weights by name of pose expected: { smile = 0.5 }";

// One pose of a script, as plain data.
struct PoseSpec {
    const char* name;
    std::span<const MeshObject*> shapes;
};

const MeshObject* top_mesh(const Call& call, const char* path) {
    Holder* holder = find_holder(call.lua(), -1, MeshObject::kTypeName);
    if (!holder || !holder->object) call.reject(path, kExpectedPoses);
    return Ref<MeshObject>(holder).get();
}

// The shapes of the value on top of the stack, which stays.
std::span<const MeshObject*> top_shapes(const Call& call, const char* path) {
    lua_State* L = call.lua();
    const bool is_list = lua_type(L, -1) == LUA_TTABLE;
    const std::size_t count = is_list ? raw_length(L, -1) : 1;
    const int value = lua_gettop(L);
    const MeshObject** shapes = call.scratch<const MeshObject*>(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (is_list) {
            lua_rawgeti(L, value, index_of(i) + 1);
        } else {
            lua_pushvalue(L, value);
        }
        shapes[i] = top_mesh(call, path);
        lua_pop(L, 1);
    }
    return {shapes, count};
}

std::size_t count_entries(lua_State* L, int table) {
    std::size_t count = 0;
    lua_pushnil(L);
    while (lua_next(L, table) != 0) {
        lua_pop(L, 1);
        ++count;
    }
    return count;
}

// Reads each entry of a table with strings as keys: read(key, spec) with the value on top of the
// stack, which it may leave values above. The result is sorted by name.
template <typename Spec, typename Read>
std::span<Spec> read_by_name(const Call& call, const char* path, int table, const char* expected,
                             const Read& read) {
    lua_State* L = call.lua();
    const std::size_t count = count_entries(L, table);
    Spec* specs = call.scratch<Spec>(count);
    std::size_t filled = 0;
    lua_pushnil(L);
    while (lua_next(L, table) != 0) {
        luaL_checkstack(L, 8, "too many poses");
        const int key = lua_gettop(L) - 1;
        if (lua_type(L, key) != LUA_TSTRING) call.reject(path, expected);
        read(lua_tostring(L, key), specs[filled++]);
        // Memory of the specs stays below the key that `lua_next` wants on top.
        lua_pushvalue(L, key);
    }
    std::sort(specs, specs + count, [](const Spec& a, const Spec& b) {
        return std::string_view(a.name) < std::string_view(b.name);
    });
    return {specs, count};
}

std::span<PoseSpec> read_poses(const Call& call) {
    return read_by_name<PoseSpec>(call, "poses", call.stack_index("poses"), kExpectedPoses,
                                  [&](const char* name, PoseSpec& spec) {
                                      spec = {name, top_shapes(call, "poses")};
                                  });
}

std::vector<NamedPose> named_poses(std::span<const PoseSpec> specs) {
    std::vector<NamedPose> poses;
    for (const PoseSpec& spec : specs) {
        NamedPose& pose = poses.emplace_back();
        pose.name = spec.name;
        for (const MeshObject* shape : spec.shapes) pose.shapes.push_back(shape->mesh);
    }
    return poses;
}

int new_pose_space(Call& call) {
    const auto rest = call.object<MeshObject>("rest");
    const std::span<const PoseSpec> specs = read_poses(call);
    const auto result = call.create<PoseSpaceObject>();
    const bool done = call.attempt([&] {
        result.set(std::make_shared<PoseSpaceObject>(
            PoseSpace(rest->mesh, named_poses(specs), call.context())));
    });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

// One weight of a script, as plain data.
struct WeightSpec {
    const char* name;
    double weight;
};

std::span<const WeightSpec> read_weights(const Call& call, const char* path, int table) {
    return read_by_name<WeightSpec>(call, path, table, kExpectedWeights,
                                    [&](const char* name, WeightSpec& spec) {
                                        if (lua_type(call.lua(), -1) != LUA_TNUMBER)
                                            call.reject(path, kExpectedWeights);
                                        spec = {name, lua_tonumber(call.lua(), -1)};
                                    });
}

std::vector<PoseWeight> pose_weights(std::span<const WeightSpec> specs) {
    std::vector<PoseWeight> weights;
    for (const WeightSpec& spec : specs) weights.push_back({spec.name, spec.weight});
    return weights;
}

int blend(Call& call) {
    const auto self = call.self<PoseSpaceObject>();
    const std::span<const WeightSpec> specs =
        read_weights(call, "weights", call.stack_index("weights"));
    return new_mesh(call, [&] { return self->space.blend(pose_weights(specs), call.context()); });
}

constexpr const char* kExpectedCorrectives =
    "list of weights by name of pose expected: { { smile = 0.5 }, { smile = 1, bent = 1 } }";

std::span<const std::span<const WeightSpec>> read_correctives(const Call& call) {
    if (!call.has("correctives")) return {};
    lua_State* L = call.lua();
    const int list = call.stack_index("correctives");
    const std::size_t count = raw_length(L, list);
    auto* all = call.scratch<std::span<const WeightSpec>>(count);
    for (std::size_t i = 0; i < count; ++i) {
        luaL_checkstack(L, 8, "too many correctives");
        lua_rawgeti(L, list, index_of(i) + 1);
        if (lua_type(L, -1) != LUA_TTABLE) call.reject("correctives", kExpectedCorrectives);
        all[i] = read_weights(call, "correctives", lua_gettop(L));
    }
    return {all, count};
}

void push_target(Call& call, const PoseTarget& target) {
    lua_createtable(call.lua(), 0, 3);
    call.set_field("name", call.push(std::string_view(target.name)));
    call.set_field("corrective", call.push(target.is_corrective));
    lua_createtable(call.lua(), 0, 1);
    for (const PoseWeight& weight : target.at) {
        call.set_field(weight.name.c_str(), call.push(weight.weight));
    }
    lua_setfield(call.lua(), -2, "at");
}

int targets(Call& call) {
    const auto self = call.self<PoseSpaceObject>();
    const auto specs = read_correctives(call);
    const bool normals = call.boolean("normals");
    auto& report = call.hold<PoseTargetReport>();
    const int results = new_mesh(call, [&] {
        PoseTargetOptions options;
        options.normals = normals;
        for (const auto& at : specs) options.correctives.push_back(pose_weights(at));
        return pose_targets(self->space, options, &report, call.context());
    });
    if (results != 1) return results;
    lua_createtable(call.lua(), 0, 3);
    push_list(call, report.targets, [&](const PoseTarget& target) { push_target(call, target); });
    lua_setfield(call.lua(), -2, "targets");
    call.set_field("linear_error", call.push(report.linear_error));
    call.set_field("error", call.push(report.error));
    return 2;
}

int names(Call& call) {
    const auto self = call.self<PoseSpaceObject>();
    auto& list = call.hold<std::vector<std::string>>();
    if (!call.attempt_quick([&] { list = self->space.names(); })) return call.fail();
    push_list(call, list, [&](const std::string& name) { call.push(std::string_view(name)); });
    return 1;
}

int pose_space_text(Call& call) {
    char text[64];
    const auto self = call.self<PoseSpaceObject>();
    std::size_t count = 0;
    if (!call.attempt_quick([&] { count = self->space.names().size(); })) return call.fail();
    const int length = std::snprintf(text, sizeof text, "lissom.PoseSpace: %zu poses", count);
    return call.push(std::string_view(text, at(length)));
}

const std::string kBentBar = R"(local bar = lissom.shapes.bar{ across = 2, along = 20 }
local bent = lissom.deform(bar:copy(), {
    pin = bar:region("bottom"),
    handles = { { region = bar:region("top"), rotate = { axis = "z", angle = 90 } } },
})
)";

}  // namespace

std::vector<Function> pose_space_functions() {
    return {
        {.name = "pose_space",
         .body = new_pose_space,
         .summary =
             "Makes a space of poses: meshes with the vertices and faces of one at rest, which "
             "blend by rotations. Half of a bent arm is an arm bent by half, of its full length; "
             "details turn along. Turns beyond half a turn are kept if the surface leads to "
             "them.",
         .options = {object("rest", "lissom.Mesh", "The mesh at rest."),
                     table("poses",
                           "Meshes by name. A list of n meshes is a path from rest: mesh k is at "
                           "weight k / n.")},
         .results = {{"lissom.PoseSpace", "space", "Its poses are copies."}},
         .errors = {ErrorCode::mesh_empty, ErrorCode::invalid_argument,
                    ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example =
             kBentBar + R"(local space = lissom.pose_space{ rest = bar, poses = { bent = bent } }
local half = space:blend{ bent = 0.5 }
assert(math.abs(half:volume() / bar:volume() - 1) < 0.05))"}};
}

Type pose_space_type() {
    Type type{.name = "lissom.PoseSpace",
              .summary = "Posed meshes of one topology, and their blends."};
    type.operators = {{"__tostring", pose_space_text, "tostring(space)", "its size"}};
    type.methods = {
        {.name = "blend",
         .body = blend,
         .summary =
             "A blend of poses: rotations add up as rotation vectors, stretches as they are, and "
             "the surface is fitted to both. Vertices that no pose moves stay.",
         .arguments = {table("weights",
                             "Weights of poses by name: 0 is rest, 1 the pose, others go beyond. "
                             "Poses that are left out have 0.")},
         .results = {{"lissom.Mesh", "mesh",
                      "A new mesh: rest with the blended shape. Custom normals, tangents and morph "
                      "targets turn along."}},
         .errors = {ErrorCode::not_finite, ErrorCode::out_of_range, ErrorCode::memory_limit,
                    ErrorCode::cancelled},
         .example = kBentBar + R"(local space = lissom.pose_space{
    rest = bar,
    poses = { bent = bent, thick = bar:copy():transform{ scale = { 1.5, 1, 1.5 } } },
}
local both = space:blend{ bent = 1, thick = 0.5 }
local more = space:blend{ bent = 1.2 }
assert(both:volume() > 1.2 * bar:volume() and more:volume() < 1.1 * bar:volume()))"},
        {.name = "targets",
         .body = targets,
         .summary =
             "The mesh at rest with a morph target for each pose, for engines that blend "
             "linearly, and correctives, which take back the error of that at chosen weights and "
             "at the meshes of a path. mesh:save writes them to .glb and .gltf. The weight of a "
             "corrective is the product over its poses, with weight w and at a, of (w - 1) / (a - "
             "1) if "
             "a is above 1, or w above an a between 0 and 1, else of w / a; never below 0.",
         .options = {table("correctives",
                           "A list of weights by name of pose, as for blend: halves, pairs.")
                         .optional("none"),
                     boolean("normals",
                             "Gives a mesh without normals those of its surface, so "
                             "that light follows.")
                         .defaults(true)},
         .results = {{"lissom.Mesh", "mesh",
                      "The rest shape with its targets. Morph targets that it had are left out."},
                     {"table", "report",
                      "`targets`, a list in the order of the mesh's targets: `name`, `corrective` "
                      "and `at`, its weights; `linear_error` and `error`, the greatest distances "
                      "of a vertex from the blend, without and with correctives, over tenths of "
                      "the way from rest to each target."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::unsupported, ErrorCode::not_finite,
                    ErrorCode::out_of_range, ErrorCode::memory_limit, ErrorCode::cancelled},
         .example =
             kBentBar + R"(local space = lissom.pose_space{ rest = bar, poses = { bent = bent } }
local mesh, report = space:targets{ correctives = { { bent = 0.5 } } }
assert(report.targets[2].name == "bent=0.5" and report.error < 0.4 * report.linear_error)
local path = os.tmpname() .. ".glb"
mesh:save(path)
os.remove(path))"},
        {.name = "names",
         .body = names,
         .summary = "The names of the poses, in alphabetical order.",
         .results = {{"string[]", "names", "The names."}},
         .example =
             kBentBar + R"(local space = lissom.pose_space{ rest = bar, poses = { bent = bent } }
assert(space:names()[1] == "bent"))"}};
    return type;
}

}  // namespace lissom::lua
