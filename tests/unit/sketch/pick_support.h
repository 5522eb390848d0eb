/// Scenes of several surfaces for the tests of picking and selecting, and the same answers by
/// looking at everything.
#pragma once

#include <Eigen/Dense>
#include <deque>
#include <vector>

#include "kernel/mesh/shapes/shapes.h"
#include "kernel/sketch/picking.h"
#include "tests/unit/mesh/mesh_support.h"

namespace lissom::test {

/// Some surfaces in a world and a view of them.
struct PickWorld {
    /// A triangle in the world.
    struct Facet {
        Index object, face;
        Triangle triangle;
        std::array<Vec3, 3> corners;
    };

    std::deque<Mesh> meshes;
    std::deque<SpatialTree> trees;
    std::vector<Affine> places;
    PickScene scene;
    View view;
    std::vector<Facet> facets;

    void add(Mesh mesh, const Affine& place) {
        const auto object = index_of(meshes.size());
        meshes.push_back(std::move(mesh));
        const Mesh& added = meshes.back();
        trees.emplace_back(added);
        places.push_back(place);
        scene.add(trees.back(), {.to_world = place});
        const Triangulation divided = triangulate_faces(added.topology(), added.positions());
        for (std::size_t t = 0; t < divided.triangles.size(); ++t) {
            Facet facet{object, divided.face[t], divided.triangles[t], {}};
            for (std::size_t k = 0; k < 3; ++k) {
                facet.corners[k] = place(added.position(facet.triangle[k]));
            }
            facets.push_back(facet);
        }
    }

    Vec3 world(Index object, Index v) const {
        return places[at(object)](meshes[at(object)].position(v));
    }
    /// Whether the camera looks at the outside of a facet, which a mirrored object turns round.
    bool is_front(const Facet& facet) const {
        const Vec3 normal =
            (facet.corners[1] - facet.corners[0]).cross(facet.corners[2] - facet.corners[0]);
        const Vec3 towards = view.camera.is_ortho() ? Vec3(-view.camera.forward())
                                                    : Vec3(view.camera.eye() - facet.corners[0]);
        const bool mirrored = places[at(facet.object)].linear.determinant() < 0.0;
        return (normal.dot(towards) > 0.0) != mirrored;
    }
    /// From a point towards the eye.
    Vec3 to_eye(const Vec3& p) const {
        if (!view.camera.is_ortho()) return view.camera.eye() - p;
        return -view.camera.to_camera(p).z() * view.camera.forward();
    }
    /// How far the line from `p` along `way` hits a facet, in lengths of `way`; NaN where it
    /// misses.
    static double hit(const Facet& facet, const Vec3& p, const Vec3& way) {
        Mat3 system;
        system << facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0], -way;
        const Vec3 x = system.fullPivLu().solve(p - facet.corners[0]);
        const bool inside = x[0] >= 0.0 && x[1] >= 0.0 && x[0] + x[1] <= 1.0;
        return inside ? x[2] : kNaN;
    }
    /// Whether a facet that `counts` lies between `p` and the eye, farther from `p` than `slack`.
    template <typename Counts>
    bool is_hidden(const Vec3& p, const Counts& counts, double slack = 0.0) const {
        const Vec3 way = to_eye(p);
        return std::any_of(facets.begin(), facets.end(), [&](const Facet& facet) {
            if (!counts(facet)) return false;
            const double t = hit(facet, p, way);
            return t > 1e-9 && t < 1.0 && t * way.norm() > slack;
        });
    }
};

/// A view of some of these surfaces, of which the objects are turned, scaled, mirrored, far away
/// together.
inline PickWorld random_world(std::uint32_t seed, const Vec3& far = Vec3::Zero()) {
    Random random(seed);
    PickWorld world;
    std::vector<Mesh> shapes{make_torus({.segments = 14, .tube_segments = 8}),
                             make_sphere({.segments = 4}), make_grid({.segments = {6, 5}}),
                             make_cylinder({.segments = 9, .rings = 4, .caps = false})};
    for (int i = 0; i < 3; ++i) {
        const Affine turn = rotation(random.direction(), random.uniform(0.0, 6.0), Vec3::Zero());
        Vec3 factors(random.uniform(0.5, 1.5), random.uniform(0.5, 1.5), random.uniform(0.5, 1.5));
        if (i == 1) factors.x() = -factors.x();
        const Affine place =
            translation(far + 0.8 * random.direction()) * turn * scaling(factors, Vec3::Zero());
        world.add(shapes[at(random.index(count_of(shapes)))], place);
    }
    CameraOptions camera;
    camera.eye = far + random.uniform(2.0, 5.0) * random.direction();
    camera.target = far + 0.3 * random.direction();
    camera.fov = random.uniform(0.3, 1.2);
    if (seed % 3 == 0) camera.ortho = random.uniform(2.0, 4.0);
    world.view = {Camera(camera), {320.0, 240.0}};
    return world;
}

}  // namespace lissom::test
