/// Generated models with features to paste.
#pragma once

#include <cmath>

#include "kernel/merge/paste/paste.h"
#include "kernel/mesh/edit/transform.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"

namespace lissom::test {

/// A ball with a bent horn on top.
inline Mesh horned_ball(Index segments = 24) {
    Mesh mesh = make_sphere({1.0, segments, SphereKind::triangles});
    for (Vec3& p : mesh.edit_positions()) {
        if (p.y() <= 0.0) continue;
        const double rise = std::exp(-14.0 * (p.x() * p.x() + p.z() * p.z()));
        p += Vec3(0.35 * rise * rise, 0.9 * rise, 0.0);
    }
    return mesh;
}
inline Region around_horn(const Mesh& mesh, double radius = 0.9) {
    return select_sphere(mesh, {0, 1.3, 0}, radius);
}

inline Mesh egg(Index segments = 20) {
    Mesh mesh = make_sphere({1.0, segments, SphereKind::triangles});
    for (Vec3& p : mesh.edit_positions()) p = Vec3(1.4 * p.x(), 2.0 * p.y(), 1.6 * p.z());
    return mesh;
}

inline Paste horn_on_egg(const Mesh& horn, const Mesh& target, const PastePlacement& placement,
                         const PasteOptions& options = {}) {
    return Paste(horn, target, around_horn(horn), std::nullopt, std::nullopt, placement, options);
}

}  // namespace lissom::test
