/// Merged meshes made by hand, for tests of what is done around a seam.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/mesh/mesh_support.h"

namespace lissom::test {

/// The mesh as if the faces of `source` had been sewn on.
inline Sewn sewn(Mesh mesh, const Region& source) {
    Sewn result;
    result.side_of_face.assign(static_cast<std::size_t>(mesh.face_count()), SeamSide::target);
    for (const Index f : source.faces()) result.side_of_face[f] = SeamSide::source;
    for (const std::vector<Index>& loop : source.boundaries()) {
        result.seams.emplace_back(loop.rbegin(), loop.rend());
    }
    result.mesh = std::move(mesh);
    return result;
}

/// An open surface of revolution about z with the seam at z = 0 and the source above it, of nearly
/// equilateral triangles. `radius(angle, z)` is its shape; rows reach as far up as down.
inline Sewn revolution(Index around, Index rows,
                       const std::function<double(double, double)>& radius) {
    std::vector<Vec3> positions;
    FaceList faces;
    std::vector<Index> top;
    const double step = 2.0 * kPi / around;
    for (Index row = -rows; row <= rows; ++row) {
        for (Index i = 0; i < around; ++i) {
            const double angle = step * (i + 0.5 * std::abs(row % 2));
            const double z = std::sqrt(0.75) * step * row, r = radius(angle, z);
            if (row >= 0) top.push_back(static_cast<Index>(positions.size()));
            positions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
        }
    }
    for (Index row = 0; row < 2 * rows; ++row) {
        const bool shifted = (row + rows) % 2 != 0;
        for (Index i = 0; i < around; ++i) {
            const Index a = row * around + i, b = row * around + (i + 1) % around;
            const Index c = a + around, d = b + around;
            faces.add(shifted ? std::initializer_list<Index>{a, d, c}
                              : std::initializer_list<Index>{a, b, c});
            faces.add(shifted ? std::initializer_list<Index>{a, b, d}
                              : std::initializer_list<Index>{b, d, c});
        }
    }
    Mesh mesh(std::move(positions), std::move(faces));
    const Region source(mesh.shared_topology(), top);
    Sewn result = sewn(std::move(mesh), source);
    // The open end of the source is no seam.
    std::erase_if(result.seams, [&](const std::vector<Index>& loop) {
        return result.mesh.topology().is_boundary(loop.front());
    });
    return result;
}

/// A cylinder that opens into a cone at the seam.
inline Sewn creased(double slope = 0.6) {
    return revolution(64, 16, [=](double, double z) { return 1.0 + slope * std::max(0.0, z); });
}

/// The same surface with other numbers: vertex v becomes `to[v]`, faces come in the opposite order
/// and begin elsewhere, as seams do.
inline Sewn renumbered(const Sewn& old, const std::vector<Index>& to) {
    Sewn result;
    std::vector<Vec3> positions(to.size());
    for (Index v = 0; v < old.mesh.vertex_count(); ++v) positions[to[v]] = old.mesh.position(v);
    FaceList faces;
    for (Index f = old.mesh.face_count(); f-- > 0;) {
        std::vector<Index> face;
        for (const Index v : old.mesh.topology().face(f)) face.push_back(to[v]);
        std::rotate(face.begin(), face.begin() + 1, face.end());
        faces.add(face);
        result.side_of_face.push_back(old.side_of_face[f]);
    }
    result.mesh = Mesh(std::move(positions), std::move(faces));
    for (std::vector<Index> seam : old.seams) {
        for (Index& v : seam) v = to[v];
        std::rotate(seam.begin(), seam.begin() + 5, seam.end());
        result.seams.push_back(std::move(seam));
    }
    return result;
}

/// Every vertex number once, at random.
inline std::vector<Index> shuffled_numbers(Index count, unsigned seed) {
    std::vector<Index> to(static_cast<std::size_t>(count));
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), std::mt19937(seed));
    return to;
}

/// Greatest distance between a vertex and the one that has its place in `to`.
inline double max_move(const Mesh& a, const Mesh& b, const std::vector<Index>& to) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(to[v])).norm());
    }
    return greatest;
}

/// Largest angle between faces at an edge that joins two vertices of `seams`, in degrees.
inline double seam_dihedral(const Mesh& mesh, const std::vector<std::vector<Index>>& seams) {
    std::vector<char> on(static_cast<std::size_t>(mesh.vertex_count()), 0);
    for (const std::vector<Index>& seam : seams) {
        for (const Index v : seam) on[v] = 1;
    }
    const std::vector<Vec3> normals = face_normals(mesh);
    std::map<std::pair<Index, Index>, Index> left;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            if (on[a] && on[b]) left[{a, b}] = f;
        }
    }
    double largest = 0.0;
    for (const auto& [edge, f] : left) {
        const auto other = left.find({edge.second, edge.first});
        if (other == left.end()) continue;
        const double c = normals[f].dot(normals[other->second]);
        largest = std::max(largest, std::acos(std::clamp(c, -1.0, 1.0)) * 180.0 / kPi);
    }
    return largest;
}

/// Greatest distance between equal vertices of two meshes.
inline double max_move(const Mesh& a, const Mesh& b) {
    double greatest = 0.0;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        greatest = std::max(greatest, (a.position(v) - b.position(v)).norm());
    }
    return greatest;
}

/// Vertices whose positions differ in any bit, ascending.
inline std::vector<Index> moved_vertices(const Mesh& a, const Mesh& b) {
    std::vector<Index> moved;
    for (Index v = 0; v < a.vertex_count(); ++v) {
        if (a.position(v) != b.position(v)) moved.push_back(v);
    }
    return moved;
}

}  // namespace lissom::test
