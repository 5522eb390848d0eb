/// Deformation of a very large surface on two levels: the method of the thesis on a thinned
/// surface, which the vertices of the whole one follow; private to kernel/deform.
#pragma once

#include <memory>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/levels/surface_binding.h"
#include "kernel/deform/options.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct Preparation;

/// Factors for both levels.
struct LevelMethod {
    /// In the coordinates of the patch.
    Mesh thinned;
    /// The owner (constraints.h) of each vertex of `thinned`.
    std::vector<Index> owner;
    std::shared_ptr<const Preparation> coarse;
    /// The handle of `coarse` for each handle; without value for one that holds nothing.
    std::vector<HandleId> handles;
    /// Of each local vertex of the patch.
    std::vector<SurfaceFollow> follows;
};

}  // namespace lissom
