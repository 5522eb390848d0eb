/// The transition term of the thesis, to the letter (section 3.3.3): Eq 2.8 for both meshes at once
/// with E_T, which draws the Laplacian coordinates of both transition regions together.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/blend/band_place.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// One mesh of a transition.
struct TransitionMesh {
    const Mesh* mesh = nullptr;
    /// For each vertex: whether its position, and whether its deformation gradient, is known, and
    /// the values. A vertex of known position may have an unknown gradient.
    std::vector<char> position_known, gradient_known;
    std::vector<Vec3> position;
    std::vector<Mat3> gradient;
    /// Vertices of the transition region, and for each its counterpart: a place of the other mesh.
    std::vector<Index> region;
    std::vector<BandPlace> counterpart;
};

/// Positions of all vertices, and rotation and stretch of the surface at them (M of Eq 2.5;
/// identity if it is not defined).
struct TransitionShape {
    std::vector<Vec3> positions;
    std::vector<Mat3> gradients;
};

struct ThesisTransition {
    TransitionShape target, source;
};

/// Minimises E_L + E_R of both meshes (Eq 2.6 and 2.7 with the thesis's weights) and `weight` times
/// E_T, the sum over both transition regions of |M_i delta_i - sum_j b_j M_j delta_j|^2. Neither
/// local features nor shear are treated here (Eq 2.10 and 2.11 follow). The thesis's weights depend
/// on the unit, and E_T compares the two meshes: bring both to one scale first, of about unit size,
/// so that the gradients known at the boundary of the source are rotations.
/// Errors: invalid_argument for a weight that is negative or not finite, or if counts differ;
/// out_of_range; not_positive_definite if too little is known; memory_limit; cancelled.
ThesisTransition thesis_transition(const TransitionMesh& target, const TransitionMesh& source,
                                   double weight = 0.1, const Context& context = {});

}  // namespace lissom
