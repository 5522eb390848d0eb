/// Deformation gradients as linear functions of positions (Eq 2.3 to 2.5), and the displacement of
/// degenerate vertices that makes them exist (section 2.4.3, Eq 2.9); private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/operators.h"
#include "kernel/deform/patch/patch.h"

namespace lissom {

/// M_i = x_i self[i]^T + sum over the ring of x_j neighbor[entry]^T, for `defined` vertices.
struct GradientStencils {
    std::vector<char> defined;
    std::vector<Vec3> self, neighbor;
    /// Rest positions with degenerate vertices displaced, and which those are, ascending.
    std::vector<Vec3> displaced_rest;
    std::vector<Index> displaced;

    /// M_i of the positions x. Linear in x: of deviations from an affine image of the rest shape it
    /// gives the deviation of M_i.
    Mat3 gather(const Rings& rings, std::span<const Vec3> x, Index i) const;
};

/// Displaces degenerate vertices in sequence, each tested against neighbours as they stand by then:
/// outward from `start`, vertices at the same distance together. Constrained vertices stay in
/// place, and go without a gradient if they are still degenerate at the end.
GradientStencils make_gradients(const Patch& patch, const Rings& rings,
                                const RingGeometry& geometry, const KnownMask& known,
                                const Vec3& start, const DeformOptions& options);

}  // namespace lissom
