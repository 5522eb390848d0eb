/// BoundarySystems: the factored systems of a deformation by boundaries, and all else that does not
/// depend on the values of held vertices; private to kernel/deform.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/boundary/common_gradients.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/stats.h"
#include "kernel/deform/system/gradient_residual.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// The frame of the rest shape in the systems: centred on the mean of the held vertices, in units
/// of the RMS distance to it.
struct BoundaryFrame {
    Vec3 center = Vec3::Zero();
    double unit = 1.0;
};

struct BoundarySystems {
    /// Makes and factors the systems. Errors: zero_area; unconstrained; not_positive_definite;
    /// memory_limit; cancelled.
    BoundarySystems(const Mesh& mesh, const Region& region, const Region& held,
                    const BoundaryDeformOptions& options, const Context& context);
    BoundarySystems(const BoundarySystems&) = delete;
    BoundarySystems& operator=(const BoundarySystems&) = delete;

    /// Whether vertices move at all.
    bool has_free() const { return !second->free_vertices().empty(); }
    /// A rest position in the frame.
    Vec3 rest(Index v) const { return work.patch.rest[at(v)] + work.patch.origin; }

    Region region, held;
    SizeField size_field;
    DeformOptions options;
    BoundaryFrame frame;
    WorkingPatch work;
    /// Local vertices of `held`, in its order, and of features.
    std::vector<Index> held_local;
    std::vector<std::vector<Index>> feature_local;
    /// Whether anything but held vertices is fixed.
    bool surrounded = false;
    KnownMask known;
    GradientStencils stencils;
    std::unique_ptr<GradientSystem> first;
    std::unique_ptr<RotationSystem> second;
    std::unique_ptr<GradientResidual> residual;
    std::unique_ptr<CommonGradients> common;
    DeformStats stats;

  private:
    void assemble(const Context& context);
    void factor(const Context& context);
};

}  // namespace lissom
