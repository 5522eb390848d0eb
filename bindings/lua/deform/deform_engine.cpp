// Exports of a deformation for engines: deformer:save_basis and deformer:bake.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_object.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/io/basis_file.h"
#include "kernel/io/morph_baker.h"
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

int save_basis_file(Call& call) {
    const auto edit = call.self<DeformObject>();
    const char* path = call.string("path");
    const bool done = call.attempt([&] {
        Deformer& deformer = edit->deformer();
        const std::vector<std::string> names = handle_names(call, *edit, deformer);
        save_basis(make_engine_basis(deformer, names, call.context()),
                   call.file(path, FileUse::write), call.context());
    });
    if (!done) return call.fail();
    call.charge(edit);
    return call.push_argument();
}

// ---- deformer:bake

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

// Everything that lives as long as one call of bake.
struct Baking {
    Baking(std::shared_ptr<DeformObject> owner, BakeOptions options, const Context& context)
        : edit(std::move(owner)), before(*edit), shape(before.mesh()) {
        apply_rest(edit->deformer(), shape);
        baker = std::make_unique<MorphBaker>(shape, edit->deformer().region(), std::move(options),
                                             context);
    }

    void add_pose(double time, bool is_preview, const Context& context) {
        Deformer& deformer = edit->deformer();
        deformer.solve(is_preview ? FrameQuality::preview : FrameQuality::full, context);
        deformer.apply_to(shape);
        baker->add(time, shape);
    }

    // Whatever the script did to the deformation in the meantime.
    void restore() const {
        if (edit->content) before.restore(*edit->content);
        before.restore_mesh(*edit->mesh);
    }

    std::shared_ptr<DeformObject> edit;
    BakedState before;
    Mesh shape;
    std::unique_ptr<MorphBaker> baker;
};

// Arguments of a call of bake, as plain data.
struct BakeRequest {
    Call* call;
    Baking* baking;
    const double* times;
    int count;
    bool is_preview;
    bool done;

    static BakeRequest read(Call& call) {
        const bool has_times = call.has("times"), has_duration = call.has("duration");
        if (has_times == has_duration) call.raise("'bake' needs either 'duration' or 'times'");
        BakeRequest request{&call, nullptr, nullptr, 0, call.boolean("preview"), false};
        if (has_times) {
            const auto times = call.numbers("times");
            request.times = times.data();
            request.count = count_of(times);
            return request;
        }
        const double fps = call.number("fps"), frames = std::round(call.number("duration") * fps);
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
        lua_pushvalue(L, 2);
        lua_pushnumber(L, time);
        lua_pushinteger(L, i + 1);
        lua_call(L, 2, 0);
        if (!call.attempt([&] { baking->add_pose(time, request.is_preview, call.context()); })) {
            return 0;
        }
    }
    request.done = true;
    return 0;
}

int bake(Call& call) {
    const auto edit = call.self<DeformObject>();
    lua_State* L = call.lua();
    BakeRequest request = BakeRequest::read(call);
    const char* name = call.string("name");
    const auto interpolation = call.choice<KeyInterpolation>("interpolation");
    const bool normals = call.boolean("normals");
    auto& baking = call.hold<std::unique_ptr<Baking>>();
    const auto result = call.create<MeshObject>();
    const bool began = call.attempt([&] {
        baking = std::make_unique<Baking>(edit.share(), BakeOptions{name, interpolation, normals},
                                          call.context());
    });
    if (!began) return call.fail();

    request.baking = baking.get();
    lua_pushcfunction(L, bake_frames);
    lua_pushlightuserdata(L, &request);
    lua_pushvalue(L, call.stack_index("pose"));
    const int status = lua_pcall(L, 2, 0, 0);
    const bool restored = call.attempt_quick([&] { baking->restore(); });
    if (status != 0) return lua_error(L);
    if (!request.done || !restored) return call.fail();
    const bool done =
        call.attempt([&] { result.set(std::make_shared<MeshObject>(baking->baker->finish())); });
    if (!done) return call.fail();
    call.remember(result.get());
    call.charge(result);
    return 1;
}

}  // namespace

std::vector<Function> deform_engine_methods() {
    return {
        {.name = "save_basis",
         .body = save_basis_file,
         .summary =
             "Writes the basis to a file for a program without a solver: 4 floats a vertex and "
             "handle, relative to the middle of the region. bindings/engine/lissom_basis.h, one C "
             "header, describes the file and computes the result of preview.",
         .arguments = {string("path", "The file.")},
         .options = {strings("names",
                             "Names of the handles, in the order of deformer:handles(): a program "
                             "finds them by these.")
                         .optional("that of the mesh's region with the same vertices")},
         .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
         .errors = {ErrorCode::unconstrained, ErrorCode::zero_area,
                    ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                    ErrorCode::topology_mismatch, ErrorCode::invalid_argument,
                    ErrorCode::unsupported, ErrorCode::not_finite, ErrorCode::file_write_failed,
                    ErrorCode::file_is_directory, ErrorCode::cancelled},
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
deformer:add_handle(bar:region("top"))
local path = os.tmpname()
assert(deformer:save_basis(path, { names = { "foot", "head" } }))
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
                       "1."),
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
              string("name", "Name of the animation.").defaults("deformation")},
         .results = {{"lissom.Mesh", "mesh", "The rest shape with its targets and the animation."}},
         .errors = {ErrorCode::unconstrained, ErrorCode::zero_area,
                    ErrorCode::not_positive_definite, ErrorCode::memory_limit,
                    ErrorCode::topology_mismatch, ErrorCode::invalid_argument,
                    ErrorCode::handle_removed, ErrorCode::unsupported, ErrorCode::cancelled},
         .example = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
local wave = deformer:bake{ duration = 1, fps = 8, pose = function(time)
    top:set{ rotate = { axis = "z", angle = 60 * math.sin(2 * math.pi * time) } }
end }
local path = os.tmpname() .. ".glb"
assert(wave:save(path))
os.remove(path))"}};
}

}  // namespace lissom::lua
