/// Sewing: a source mesh, whose boundary has been brought onto that of a target, and the target
/// become one watertight mesh (thesis section 3.3.1, last step).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/merge/loop_pair.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The side of a seam that a face comes from.
enum class SeamSide : char { target, source };

/// One mesh made of two.
struct Sewn {
    Mesh mesh;
    /// Where its elements come from. Elements of the target keep their numbers, those of the source
    /// are numbered after them, as `append` does.
    MeshMap map;
    std::vector<SeamSide> side_of_face;
    /// The vertices of each seam, in the order of the target's loop; consecutive ones share an
    /// edge.
    std::vector<std::vector<Index>> seams;
};

}  // namespace lissom
