// lissom.Bones: chains of bones in a deformer, turned by hand or towards a point.
#include "kernel/deform/bones/bones.h"
#include "kernel/deform/bones/framed_curve.h"

#include <cstdio>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_object.h"

namespace lissom::lua {
namespace {

constexpr double kDegree = kPi / 180.0;

struct BonesObject {
    static constexpr const char* kTypeName = "lissom.Bones";

    const Bones& bones() const { return bones_with(edit->deformer(), first); }

    std::shared_ptr<DeformObject> edit;
    /// The first handle of the chain, which names it.
    HandleId first;
};

int add_bones_of(Call& call) {
    const auto edit = call.self<DeformObject>();
    const std::span<const Vec3> joints = call.points("joints");
    const std::span<const double> limits =
        call.has("limits") ? call.numbers("limits") : std::span<const double>{};
    const double share = call.number("share"), radius = call.number("radius");
    const auto result = call.create<BonesObject>();
    const bool done = call.attempt([&] {
        Deformer& deformer = edit->deformer();
        BonesOptions options;
        options.joints.assign(joints.begin(), joints.end());
        for (const double limit : limits) options.limits.push_back(limit * kDegree);
        options.share = share;
        options.radius = radius;
        call.reserve(edit, handle_bytes(at(edit->mesh->mesh.vertex_count())));
        const Bones made = add_bones(deformer, edit->mesh->mesh, options, call.context());
        result.set(std::make_shared<BonesObject>(BonesObject{edit.share(), made.handles.front()}));
    });
    if (!done) return call.fail();
    call.charge(edit);
    return 1;
}

int bones_in(Call& call) {
    const auto edit = call.self<DeformObject>();
    auto& chains = call.hold<std::vector<Bones>>();
    if (!call.attempt_quick([&] { chains = bones_of(edit->deformer()); })) return call.fail();
    lua_createtable(call.lua(), count_of(chains), 0);
    for (Index i = 0; i < count_of(chains); ++i) {
        const auto result = call.create<BonesObject>();
        const bool done = call.attempt_quick([&] {
            result.set(std::make_shared<BonesObject>(
                BonesObject{edit.share(), chains[at(i)].handles.front()}));
        });
        if (!done) return call.fail();
        lua_rawseti(call.lua(), -2, i + 1);
    }
    return 1;
}

// Changes the chain of a call and moves the handles along.
template <typename Work>
bool change_chain(Call& call, const Work& work) {
    const auto self = call.self<BonesObject>();
    return call.attempt_quick([&] {
        Deformer& deformer = self->edit->deformer();
        const Bones& bones = self->bones();
        BoneChain chain = chain_of(deformer, bones);
        work(chain);
        set_bones(deformer, bones, chain);
    });
}

int turn_bone(Call& call) {
    const Index bone = call.id("bone");
    const Vec3 axis = call.vector("axis");
    const double angle = call.number("angle") * kDegree;
    const bool done = change_chain(call, [&](BoneChain& chain) { chain.turn(bone, axis, angle); });
    return done ? call.push_argument() : call.fail();
}

int move_bones(Call& call) {
    const Vec3 place = call.vector("base");
    const bool done = change_chain(call, [&](BoneChain& chain) { chain.set_base(place); });
    return done ? call.push_argument() : call.fail();
}

int reach_with_bones(Call& call) {
    const Vec3 target = call.vector("target");
    ReachOptions options;
    if (call.has("axis")) options.axis = call.vector("axis");
    options.rounds = call.integer("rounds");
    double off = 0.0;
    const bool done =
        change_chain(call, [&](BoneChain& chain) { off = chain.reach(target, options); });
    return done ? call.push(off) : call.fail();
}

int follow_with_bones(Call& call) {
    const auto self = call.self<BonesObject>();
    const std::span<const Vec3> points = call.points("points");
    BonesFollowOptions options;
    options.stretch = call.boolean("stretch");
    options.twist = call.number("twist") * kDegree;
    const bool done = call.attempt_quick(
        [&] { follow(self->edit->deformer(), self->bones(), FramedCurve(points), options); });
    return done ? call.push_argument() : call.fail();
}

int reset_bones(Call& call) {
    const auto self = call.self<BonesObject>();
    const bool done = call.attempt_quick([&] {
        const Bones& bones = self->bones();
        set_bones(self->edit->deformer(), bones, BoneChain(bones.joints, bones.limits));
    });
    return done ? call.push_argument() : call.fail();
}

int bone_joints(Call& call) {
    auto& joints = call.hold<std::vector<Vec3>>();
    const auto self = call.self<BonesObject>();
    const bool done =
        call.attempt_quick([&] { joints = joints_of(self->edit->deformer(), self->bones()); });
    if (!done) return call.fail();
    lua_createtable(call.lua(), count_of(joints), 0);
    for (Index i = 0; i < count_of(joints); ++i) {
        call.push_vector(joints[at(i)]);
        lua_rawseti(call.lua(), -2, i + 1);
    }
    return 1;
}

int bone_handle(Call& call) {
    const auto self = call.self<BonesObject>();
    const Index bone = call.id("bone");
    const auto result = call.create<HandleObject>();
    const bool done = call.attempt_quick([&] {
        const Bones& bones = self->bones();
        require(bone < count_of(bones.handles), "there is no such bone", ErrorCode::out_of_range);
        result.set(
            std::make_shared<HandleObject>(HandleObject{self->edit, bones.handles[at(bone)]}));
    });
    return done ? 1 : call.fail();
}

int remove_all(Call& call) {
    const auto self = call.self<BonesObject>();
    const bool done = call.attempt_quick([&] {
        const Bones bones = self->bones();
        remove_bones(self->edit->deformer(), bones);
    });
    return done ? 0 : call.fail();
}

int equal_bones(Call& call) {
    const auto a = call.self<BonesObject>(1), b = call.self<BonesObject>(2);
    return call.push(a->edit == b->edit && a->first == b->first);
}

int bones_size(Call& call) {
    const auto self = call.self<BonesObject>();
    Index count = 0;
    if (!call.attempt_quick([&] { count = count_of(self->bones().handles); })) return call.fail();
    return call.push(count);
}

int bones_text(Call& call) {
    const auto self = call.self<BonesObject>();
    Index count = 0;
    if (!call.attempt_quick([&] { count = count_of(self->bones().handles); })) {
        return call.push(std::string_view("lissom.Bones (removed)"));
    }
    char text[48];
    const int length = std::snprintf(text, sizeof text, "lissom.Bones: %d bones", count);
    return call.push(std::string_view(text, at(length)));
}

// ---- Descriptions

const std::string kArm = R"(local bar = lissom.shapes.bar{ across = 4, along = 40 }
local deformer = lissom.deformer(bar):pin(bar:region("bottom"))
local arm = deformer:add_bones{ joints = { { 0, -1.5, 0 }, { 0, 0.5, 0 }, { 0, 2.5, 0 } } }
)";

const std::vector<Result> kSelfBones = {{"lissom.Bones", "bones", "The bones themselves."}};
const std::vector<ErrorCode> kBoneErrors = {ErrorCode::invalid_argument, ErrorCode::not_finite,
                                            ErrorCode::out_of_range, ErrorCode::handle_removed,
                                            ErrorCode::topology_mismatch};

std::vector<Function> bones_methods() {
    return {{.name = "turn",
             .body = turn_bone,
             .summary = "Turns a bone, and those behind it, about its joint, within its limit. The "
                        "surface follows at the next solve.",
             .arguments = {id("bone", "Its number, from the base."),
                           axis("axis", "The axis, in the world."),
                           number("angle", "The angle.").in("degrees")},
             .results = kSelfBones,
             .errors = kBoneErrors,
             .example = kArm + "arm:turn(2, \"z\", 60)\ndeformer:solve()"},
            {.name = "reach",
             .body = reach_with_bones,
             .summary =
                 "Inverse kinematics: turns bones so that the tip comes to a point, or as near to "
                 "it as their lengths and limits let it.",
             .arguments = {vector("target", "The point.")},
             .options = {axis("axis",
                              "Axis about which a stretched chain bends if the target lies "
                              "along it.")
                             .optional("one square to it"),
                         integer("rounds", "Rounds over all joints, at most.")
                             .defaults(ReachOptions().rounds)
                             .between(1, 10'000)},
             .results = {{"number", "distance", "The distance from the tip that is left."}},
             .effect = Effect::changes,
             .errors = kBoneErrors,
             .example = kArm + "assert(arm:reach({ 1, 1.5, 0 }, { axis = \"z\" }) < 1e-4)\n"
                               "deformer:solve()"},
            {.name = "follow",
             .body = follow_with_bones,
             .summary =
                 "Lays the chain along a smooth curve through points (spline IK): the base at its "
                 "start, and bones turned least from one to the next. Lengths and limits stay; "
                 "behind its end bones go on straight.",
             .arguments = {points("points", "Points of the curve, such as polyline:points().")},
             .options = {boolean("stretch",
                                 "Joints keep their shares of the length, and bones stretch along "
                                 "themselves to span them (a wire); no limit holds then.")
                             .defaults(false),
                         number("twist", "Turn about the curve from the base to the tip.")
                             .in("degrees")
                             .defaults(0)},
             .results = kSelfBones,
             .errors = kBoneErrors,
             .example = kArm + "arm:follow{ { 0, -1.5, 0 }, { 0.3, 0.5, 0 }, { 1.5, 1.8, 0 } }\n"
                               "deformer:solve()"},
            {.name = "move",
             .body = move_bones,
             .summary = "Puts the base at a point; all bones go along as they are.",
             .arguments = {vector("base", "The place of the first joint.")},
             .results = kSelfBones,
             .errors = kBoneErrors,
             .example = kArm + "arm:move(0.5, -1.5, 0)\ndeformer:solve()"},
            {.name = "reset",
             .body = reset_bones,
             .summary = "Puts all bones back to rest.",
             .results = kSelfBones,
             .errors = kBoneErrors,
             .example = kArm + "arm:turn(2, \"z\", 60):reset()\n"
                               "assert(math.abs(arm:joints()[3][2] - 2.5) < 1e-12)"},
            {.name = "joints",
             .body = bone_joints,
             .summary = "The joints as they are now, by the poses of the handles.",
             .results = {{"lissom.Vector[]", "joints", "From the base to the tip."}},
             .errors = kBoneErrors,
             .example = kArm + "assert(#arm:joints() == 3)"},
            {.name = "handle",
             .body = bone_handle,
             .summary = "The handle of a bone: the surface that it holds.",
             .arguments = {id("bone", "Its number, from the base.")},
             .results = {{"lissom.Handle", "handle", "The handle."}},
             .errors = kBoneErrors,
             .example = kArm + "assert(#arm:handle(1):region() > 0)"},
            {.name = "remove",
             .body = remove_all,
             .summary = "Removes the chain and its handles: the surface that they held is free.",
             .effect = Effect::changes,
             .errors = {ErrorCode::handle_removed, ErrorCode::topology_mismatch},
             .example = kArm + "arm:remove()\nassert(#deformer:bones() == 0)"}};
}

}  // namespace

Function add_bones_method() {
    return {.name = "add_bones",
            .body = add_bones_of,
            .summary =
                "Adds a chain of bones. Each holds the surface around its middle as a handle, and "
                "the solver finds how the rest follows: there are no weights to paint.",
            .options = {points("joints",
                               "Joints at rest within the surface, from the base to the "
                               "tip; two at least."),
                        numbers("limits",
                                "For each bone the greatest angle from its rest direction, as seen "
                                "from the bone before it, in degrees.")
                            .optional("no limits"),
                        number("share",
                               "Part of each bone's length along which it holds the "
                               "surface.")
                            .defaults(BonesOptions().share)
                            .above(0)
                            .between(0, 1),
                        number("radius",
                               "Above 0 a bone holds the vertices within this distance of it, and "
                               "joints may lie anywhere: for lines along a surface, such as brows "
                               "and lips.")
                            .in("mesh units")
                            .defaults(BonesOptions().radius)
                            .at_least(0)},
            .results = {{"lissom.Bones", "bones", "Turn them, then solve."}},
            .effect = Effect::changes,
            .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite,
                       ErrorCode::handle_overlap, ErrorCode::handle_outside_region,
                       ErrorCode::topology_mismatch, ErrorCode::memory_limit, ErrorCode::cancelled},
            .example = kArm + "arm:turn(2, \"x\", 45)\ndeformer:solve()"};
}

Function list_bones_method() {
    return {.name = "bones",
            .body = bones_in,
            .summary =
                "Returns the chains of bones, in the order they were added. A chain goes when "
                "one of its handles is removed; its other handles stay.",
            .results = {{"lissom.Bones[]", "chains", "The chains."}},
            .errors = {ErrorCode::handle_removed, ErrorCode::topology_mismatch},
            .example = kArm + "assert(#deformer:bones() == 1 and deformer:bones()[1] == arm)"};
}

Type bones_type() {
    return {
        .name = "lissom.Bones",
        .summary =
            "A chain of bones in a deformer, which keeps it: it is undone and saved with scenes. "
            "Its pose is that of its handles.",
        .methods = bones_methods(),
        .operators = {{"__len", bones_size, "#bones", "number of bones"},
                      {"__eq", equal_bones, "a == b", "the same chain of the same deformer"},
                      {"__tostring", bones_text, "tostring(bones)", "counts"}}};
}

}  // namespace lissom::lua
