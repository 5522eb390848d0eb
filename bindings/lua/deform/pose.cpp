// deformer:pose and lissom.Pose: the transforms of all handles as a value.
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "bindings/lua/core/kernel_library.h"
#include "bindings/lua/deform/deform_object.h"
#include "bindings/lua/deform/pose_object.h"

namespace lissom::lua {
namespace {

const std::string kPosedBar = R"(local bar = lissom.shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar):pin(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
local straight = deformer:pose()
top:rotate("z", 270)
local wound = deformer:pose()
)";

int pose(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto result = call.create<PoseObject>();
    const bool done = call.attempt_quick(
        [&] { result.set(std::make_shared<PoseObject>(pose_of(edit->deformer()))); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int set_pose(Call& call) {
    const auto edit = call.self<DeformObject>();
    const auto given = call.object<PoseObject>("pose");
    const bool done = call.attempt_quick([&] { set_pose(edit->deformer(), given->pose); });
    return done ? call.push_argument() : call.fail();
}

int blend_pose(Call& call) {
    const auto from = call.self<PoseObject>();
    const auto to = call.object<PoseObject>("other");
    const double share = call.number("share");
    const auto result = call.create<PoseObject>();
    const bool done = call.attempt_quick(
        [&] { result.set(std::make_shared<PoseObject>(blended(from->pose, to->pose, share))); });
    if (!done) return call.fail();
    call.charge(result);
    return 1;
}

int pose_text(Call& call) {
    char text[64];
    const auto self = call.self<PoseObject>();
    const int length = std::snprintf(text, sizeof text, "lissom.Pose: %zu handles",
                                     self->pose.poses.handles.size());
    return call.push(std::string_view(text, at(length)));
}

}  // namespace

Parameter keys_option() {
    return option_list(
               "keys",
               {number("time", "Its time in seconds; ascending."),
                object("pose", "lissom.Pose", "A pose of this deformer.")},
               "Key poses, instead of a function: handles turn and shift between them as "
               "Pose:blend does. Before the first and after the last they keep still. Without "
               "duration and times the animation ends at the last.")
        .optional("pose is given");
}

Parameter easing_option() {
    return choice("easing", {"linear", "smooth", "slow in", "slow out", "step"},
                  "The pace between two key poses: even; slow at both, at the first, or at the "
                  "second; or the first pose until the second key.")
        .defaults("linear");
}

std::span<const PoseKeySpec> read_pose_keys(Call& call) {
    if (!call.has("keys")) return {};
    const auto count = raw_length(call.lua(), call.stack_index("keys"));
    if (count == 0) call.reject("keys", "list of { time =, pose = } expected");
    auto* keys = call.scratch<PoseKeySpec>(count);
    for (std::size_t i = 0; i < count; ++i) {
        call.select_item("keys", index_of(i) + 1);
        keys[i] = {call.number("keys.time"), call.object<PoseObject>("keys.pose").get()};
    }
    return {keys, count};
}

std::vector<PoseKey> pose_keys(std::span<const PoseKeySpec> specs) {
    std::vector<PoseKey> keys;
    for (const PoseKeySpec& spec : specs) keys.push_back({spec.time, spec.pose->pose});
    return keys;
}

std::vector<Function> pose_methods() {
    return {{.name = "pose",
             .body = pose,
             .summary = "The present transforms of all handles, and places of constraints, as a "
                        "value.",
             .results = {{"lissom.Pose", "pose", "It stays as it is when handles move on."}},
             .errors = {ErrorCode::handle_removed, ErrorCode::topology_mismatch},
             .example = kPosedBar + R"(top:reset()
deformer:set_pose(wound)
assert(math.abs(top:matrix()[1][1]) < 1e-9))"},
            {.name = "set_pose",
             .body = set_pose,
             .summary = "Moves all handles and constraints to a pose, for the next solve. Handles "
                        "that were added since the pose was taken stay.",
             .arguments = {object("pose", "lissom.Pose",
                                  "A pose of this deformer, and of its present rest shape.")},
             .results = {{"lissom.Deformer", "deformer", "The deformer itself."}},
             .effect = Effect::replaces,
             .errors = {ErrorCode::invalid_argument, ErrorCode::handle_removed,
                        ErrorCode::topology_mismatch},
             .example = kPosedBar + R"(deformer:set_pose(straight:blend(wound, 0.5))
deformer:solve()
assert(math.abs(top:matrix()[1][1] - math.cos(math.rad(135))) < 1e-9))"}};
}

Type pose_type() {
    Type type{.name = "lissom.Pose",
              .summary = "Transforms of the handles of a deformer at one time."};
    type.operators = {{"__tostring", pose_text, "tostring(pose)", "its size"}};
    type.methods = {
        {.name = "blend",
         .body = blend_pose,
         .summary = "The pose at a share of the way to another: handles turn and shift as screws, "
                    "by the turns that they made, full ones too, and stretch evenly.",
         .arguments = {object("other", "lissom.Pose", "A pose of the same deformer."),
                       number("share", "0 is this pose, 1 the other; others go beyond.")},
         .results = {{"lissom.Pose", "pose", "A new pose."}},
         .errors = {ErrorCode::invalid_argument, ErrorCode::not_finite,
                    ErrorCode::singular_transform},
         .example = kPosedBar + R"(local third = straight:blend(wound, 1 / 3)
deformer:set_pose(third):solve()
assert(math.abs(top:matrix()[1][1]) < 1e-9))"}};
    return type;
}

}  // namespace lissom::lua
