/// Meshes to be sewn and their joins, for the tests of merging.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/merge/loop/loop_pair.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/shapes.h"

namespace lissom::test {

/// Fractions of a closed polyline's length at its points.
inline std::vector<double> loop_fractions(const std::vector<Vec3>& points) {
    std::vector<double> at{0.0};
    for (std::size_t k = 0; k < points.size(); ++k) {
        at.push_back(at.back() + (points[(k + 1) % points.size()] - points[k]).norm());
    }
    const double length = at.back();
    at.pop_back();
    for (double& fraction : at) fraction /= length;
    return at;
}

/// The place of a fraction on a loop with points at the fractions `at`, which begin with 0.
inline LoopPoint place_at(const std::vector<double>& at, double fraction) {
    const auto n = static_cast<Index>(at.size());
    for (Index k = 0; k < n; ++k) {
        const double end = k + 1 < n ? at[k + 1] : 1.0;
        if (std::abs(fraction - at[k]) < 1e-9) return {k, 0.0};
        if (fraction < end - 1e-9) return {k, (fraction - at[k]) / (end - at[k])};
    }
    return {0, 0.0};
}

inline std::vector<Vec3> points_of(const Mesh& mesh, const std::vector<Index>& loop) {
    std::vector<Vec3> points;
    for (const Index v : loop) points.push_back(mesh.position(v));
    return points;
}

/// A join by equal fractions of the lengths of two loops, which run the same way from their first
/// vertices on.
inline LoopPair pair_by_length(const Mesh& target, const std::vector<Index>& target_loop,
                               const Mesh& source, const std::vector<Index>& source_loop) {
    LoopPair join{source_loop, target_loop, {}, {}};
    const std::vector<double> t = loop_fractions(points_of(target, target_loop));
    const std::vector<double> s = loop_fractions(points_of(source, source_loop));
    for (const double fraction : s) join.on_target.push_back(place_at(t, fraction));
    for (const double fraction : t) join.on_source.push_back(place_at(s, fraction));
    return join;
}

/// Puts the source's loop vertices at their places on the target's loop.
inline void bring_together(const Mesh& target, Mesh& source, const LoopPair& join) {
    const std::vector<Vec3> points = points_of(target, join.target);
    for (std::size_t i = 0; i < join.source.size(); ++i) {
        source.set_position(join.source[i], point_of(points, join.on_target[i]));
    }
}

/// A loop begun at the vertex that lies farthest in `direction`.
inline std::vector<Index> begun_at(const Mesh& mesh, std::vector<Index> loop,
                                   const Vec3& direction) {
    const auto first = std::max_element(loop.begin(), loop.end(), [&](Index a, Index b) {
        return mesh.position(a).dot(direction) < mesh.position(b).dot(direction);
    });
    std::rotate(loop.begin(), first, loop.end());
    return loop;
}

/// Two meshes and the joins between them, positions solved.
struct SewScene {
    Mesh target, source;
    std::vector<LoopPair> joins;
};

/// Joins boundary `target_number` of the target and `source_number` of the source, both begun at
/// their farthest vertex in `direction`.
inline void add_join(SewScene& scene, std::size_t target_number, std::size_t source_number,
                     const Vec3& direction) {
    const std::vector<Index> target =
        begun_at(scene.target, scene.target.topology().boundary_loops()[target_number], direction);
    std::vector<Index> source = scene.source.topology().boundary_loops()[source_number];
    std::reverse(source.begin(), source.end());
    source = begun_at(scene.source, std::move(source), direction);
    scene.joins.push_back(pair_by_length(scene.target, target, scene.source, source));
    bring_together(scene.target, scene.source, scene.joins.back());
}

/// An open tube along y from `bottom` to `bottom + height`.
inline Mesh make_tube(Index segments, double bottom, double height, double radius = 1.0,
                      Index rings = 6) {
    return moved(open_tube(segments, rings, height, radius),
                 translation({0.0, bottom + 0.5 * height, 0.0}));
}

/// Number of the boundary whose points are lowest (`sign` -1) or highest (+1) along y.
inline std::size_t boundary_towards(const Mesh& mesh, double sign) {
    const auto& loops = mesh.topology().boundary_loops();
    std::size_t best = 0;
    for (std::size_t l = 1; l < loops.size(); ++l) {
        if (sign * mesh.position(loops[l][0]).y() > sign * mesh.position(loops[best][0]).y())
            best = l;
    }
    return best;
}

/// Two tubes one upon the other, with loops of the given numbers of vertices.
inline SewScene two_tubes(Index target_segments, Index source_segments) {
    SewScene scene{make_tube(target_segments, -2.0, 2.0), make_tube(source_segments, 0.0, 2.0), {}};
    add_join(scene, boundary_towards(scene.target, 1.0), boundary_towards(scene.source, -1.0),
             Vec3(1.0, 0.0, 1e-3));
    return scene;
}

/// A mesh cut along edges into the part where `below` holds for all vertices of a face and the
/// rest.
template <typename Below>
SewScene cut_in_two(const Mesh& mesh, const Below& below) {
    std::vector<Index> faces, others;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        const bool in =
            std::all_of(face.begin(), face.end(), [&](Index v) { return below(mesh.position(v)); });
        (in ? faces : others).push_back(f);
    }
    return {extract_faces(mesh, faces).mesh, extract_faces(mesh, others).mesh, {}};
}

}  // namespace lissom::test
