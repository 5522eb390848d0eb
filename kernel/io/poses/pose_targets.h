/// Morph targets of a pose space, for engines that blend linearly, with correctives that take back
/// the error of that.
///
///     PoseTargetReport report;
///     const Mesh mesh = pose_targets(space, {.correctives = {{{"bent", 0.5}}}}, &report);
///     save_mesh(mesh, "poses.glb");
///     const std::vector<double> weights = target_weights(report.targets, {{"bent", 0.7}});
#pragma once

#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/deform/poses/pose_space.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct PoseTargetOptions {
    /// Weights of poses at which the targets with their correctives give the blend. The shapes of a
    /// path are among them without being named.
    std::vector<std::vector<PoseWeight>> correctives;
    /// Gives a mesh without normals those of its surface, so that light follows.
    bool normals = true;
};

/// A morph target: a pose, with the weight 1, or a corrective.
struct PoseTarget {
    /// Of a corrective "bent=0.5" or "bent=1,smile=1".
    std::string name;
    std::vector<PoseWeight> at;
    bool is_corrective = false;
};

struct PoseTargetReport {
    /// In the order of the mesh's targets.
    std::vector<PoseTarget> targets;
    /// Greatest distance of a vertex from the blend, in mesh units, over tenths of the way from
    /// rest to every pose and to every corrective: by the poses' targets alone, and with
    /// correctives.
    double linear_error = 0.0, error = 0.0;
};

/// Returns the rest of a space with morph targets as attributes "morph.N.position" and, if it has
/// or is given normals of vertices, "morph.N.normal". Morph targets that the rest had are left out.
/// Errors: as PoseSpace::positions; invalid_argument for a corrective without weights other than
/// 0, for one at a pose alone, and for two at the same weights; unsupported for a mesh without
/// faces.
Mesh pose_targets(const PoseSpace& space, const PoseTargetOptions& options = {},
                  PoseTargetReport* report = nullptr, const Context& context = {});

/// Returns the weight of each target at weights of poses. That of a corrective is a product over
/// its poses, with weight w and at a: (w - 1) / (a - 1) if a is above 1, or w above an a between 0
/// and 1, else w / a; never below 0. Poses that are left out have weight 0.
std::vector<double> target_weights(const std::vector<PoseTarget>& targets,
                                   const std::vector<PoseWeight>& weights);

}  // namespace lissom
