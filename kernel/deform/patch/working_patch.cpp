#include "kernel/deform/patch/working_patch.h"

#include <algorithm>
#include <utility>

#include "kernel/deform/patch/normal_points.h"

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
      radius(surface_radius_of(patch.triangles, patch.rest)) {
    if (options.flat == FlatVertices::displaced || options.method != DeformMethod::implicit) return;
    add_normal_points(*this, options.degenerate_threshold, options.displacement);
}

SurfaceRings WorkingPatch::surface_rings() const {
    SurfaceRings own;
    if (!patch.is_plain()) {
        own.rings = build_rings(patch.real_count, patch.triangles);
        own.geometry = ring_geometry(own.rings, patch.triangles, patch.rest);
        return own;
    }
    own.rings.begin.push_back(0);
    for (Index i = 0; i < patch.real_count; ++i) {
        for (Index e = rings.begin[at(i)]; e < rings.begin[at(i) + 1]; ++e) {
            if (rings.neighbor[at(e)] >= patch.real_count) continue;
            own.rings.neighbor.push_back(rings.neighbor[at(e)]);
            own.geometry.cotangent.push_back(geometry.cotangent[at(e)]);
        }
        own.rings.begin.push_back(count_of(own.rings.neighbor));
    }
    own.geometry.area.assign(geometry.area.begin(), geometry.area.begin() + patch.real_count);
    own.geometry.normal.assign(geometry.normal.begin(), geometry.normal.begin() + patch.real_count);
    return own;
}

double WorkingPatch::position_unit() const {
    return kPositionUnit / (radius * radius);
}

double WorkingPatch::gradient_unit() const {
    return kGradientUnit;
}

}  // namespace lissom
