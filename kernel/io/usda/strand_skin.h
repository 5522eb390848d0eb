/// StrandSkin: the joints of a head that move its hair; private to kernel/io.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/skinned_asset.h"

namespace lissom {

/// Joints that move each strand whole, as they move the skin at its root.
struct StrandSkin {
    static constexpr int kInfluences = 4;
    struct Joint {
        Index joint = 0;
        float weight = 0.0f;
    };

    /// Parents come before their children; coordinates are those of the strands.
    Skeleton skeleton;
    /// The strongest joints of each strand, with weights that sum to 1.
    std::vector<std::array<Joint, kInfluences>> of_strand;
};

/// Returns the joints of `head` at the roots of strands that grew on it. `unit` is the length of
/// the head's unit in that of the strands. Errors: invalid_argument if the head has no skin, naming
/// the strands without roots on it, or with roots on vertices without weights; skin_mismatch if
/// roots lie on objects of unlike skins.
StrandSkin skin_at_roots(const Strands& strands, const Mesh& head, double unit,
                         const Context& context);

/// Paths of the joints from their roots on, as USD names them: "hips/spine/head".
std::vector<std::string> joint_paths(const Skeleton& skeleton);

}  // namespace lissom
