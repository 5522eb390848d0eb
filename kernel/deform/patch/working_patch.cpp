#include "kernel/deform/patch/working_patch.h"

#include <utility>

namespace lissom {
namespace {

// A tie of weight 1 goes about half the way: it weighs as much as the surface around it resists.
constexpr double kPositionUnit = 1.0;
constexpr double kGradientUnit = 1.0;

}  // namespace

WorkingPatch::WorkingPatch(Patch from, const DeformOptions& options)
    : patch(std::move(from)),
      rings(build_rings(patch.vertex_count, patch.split_triangles)),
      geometry(ring_geometry(rings, patch.split_triangles, patch.rest)),
      laplacian(make_laplacian(rings, geometry, options.weights, options.scale_free)),
      radius(surface_radius_of(patch.triangles, patch.rest)) {}

double WorkingPatch::position_unit() const {
    return kPositionUnit / (radius * radius);
}

double WorkingPatch::gradient_unit() const {
    return kGradientUnit;
}

}  // namespace lissom
