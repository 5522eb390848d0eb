/// Options of meshes from the host's structs; private to bindings/c.
#pragma once

#include "bindings/c/context.h"
#include "kernel/mesh/render/render_map.h"
#include "kernel/mesh/repair/repair.h"

namespace lissom::c {

/// Returns how a buffer is welded; automatic is along seams. Errors: INVALID_ARGUMENT for a number
/// that is no lissom_weld.
Weld weld_of(lissom_weld weld);

/// Returns the mesh of a buffer with the options of a host; repairs are logged.
WeldedBuffer make_welded(const RenderBuffer& buffer, const lissom_buffer& given,
                         const Context& context);

}  // namespace lissom::c
