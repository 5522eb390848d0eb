/// Morph targets that tell whether an operation is one linear map for positions and displacements.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "kernel/mesh/measure/morph_maps.h"
#include "kernel/mesh/mesh.h"
#include "tests/unit/support.h"

namespace lissom::test {

/// A displacement that is no linear function of the place.
inline Vec3 wavy(const Vec3& p) {
    return {std::sin(3.0 * p.y()), std::cos(2.0 * p.z()) * p.x(), p.x() * p.y() + 0.3};
}

inline void add_target(Mesh& mesh, int number, Domain domain, const std::vector<Vec3>& of_vertex) {
    Attribute morph{
        "morph." + std::to_string(number) + ".position", domain, 3, ScalarType::float64, {}};
    const auto add = [&](Index v) {
        const Vec3& d = of_vertex[at(v)];
        morph.values.insert(morph.values.end(), {d.x(), d.y(), d.z()});
    };
    if (domain == Domain::vertex) {
        for (Index v = 0; v < mesh.vertex_count(); ++v) add(v);
    } else {
        for (const Index v : mesh.topology().faces().vertices) add(v);
    }
    mesh.attributes().add(std::move(morph));
}

/// Gives the mesh four targets: the positions themselves, a wavy one, twice that less the
/// positions, and the wavy one on corners.
inline void add_telling_targets(Mesh& mesh) {
    const std::vector<Vec3> x(mesh.positions().begin(), mesh.positions().end());
    std::vector<Vec3> wave, mixed;
    for (const Vec3& p : x) wave.push_back(wavy(p));
    for (std::size_t v = 0; v < x.size(); ++v) mixed.push_back(2.0 * wave[v] - x[v]);
    add_target(mesh, 1, Domain::vertex, x);
    add_target(mesh, 2, Domain::vertex, wave);
    add_target(mesh, 3, Domain::vertex, mixed);
    add_target(mesh, 4, Domain::corner, wave);
}

inline void drop_morphs(Mesh& mesh) {
    for (int number = 1; number <= 4; ++number) {
        mesh.attributes().remove("morph." + std::to_string(number) + ".position");
    }
}

inline std::vector<Vec3> target(const Mesh& mesh, int number) {
    return morph_displacements(
        mesh, *mesh.attributes().find("morph." + std::to_string(number) + ".position"));
}

/// The greatest length by which the targets, after an operation, are not the map that the positions
/// went through: the first must be the positions, the third twice the second less those, and the
/// fourth the second.
inline double departure(const Mesh& mesh) {
    const std::vector<Vec3> own = target(mesh, 1), wave = target(mesh, 2), mixed = target(mesh, 3),
                            corners = target(mesh, 4);
    double greatest = 0.0;
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
        const std::size_t v = at(i);
        greatest =
            std::max({greatest, (own[v] - mesh.position(i)).norm(),
                      (mixed[v] - 2.0 * wave[v] + own[v]).norm(), (corners[v] - wave[v]).norm()});
    }
    return greatest;
}

/// The positions of a mesh moved by a target.
inline Mesh moved_by_target(const Mesh& mesh, int number) {
    Mesh moved = mesh;
    const std::vector<Vec3> d = target(mesh, number);
    const std::span<Vec3> x = moved.edit_positions();
    for (std::size_t v = 0; v < d.size(); ++v) x[v] += d[v];
    return moved;
}

}  // namespace lissom::test
