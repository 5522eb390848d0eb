#include "kernel/deform/working_patch.h"

#include <utility>

namespace lissom {

WorkingPatch::WorkingPatch(Patch from, const DeformOptions& options)
    : patch(std::move(from)),
      rings(build_rings(patch.vertex_count, patch.split_triangles)),
      geometry(ring_geometry(rings, patch.split_triangles, patch.rest)),
      laplacian(make_laplacian(rings, geometry, options.weights, options.scale_free)) {}

}  // namespace lissom
