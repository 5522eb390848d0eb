// Exports of a deformation for engines: deformer:save_basis, deformer:bake and deformer:skin.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_object.h"
#include "bindings/lua/deform/pose_object.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/io/basis_file.h"
#include "kernel/io/morph_baker.h"
#include "kernel/io/skin_baker.h"
#include "kernel/io/vertex_texture.h"
#include "kernel/mesh/measure/directions.h"

namespace lissom::lua {
namespace {

// A handle is called as the named region of the mesh that has its vertices.
std::string region_name(const Mesh& mesh, const Region& handle) {
    for (const auto& [name, region] : mesh.regions()) {
        if (region == handle) return name;
    }
    return "";
}

std::vector<std::string> handle_names(const Call& call, const DeformObject& edit,
                                      const Deformer& deformer) {
    if (call.has("names")) {
        const auto given = call.strings("names");
        return {given.begin(), given.end()};
    }
    std::vector<std::string> names;
    for (const HandleId id : deformer.handles()) {
        names.push_back(region_name(edit.mesh->mesh, deformer.handle(id).region));
    }
    return names;
}

// ---- Poses of a script

constexpr int kMaximumFrames = 10000;

// The state of a deformation and its mesh, to be restored.
class BakedState {
  public:
    explicit BakedState(DeformObject& edit)
        : mesh_(edit.mesh->mesh),
          revision_(edit.mesh->mesh.revision()),
          snapshot_(edit.deformer().snapshot()) {}

    const Mesh& mesh() const { return mesh_; }

    void restore(Deformer& deformer) const { deformer.restore(snapshot_); }

    void restore_mesh(MeshObject& object) const {
        Mesh& mesh = object.mesh;
        const bool same_faces = mesh.shared_topology() == mesh_.shared_topology();
        if (object.closed || !same_faces || mesh.revision() == revision_) return;
        mesh.set_positions({mesh_.positions().begin(), mesh_.positions().end()});
        for (const Attribute& old : mesh_.attributes().all()) {
            Attribute* now = is_direction(old) ? mesh.attributes().find(old.name) : nullptr;
            if (now && now->values.size() == old.values.size()) now->values = old.values;
        }
        object.changed();
    }

  private:
    Mesh mesh_;
    std::uint64_t revision_;
    DeformSnapshot snapshot_;
};

// Everything that lives as long as one call of bake, bake_texture, skin or save_basis.
struct Baking {
    explicit Baking(std::shared_ptr<DeformObject> owner)
        : edit(std::move(owner)), before(*edit), shape(before.mesh()) {
        apply_rest(edit->deformer(), shape);
    }

    void bake_morphs(BakeOptions options, const Context& context) {
        morphs = std::make_unique<MorphBaker>(shape, edit->deformer().region(), std::move(options),
                                              context);
    }

    void bake_skin(const SkinOptions& options, const Context& context) {
        skin = std::make_unique<SkinBaker>(shape, edit->deformer().region(), options, context);
    }

    void bake_texture(const Context& context) {
        texture = std::make_unique<VertexTextureBaker>(shape, context);
    }

    void make_basis(std::span<const std::string> names, const Context& context) {
        basis = std::make_unique<EngineBasis>(make_engine_basis(edit->deformer(), names, context));
    }

    void add_pose(double time, bool is_preview, const Context& context) {
        Deformer& deformer = edit->deformer();
        if (basis) {
            keys.push_back(make_basis_key(deformer, context));
            return;
        }
        deformer.solve(is_preview ? FrameQuality::preview : FrameQuality::full, context);
        deformer.apply_to(shape);
        if (texture) texture->add(time, shape);
        if (morphs) morphs->add(time, shape);
        if (skin) skin->add(time, shape);
    }

    void pose_at_time(double time, Easing easing) const {
        set_pose(edit->deformer(), pose_at(path, time, easing));
    }

    // Whatever the script did to the deformation in the meantime.
    void restore() const {
        if (edit->content) before.restore(*edit->content);
        before.restore_mesh(*edit->mesh);
    }

