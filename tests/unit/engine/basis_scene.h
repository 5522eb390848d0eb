/// Bases for the tests of the evaluators: a surface with any number of handles, moved.
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bindings/engine/lissom_basis.h"
#include "kernel/deform/deformer.h"
#include "kernel/io/basis_file.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {

/// A deformer of a mesh whose handles are slabs across its longest side, moved and turned.
struct BasisScene {
    Mesh mesh;
    Deformer deformer;
    std::vector<Affine> transforms;
    /// RMS distance of the surface to its centroid.
    double size;
};

/// The share of the mesh's longest side, from 0 to 1, at which a vertex lies.
inline std::vector<double> places_along(const Mesh& mesh) {
    const Box box = bounds(mesh);
    Index axis = 0;
    const Vec3 extent = box.max - box.min;
    extent.maxCoeff(&axis);
    std::vector<double> places;
    for (const Vec3& p : mesh.positions())
        places.push_back((p[axis] - box.min[axis]) / extent[axis]);
    return places;
}

/// Vertices in slab number `h` of `count`, which cover half of the mesh's length.
inline Region slab(const Mesh& mesh, int h, int count) {
    const std::vector<double> places = places_along(mesh);
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const double t = places[static_cast<std::size_t>(v)] * (2 * count - 1);
        if (t >= 2 * h && t <= 2 * h + 1) vertices.push_back(v);
    }
    return {mesh.shared_topology(), std::move(vertices)};
}

/// Handle 0 moves by itself too; all transforms turn about a point near the handle.
inline Affine some_move(const Vec3& center, double size, std::mt19937& random) {
    std::uniform_real_distribution<double> between(-1.0, 1.0);
    const auto any = [&] { return Vec3(between(random), between(random), between(random)); };
    return translation(0.5 * size * any()) *
           rotation(any() + Vec3(0, 0, 2), 1.5 * between(random), center);
}

inline BasisScene make_basis_scene(Mesh mesh, int handles, bool surrounded = false) {
    std::mt19937 random(static_cast<unsigned>(handles) + 3u);
    Region region = Region::all(mesh.shared_topology());
    if (surrounded) {
        // What lies beyond the last slab holds its place.
        region = slab(mesh, 0, 1);
        const std::vector<double> places = places_along(mesh);
        std::vector<Index> inside;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (places[static_cast<std::size_t>(v)] < 0.9) inside.push_back(v);
        }
        region = Region(mesh.shared_topology(), std::move(inside));
    }
    BasisScene scene{mesh, Deformer(mesh, region), {}, surface_radius(mesh)};
    for (int h = 0; h < handles; ++h) {
        const HandleId id =
            scene.deformer.add_handle(slab(mesh, h, handles + (surrounded ? 1 : 0)));
        const Affine move = some_move(scene.deformer.handle(id).center, scene.size, random);
        scene.deformer.set_transform(id, move);
        scene.transforms.push_back(move);
    }
    return scene;
}

/// A transform as 3 rows of 4 numbers.
inline std::array<double, 12> rows_of(const Affine& map) {
    std::array<double, 12> rows{};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) rows[static_cast<std::size_t>(4 * r + c)] = map.linear(r, c);
        rows[static_cast<std::size_t>(4 * r + 3)] = map.translation[r];
    }
    return rows;
}

/// Transforms of the mesh's space, 12 numbers each.
inline std::vector<double> rows_of(const std::vector<Affine>& maps) {
    std::vector<double> all;
    for (const Affine& map : maps) {
        const auto rows = rows_of(map);
        all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
}

/// Transforms relative to the origin, 12 floats each.
inline std::vector<float> local_rows(const lissom_basis& basis, const std::vector<Affine>& maps) {
    std::vector<float> all(12 * maps.size());
    for (std::size_t h = 0; h < maps.size(); ++h) {
        lissom_basis_local(&basis, rows_of(maps[h]).data(), all.data() + 12 * h);
    }
    return all;
}

/// The greatest distance between floats relative to an origin and points.
inline double max_distance(const std::vector<float>& local, const double* origin,
                           const std::vector<Vec3>& points) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 p(local[3 * i], local[3 * i + 1], local[3 * i + 2]);
        const Vec3 o(origin[0], origin[1], origin[2]);
        greatest = std::max(greatest, (p - (points[i] - o)).norm());
    }
    return greatest;
}

}  // namespace lissom::test
