/// Scenes for the tests of deformation: a mesh with a handle at either end.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/mesh.h"
#include "tests/unit/shapes.h"

namespace lissom::test {

/// A mesh of which the lowest and highest vertices along its longest side are handles.
struct Scene {
    Mesh mesh;
    std::vector<Index> low, high;
    double size = 0.0;
    Vec3 across = Vec3::UnitX();

    Region region(const std::vector<Index>& vertices) const {
        return {mesh.shared_topology(), vertices};
    }
    /// The n-th of the vertices between the handles.
    Index between(Index n) const {
        for (Index v = 0;; ++v) {
            const bool held = std::find(low.begin(), low.end(), v) != low.end() ||
                              std::find(high.begin(), high.end(), v) != high.end();
            if (!held && n-- == 0) return v;
        }
    }
    Region all() const { return Region::all(mesh.shared_topology()); }
};

inline Scene make_scene(Mesh mesh, double share = 0.12) {
    Scene scene{std::move(mesh), {}, {}, 0.0, Vec3::UnitX()};
    const Box box = bounds(scene.mesh);
    Index axis = 0;
    const Vec3 extent = box.max - box.min;
    extent.maxCoeff(&axis);
    for (Index v = 0; v < scene.mesh.vertex_count(); ++v) {
        const double t = (scene.mesh.position(v)[axis] - box.min[axis]) / extent[axis];
        if (t < share) scene.low.push_back(v);
        if (t > 1.0 - share) scene.high.push_back(v);
    }
    scene.size = surface_radius(scene.mesh);
    scene.across = Vec3::Unit((axis + 1) % 3);
    return scene;
}

/// A deformer of the whole mesh, and its two handles.
struct Edit {
    Deformer deformer;
    HandleId low, high;
};

inline Edit make_edit(const Scene& scene, const DeformOptions& options = {},
                      const HandleOptions& handles = {}) {
    Deformer deformer(scene.mesh, scene.all(), options);
    const HandleId low = deformer.add_handle(scene.region(scene.low), handles);
    const HandleId high = deformer.add_handle(scene.region(scene.high), handles);
    return {std::move(deformer), low, high};
}

/// The bend that most tests ask for: the high end turns about its centre and moves a little.
inline Affine bend(const Scene& scene, const Vec3& center, double angle = 0.9) {
    return translation(0.3 * scene.size * scene.across) * rotation(scene.across, angle, center);
}

inline double max_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
    return greatest;
}

inline std::vector<Vec3> mapped(const std::vector<Vec3>& points, const Affine& map) {
    std::vector<Vec3> result;
    for (const Vec3& p : points) result.push_back(map(p));
    return result;
}

/// The transform that does in the space behind `map` what `transform` does before it.
inline Affine conjugated(const Affine& transform, const Affine& map) {
    const Mat3 inverse = map.linear.inverse();
    return map * transform * Affine{inverse, -inverse * map.translation};
}

}  // namespace lissom::test