    std::shared_ptr<DeformObject> edit;
    BakedState before;
    Mesh shape;
    // One of the four.
    std::unique_ptr<MorphBaker> morphs;
    std::unique_ptr<VertexTextureBaker> texture;
    std::unique_ptr<SkinBaker> skin;
    std::unique_ptr<EngineBasis> basis;
    std::vector<BasisKey> keys;
    // Key poses of the script, none if a function of its makes the poses.
    std::vector<PoseKey> path;
};

// Arguments of a call of bake, as plain data.
struct BakeRequest {
    Call* call;
    Baking* baking;
    const double* times;
    int count;
    bool is_preview;
    bool done;
    std::span<const PoseKeySpec> keys = {};
    Easing easing = Easing::linear;

    // Reads `pose` or `keys` as well.
    static BakeRequest read_path(Call& call, const char* function) {
        if (call.has("pose") == call.has("keys")) {
            call.raise(lua_pushfstring(call.lua(), "'%s' needs either 'pose' or 'keys'", function));
        }
        const auto keys = read_pose_keys(call);
        BakeRequest request = read(call, function, keys.empty() ? kNone : keys.back().time);
        request.keys = keys;
        request.easing = call.choice<Easing>("easing");
        return request;
    }

    // Without duration and times, the duration is `length` if that is a number.
    static BakeRequest read(Call& call, const char* function, double length = kNone) {
        const bool has_times = call.has("times"), has_duration = call.has("duration");
        const bool has_length = !has_times && !has_duration && length >= 0.0;
        if (has_times == has_duration && !has_length) {
            // Not a std::string: the error leaves its destructor out.
            call.raise(
                lua_pushfstring(call.lua(), "'%s' needs either 'duration' or 'times'", function));
        }
        BakeRequest request{&call, nullptr, nullptr, 0, call.boolean("preview"), false};
        if (has_times) {
            const auto times = call.numbers("times");
            request.times = times.data();
            request.count = count_of(times);
            return request;
        }
        const double duration = has_length ? length : call.number("duration");
        const double fps = call.number("fps"), frames = std::round(duration * fps);
        if (!(frames < kMaximumFrames)) call.reject("duration", "that is more than 10000 frames");
        request.count = static_cast<int>(frames) + 1;
        auto* times = call.scratch<double>(at(request.count));
        for (int i = 0; i < request.count; ++i) times[i] = i / fps;
        request.times = times;
        return request;
    }
};

// Runs inside lua_pcall, so that handles and mesh are put back whatever the script's function does:
// (BakeRequest*, pose).
int bake_frames(lua_State* L) {
    auto& request = *static_cast<BakeRequest*>(lua_touserdata(L, 1));
    Call& call = *request.call;
    for (int i = 0; i < request.count; ++i) {
        const double time = request.times[i];
        Baking* const baking = request.baking;
        if (!call.attempt_quick([&] { baking->before.restore(baking->edit->deformer()); })) {
            return 0;
        }
        if (request.keys.empty()) {
            lua_pushvalue(L, 2);
            lua_pushnumber(L, time);
            lua_pushinteger(L, i + 1);
            lua_call(L, 2, 0);
        } else if (!call.attempt_quick([&] { baking->pose_at_time(time, request.easing); })) {
            return 0;
        }
        if (!call.attempt([&] { baking->add_pose(time, request.is_preview, call.context()); })) {
            return 0;
        }
    }
    request.done = true;
    return 0;
}

// Calls the function of the script for each frame; raises its error again. Returns false after an
// error of ours.
bool run_frames(Call& call, BakeRequest& request) {
    lua_State* L = call.lua();
    lua_pushcfunction(L, bake_frames);
    lua_pushlightuserdata(L, &request);
    if (request.keys.empty()) {
        lua_pushvalue(L, call.stack_index("pose"));
    } else {
        lua_pushnil(L);
    }
    const int status = lua_pcall(L, 2, 0, 0);
    const bool restored = call.attempt_quick([&] { request.baking->restore(); });
    if (status != 0) lua_error(L);
    return request.done && restored;
}

// ---- deformer:save_basis

void read_basis_keys(Call& call, BakeRequest& request) {
    if (call.has("pose") != call.has("keys")) {
        call.raise("key poses need both 'pose' and 'keys'");
    }
    if (!call.has("keys")) return;
    const auto keys = call.numbers("keys");
    request.times = keys.data();
    request.count = count_of(keys);
}

int save_basis_file(Call& call) {
    const auto edit = call.self<DeformObject>();
    const char* path = call.string("path");
    BakeRequest request{&call, nullptr, nullptr, 0, false, false};
    read_basis_keys(call, request);
    auto& baking = call.hold<std::unique_ptr<Baking>>();
    const bool began = call.attempt([&] {
        const std::vector<std::string> names = handle_names(call, *edit, edit->deformer());
        baking = std::make_unique<Baking>(edit.share());
        baking->make_basis(names, call.context());
    });
    request.baking = baking.get();
    if (!began || (request.count > 0 && !run_frames(call, request))) return call.fail();
    const bool done = call.attempt([&] {
        set_keys(*baking->basis, baking->keys);
        save_basis(*baking->basis, call.file(path, FileUse::write), call.context());
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_argument();
}

// ---- deformer:bake

int bake(Call& call) {
    const auto edit = call.self<DeformObject>();
    BakeRequest request = BakeRequest::read_path(call, "bake");
    const char* name = call.string("name");
    const auto interpolation = call.choice<KeyInterpolation>("interpolation");
    const bool normals = call.boolean("normals");
    const double tolerance = call.number("tolerance");
    BakeReport report;
    auto& baking = call.hold<std::unique_ptr<Baking>>();
    const auto result = call.create<MeshObject>();
    const bool began = call.attempt([&] {
        baking = std::make_unique<Baking>(edit.share());
        baking->path = pose_keys(request.keys);
        baking->bake_morphs(BakeOptions{name, interpolation, normals, tolerance}, call.context());
    });
    if (!began) return call.fail();

    request.baking = baking.get();
    if (!run_frames(call, request)) return call.fail();
    const bool done = call.attempt(
        [&] { result.set(std::make_shared<MeshObject>(baking->morphs->finish(&report))); });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    lua_createtable(call.lua(), 0, 4);
    call.set_field("keys", call.push_count(at(report.keys)));
    call.set_field("targets", call.push_count(at(report.targets)));
    call.set_field("max_error", call.push(report.max_error));
    call.set_field("max_direction_error", call.push(report.max_direction_error));
    return 2;
}

// ---- deformer:bake_texture

VertexTextureFiles files_beside(Call& call, const char* path) {
    const std::string stem = path;
    const auto file = [&](const char* ending) {
        return call.file((stem + ending).c_str(), FileUse::write);
    };
    return {file(".glb"), file(".json"), file("_positions.png"), file("_normals.png")};
}

int bake_texture(Call& call) {
    const auto edit = call.self<DeformObject>();
    const char* path = call.string("path");
    BakeRequest request = BakeRequest::read_path(call, "bake_texture");
    auto& baking = call.hold<std::unique_ptr<Baking>>();
    const bool began = call.attempt([&] {
        baking = std::make_unique<Baking>(edit.share());
        baking->path = pose_keys(request.keys);
        baking->bake_texture(call.context());
    });
    if (!began) return call.fail();
    request.baking = baking.get();
    if (!run_frames(call, request)) return call.fail();
    Index width = 0, height = 0;
    double max_error = 0.0, max_normal_error = 0.0;
    const bool done = call.attempt([&] {
        const VertexTexture texture = baking->texture->finish();
        save_vertex_texture(texture, files_beside(call, path), call.context());
        width = texture.width;
        height = texture.height;
        max_error = texture.max_error;
        max_normal_error = texture.max_normal_error;
    });
    if (!done) return call.fail();
    lua_createtable(call.lua(), 0, 5);
    call.set_field("frames", call.push_count(at(request.count)));
    call.set_field("width", call.push_count(at(width)));
    call.set_field("height", call.push_count(at(height)));
    call.set_field("max_error", call.push(max_error));
    call.set_field("max_normal_error", call.push(max_normal_error));
    return 1;
}

// ---- deformer:skin

// Poses to fit a skin to without a path of the handles: each is turned about three axes, both ways.
void add_turned_poses(Baking& baking, double angle, bool is_preview, const Context& context) {
    Deformer& deformer = baking.edit->deformer();
    double time = 0.0;
    for (const HandleId handle : deformer.handles()) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                baking.before.restore(deformer);
                deformer.rotate(handle, Vec3::Unit(axis), sign * angle);
                baking.add_pose(time, is_preview, context);
                time += 1.0;
            }
        }
    }
}

bool add_skin_poses(Call& call, BakeRequest& request, Baking& baking) {
    if (call.has("pose")) {
        request.baking = &baking;
        return run_frames(call, request);
    }
    const double angle = call.number("angle") * kPi / 180.0;
    const bool is_preview = call.boolean("preview");
    const bool added =
        call.attempt([&] { add_turned_poses(baking, angle, is_preview, call.context()); });
    return call.attempt_quick([&] { baking.restore(); }) && added;
}

int skin(Call& call) {
    const auto edit = call.self<DeformObject>();
    SkinOptions options;
    options.joints = call.integer("joints");
    options.influences = call.integer("influences");
    const char* name = call.string("name");
    const bool has_path = call.has("pose");
    if (!has_path && (call.has("times") || call.has("duration"))) {
        call.raise("'duration' and 'times' are of a 'pose'; give the function too");
    }
    // It takes memory from the stack, and so goes before the result.
    BakeRequest request{};
    if (has_path) request = BakeRequest::read(call, "skin");
    auto& baking = call.hold<std::unique_ptr<Baking>>();
    auto& skinned = call.hold<std::unique_ptr<SkinnedMesh>>();
    const auto result = call.create<MeshObject>();
    const bool began = call.attempt([&] {
        baking = std::make_unique<Baking>(edit.share());
        baking->bake_skin(options, call.context());
    });
    if (!began || !add_skin_poses(call, request, *baking)) return call.fail();
    const bool done = call.attempt([&] {
        skinned = std::make_unique<SkinnedMesh>(baking->skin->finish(has_path ? name : ""));
        result.set(std::make_shared<MeshObject>(skinned->mesh));
    });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    lua_createtable(call.lua(), 0, 3);
    call.set_field("joints", call.push_count(at(skinned->joint_count)));
    call.set_field("max_error", call.push(skinned->max_error));
    call.set_field("rms_error", call.push(skinned->rms_error));
    return 2;
}

Parameter duration_option() {
    return number("duration", "Length of the animation; it starts at 0 and has a frame at its end.")
        .at_least(0)
        .in("seconds");
}

// Errors of functions that make poses of a deformation.
const std::vector<ErrorCode> kPoseErrors = {
    ErrorCode::unconstrained,  ErrorCode::zero_area,         ErrorCode::not_positive_definite,
    ErrorCode::memory_limit,   ErrorCode::topology_mismatch, ErrorCode::invalid_argument,
    ErrorCode::handle_removed, ErrorCode::unsupported,       ErrorCode::singular_transform,
    ErrorCode::cancelled};

}  // namespace

