/// The search for contacts that a Deformer keeps; private to kernel/deform.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/deform/contact/contact_search.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

struct KeptContacts {
    /// Errors: as ContactSearch.
    KeptContacts(std::shared_ptr<const RestShape> of, const Mesh& at_rest, const Context& context)
        : rest(std::move(of)),
          search(at_rest.shared_topology(),
                 {at_rest.positions().begin(), at_rest.positions().end()}, context) {}

    /// The rest shape that `search` belongs to.
    std::shared_ptr<const RestShape> rest;
    ContactSearch search;
};

/// Returns the search for a rest shape within `mesh`: the kept one, or a new one that is kept.
/// Errors: as contacts_of in contacts.h.
ContactSearch& contact_search(std::shared_ptr<KeptContacts>& kept,
                              const std::shared_ptr<const RestShape>& rest, const Mesh& mesh,
                              const Context& context);

/// Returns the contacts of a frame of that rest shape. Errors: cancelled.
std::vector<FacePair> contacts_of(ContactSearch& search, const RestShape& rest,
                                  const ConstraintSet& constraints, const DeformFrame& frame,
                                  const Context& context);

}  // namespace lissom
