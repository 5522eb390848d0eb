/// A pose of a deformer as an object of a script, and keys of a path of them.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/registry.h"
#include "kernel/core/memory_hold.h"
#include "kernel/deform/poses/deform_pose.h"

namespace lissom::lua {

struct PoseObject {
    static constexpr const char* kTypeName = "lissom.Pose";

    explicit PoseObject(DeformPose content) : pose(std::move(content)) {}

    DeformPose pose;
    std::size_t charged_bytes = 0;
    MemoryHold held;

    std::size_t memory_bytes() const {
        return pose.poses.handles.size() * sizeof(HandlePose) +
               pose.poses.targets.size() * sizeof(TargetPose);
    }
};

/// A key of a script, as plain data.
struct PoseKeySpec {
    double time;
    const PoseObject* pose;
};

/// The options `keys` and `easing`.
Parameter keys_option();
Parameter easing_option();
/// Reads the option `keys`, none if it was left out. Raises a Lua error for an empty list.
std::span<const PoseKeySpec> read_pose_keys(Call& call);
/// Returns copies of the keys' poses.
std::vector<PoseKey> pose_keys(std::span<const PoseKeySpec> specs);

/// Returns the methods pose and set_pose of a deformer.
std::vector<Function> pose_methods();

}  // namespace lissom::lua
