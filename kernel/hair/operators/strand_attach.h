/// Strands are rooted on a head.
#pragma once

#include "kernel/core/context.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct AttachOptions {
    /// Moves each strand as a whole, so that its root lies on the surface.
    bool snap = true;
};

/// Roots strands at the nearest places of a head: sets Strands::roots with the texture coordinates
/// there, as of hair that was drawn or loaded. Strands that are not finite have no face. `head` is
/// the mesh that `scalp` was made for. Errors: topology_mismatch; memory_limit; cancelled.
void attach(Strands& strands, const Mesh& head, const Scalp& scalp,
            const AttachOptions& options = {}, const Context& context = {});

}  // namespace lissom
