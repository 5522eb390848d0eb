/// A solve that pushes apart parts which would run through one another.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/deformer.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// The effect of solve_avoiding_contacts.
struct AvoidedContacts {
    /// Contacts (contacts.h) of the result that Deformer::solve gives.
    Index before = 0;
    /// Contacts that are left; no more than `before`.
    std::vector<FacePair> contacts;
    /// Rounds of pushing, 0 to 3.
    int rounds = 0;
};

/// Solves as Deformer::solve, and pushes apart parts that run through one another: forces along the
/// way out of the other part, of both parts alike unless one is held, as few as keep them apart;
/// the surface answers them as one that is deformed, with rotations fitted to it again. Handles and
/// constraints hold exactly, so that parts which handles push into one another stay there. A result
/// without contacts is that of solve to the bit, and so is one of whose contacts pushing does not
/// take away a third, or only by crumpling the surface: parts that have run right through one
/// another have no way out.
/// `mesh` is as for contacts_of. Errors: as Deformer::solve and contacts_of; unsupported for a
/// comparison method.
AvoidedContacts solve_avoiding_contacts(Deformer& deformer, const Mesh& mesh,
                                        const Context& context = own_context());

}  // namespace lissom
