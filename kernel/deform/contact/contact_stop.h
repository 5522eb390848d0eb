/// A drag that ends where the surface touches itself.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// The end of a drag.
struct ContactStop {
    /// The share of the way that was gone: 1 if nothing was in it.
    double share = 1.0;
    /// The pairs of faces that meet a thousandth of the way further; none if nothing was in it.
    std::vector<FacePair> contacts;
};

/// Solves as Deformer::solve, along the way of the handles from their poses in the last solve to
/// their present ones: turns and shifts as a screw, scales and targets in proportion. The result,
/// and the handles, stay at the last pose before contacts (contacts.h) appear; a drag that begins
/// in contact goes on while their number does not grow. The way is sampled, by at most a tenth of
/// the region's size at a time, and the place found by bisection to a thousandth of the way; each
/// sample costs a frame. `mesh` is as for contacts_of. Errors: as Deformer::solve and contacts_of.
ContactStop solve_until_contact(Deformer& deformer, const Mesh& mesh,
                                const Context& context = own_context());

}  // namespace lissom