std::vector<Function> deform_engine_methods() {
    return {
        {.name = "save_basis",
         .body = save_basis_file,
         .summary =
             "Writes the basis to a file for a program without a solver: 4 floats a vertex and "
             "handle, relative to the middle of the region. bindings/engine/lissom_basis.h, one C "
             "header, describes the file and computes the result of preview. With key poses, 3 "
             "floats a vertex and key more, it computes the result of solve at each key, and "
             "blends "
             "between them by the turns, places and stretches of the handles; beyond the range of "
             "the keys the offsets stay. Turns are told apart up to half a turn. Handles and last "
             "result are restored afterwards.",
         .arguments = {string("path", "The file.")},
         .options = {strings("names",
                             "Names of the handles, in the order of deformer:handles(): a program "
                             "finds them by these.")
                         .optional("that of the mesh's region with the same vertices"),
                     function("pose", "fun(key: number, number: integer)",
                              "Moves handles to a key pose from their present place; called with "
                              "each number of 'keys', and with its place in the list from 1.")
                         .optional("there are no key poses"),
                     numbers("keys",
                             "Numbers of the key poses, at most 256 different poses; their meaning "
                             "is that of 'pose'.")
                         .optional("there are no key poses")},
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = {ErrorCode::unconstrained, ErrorCode::zero_area,
                    ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                    ErrorCode::topology_mismatch, ErrorCode::invalid_argument,
                    ErrorCode::unsupported, ErrorCode::not_finite, ErrorCode::file_write_failed,
                    ErrorCode::file_is_directory, ErrorCode::handle_removed, ErrorCode::cancelled},
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
deformer:add_handle(bar:region("top"))
local path = os.tmpname()
assert(deformer:save_basis(path, { names = { "foot", "head" } }))
local top = deformer:handles()[2]
deformer:save_basis(path, { keys = { -90, -45, 45, 90 }, pose = function(angle)
    top:set{ rotate = { axis = "z", angle = angle } }
end })
os.remove(path))"},
        {.name = "bake",
         .body = bake,
         .summary =
             "Makes an animation of a sequence of poses: a new mesh with a morph target for each "
             "different shape, which mesh:save writes as .glb or .gltf and any viewer of such "
             "files plays. For each frame the handles start from their present place, the "
             "function moves them, and the deformation is solved. Handles, mesh and last result "
             "are restored afterwards, even if the function fails.",
         .options =
             {function("pose", "fun(time: number, frame: integer)",
                       "Moves handles; called for each frame with its time and its number from "
                       "1.")
                  .optional("keys is given"),
              keys_option(), easing_option(),
              number("duration",
                     "Length of the animation; it starts at 0 and has a frame at its "
                     "end.")
                  .at_least(0)
                  .in("seconds")
                  .optional("times are given"),
              number("fps", "Frames a second.").above(0).defaults(24.0),
              numbers("times", "Time of each frame in seconds, ascending, instead of a duration.")
                  .optional("duration is given"),
              choice("interpolation", {"linear", "step"},
                     "Between frames the surface moves along straight lines, or stays and then "
                     "jumps.")
                  .defaults("linear"),
              boolean("preview", "Poses as preview makes them: the first system only.")
                  .defaults(false),
              boolean("normals",
                      "Gives a mesh without normals those of its surface, so that light "
                      "follows the motion.")
                  .defaults(true),
              number("tolerance",
                     "Greatest distance of a vertex from its pose. Above 0 the targets are the "
                     "principal components of the poses, as few as keep it and turn normals by "
                     "about 1 degree at most: files become several times smaller. At 0 each "
                     "different pose is a target.")
                  .at_least(0)
                  .in("mesh units")
                  .defaults(0.0),
              string("name", "Name of the animation.").defaults("deformation")},
         .results =
             {{"lissom.Mesh", "mesh", "The rest shape with its targets and the animation."},
              {"table", "report",
               "`keys` and `targets`, their numbers; `max_error`, the greatest distance of a "
               "vertex from its pose in mesh units; `max_direction_error`, that of a unit "
               "normal or tangent."}},
         .errors = kPoseErrors,
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
local wave = deformer:bake{ duration = 1, fps = 8, pose = function(time)
    top:set{ rotate = { axis = "z", angle = 60 * math.sin(2 * math.pi * time) } }
end }
local path = os.tmpname() .. ".glb"
assert(wave:save(path))
os.remove(path))"},
        {.name = "bake_texture",
         .body = bake_texture,
         .summary =
             "Writes a sequence of poses as a vertex animation texture: PATH_positions.png and "
             "PATH_normals.png with 16 bits a channel, a texel for each vertex and frame; "
             "PATH.glb, "
             "the mesh at rest, whose last texture coordinates are the texel of each vertex in the "
             "first frame; and PATH.json with the bounds, the times and `frame_step`, by which v "
             "goes on from frame to frame. The frames of a vertex stand below one another: a "
             "bilinear sampler blends between them. Pictures must be read as linear, without mip "
             "maps. Handles, mesh and last result are restored afterwards.",
         .arguments = {string("path", "The files without their endings.")},
         .options = {function("pose", "fun(time: number, frame: integer)",
                              "Moves handles; called for each frame with its time and its number "
                              "from 1.")
                         .optional("keys is given"),
                     keys_option(), easing_option(), duration_option().optional("times are given"),
                     number("fps", "Frames a second.").above(0).defaults(24.0),
                     numbers("times",
                             "Time of each frame in seconds, ascending, instead of a duration.")
                         .optional("duration is given"),
                     boolean("preview", "Poses as preview makes them: the first system only.")
                         .defaults(false)},
         .results = {{"table", "report",
                      "`frames`; `width` and `height` of the pictures; `max_error`, the greatest "
                      "distance of a vertex from its pose by 16 bits, in mesh units; "
                      "`max_normal_error`, that of a unit normal."}},
         .errors = {ErrorCode::unconstrained, ErrorCode::zero_area,
                    ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                    ErrorCode::topology_mismatch, ErrorCode::invalid_argument,
                    ErrorCode::handle_removed, ErrorCode::unsupported,
                    ErrorCode::singular_transform, ErrorCode::file_too_large,
                    ErrorCode::file_write_failed, ErrorCode::file_is_directory,
                    ErrorCode::cancelled},
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
local path = os.tmpname()
local report = deformer:bake_texture(path, { duration = 1, fps = 8, pose = function(time)
    top:set{ rotate = { axis = "z", angle = 60 * time } }
end })
assert(report.max_error < 1e-4 * bar:size())
for _, ending in ipairs{ "", ".glb", ".json", "_positions.png", "_normals.png" } do
    os.remove(path .. ending)
end)"},
        {.name = "skin",
         .body = skin,
         .summary =
             "Makes an ordinary skinned mesh of the deformation: joints that move rigidly, and "
             "weights of each vertex for a few of them, fitted to poses by least squares (Le and "
             "Deng 2012). With a function, the poses are the frames of its path and the joints "
             "are animated along it; without, each handle is turned about three axes. mesh:save "
             "writes the skin as .glb or .gltf. Handles, mesh and last result are restored "
             "afterwards.",
         .options =
             {integer("joints",
                      "Joints of the skin. One of them stays if the region is a part of "
                      "the mesh.")
                  .between(1, 250)
                  .defaults(8),
              integer("influences", "Joints that a vertex may follow.").between(1, 8).defaults(4),
              function("pose", "fun(time: number, frame: integer)",
                       "Moves handles; called for each frame with its time and its number from "
                       "1.")
                  .optional("each handle is turned by the angle"),
              duration_option().optional("times are given"),
              number("fps", "Frames a second.").above(0).defaults(24.0),
              numbers("times", "Time of each frame in seconds, ascending, instead of a duration.")
                  .optional("duration is given"),
              number("angle", "Turn of each handle in the poses without a function.")
                  .between(1, 180)
                  .defaults(45.0)
                  .in("degrees"),
              boolean("preview", "Poses as preview makes them: the first system only.")
                  .defaults(false),
              string("name", "Name of the animation.").defaults("deformation")},
         .results = {{"lissom.Mesh", "mesh",
                      "The rest shape with the attributes \"joints\" and \"weights\", its "
                      "skeleton, and the animation if there is a path."},
                     {"table", "report",
                      "`joints`, their number; `max_error` and `rms_error`, distances of the "
                      "skinned vertices from the deformation's over all poses, in mesh units."}},
         .errors = kPoseErrors,
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
local skinned, report = deformer:skin{ joints = 6, duration = 1, fps = 8, pose = function(time)
    top:set{ rotate = { axis = "z", angle = 60 * time } }
end }
assert(report.max_error < 0.05 * bar:size())
local path = os.tmpname() .. ".glb"
assert(skinned:save(path))
os.remove(path))"}};
}

}  // namespace lissom::lua
