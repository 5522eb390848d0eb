/// Vertices of very many neighbours in a patch; private to kernel/deform.
#pragma once

#include "kernel/core/context.h"
#include "kernel/deform/patch/patch.h"

namespace lissom {

/// Charges the entries that vertices of very many neighbours bring into the systems of a patch,
/// which couple the neighbours of a vertex in pairs. Errors: unsupported, with the vertices, if
/// they have more than 2^28 pairs; memory_limit.
MemoryCharge charge_hubs(const Patch& patch, const Rings& rings, const Context& context);

}  // namespace lissom
