/// What every cut must satisfy, checked on any mesh.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "kernel/mesh/cut/cut.h"
#include "tests/unit/mesh/mesh_support.h"

namespace lissom::test {

/// The vertices of a closed path from its smallest on.
inline std::vector<Index> from_smallest(std::vector<Index> loop) {
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    return loop;
}

/// True where a closed path is an open boundary of the mesh in the boundary's own direction.
inline bool is_boundary_of(const Mesh& mesh, const Path& path) {
    const auto& loops = mesh.topology().boundary_loops();
    return std::find(loops.begin(), loops.end(), from_smallest(path.vertices())) != loops.end();
}

/// Points along the line are the same on both parts, to the bit; closed ones bound both.
inline void check_lines(const Cut& cut) {
    for (const CutLine& line : cut.lines) {
        CHECK(line.kept.closed() == line.rest.closed());
        CHECK(line.kept.points(cut.kept.mesh) == line.rest.reversed().points(cut.rest.mesh));
        CHECK(line.kept.follows_edges());
        CHECK(line.rest.follows_edges());
        if (!line.kept.closed()) continue;
        CHECK(is_boundary_of(cut.kept.mesh, line.kept));
        CHECK(is_boundary_of(cut.rest.mesh, line.rest));
    }
}

/// Elements that come from one old element are that element, to the bit and in its order.
inline void check_copies(const Mesh& mesh, const CutPiece& piece) {
    bool same = true, ordered = true;
    Index last = -1;
    for (Index v = 0; v < piece.mesh.vertex_count(); ++v) {
        const auto sources = piece.map.vertices[v];
        if (sources.size() != 1) continue;
        same = same && piece.mesh.position(v) == mesh.position(sources[0].element);
        ordered = ordered && sources[0].element > last;
        last = sources[0].element;
    }
    Index last_face = -1;
    for (Index f = 0; f < piece.mesh.face_count(); ++f) {
        const Index old = piece.map.faces.main_source(f);
        ordered = ordered && old >= last_face;
        last_face = old;
    }
    CHECK(same);
    CHECK(ordered);
    const std::vector<Vec3> blended = blend_positions(mesh, piece.map.vertices);
    double error = 0.0;
    for (Index v = 0; v < piece.mesh.vertex_count(); ++v) {
        error = std::max(error, (blended[v] - piece.mesh.position(v)).norm());
    }
    CHECK(error <= 1e-12 * (bounds(mesh).diagonal() + bounds(mesh).center().norm()));
}

/// Old faces that were not divided and whose vertices stay are there once, as they were.
inline void check_faces(const Mesh& mesh, const Cut& cut) {
    std::map<Index, Index> count;
    for (const CutPiece* piece : {&cut.kept, &cut.rest}) {
        for (Index f = 0; f < piece->mesh.face_count(); ++f) {
            ++count[piece->map.faces.main_source(f)];
        }
    }
    CHECK(static_cast<Index>(count.size()) == mesh.face_count());
    const auto divided = std::count_if(count.begin(), count.end(),
                                       [](const auto& entry) { return entry.second > 1; });
    CHECK(static_cast<Index>(divided) <= cut.report.divided_faces);
}

inline void check_cut(const Mesh& mesh, const Cut& cut) {
    check_lines(cut);
    check_copies(mesh, cut.kept);
    check_copies(mesh, cut.rest);
    check_faces(mesh, cut);
    const auto open = std::count_if(cut.lines.begin(), cut.lines.end(),
                                    [](const CutLine& line) { return !line.kept.closed(); });
    CHECK(euler_characteristic(cut.kept.mesh.topology()) +
              euler_characteristic(cut.rest.mesh.topology()) ==
          euler_characteristic(mesh.topology()) + static_cast<Index>(open));
    CHECK(area(cut.kept.mesh) + area(cut.rest.mesh) == doctest::Approx(area(mesh)).epsilon(0.02));
}

/// Smallest angles of the faces that touch the line of a piece, ascending, in degrees.
inline std::vector<double> angles_at(const Mesh& mesh, const std::set<Index>& vertices) {
    std::vector<double> angles;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.topology().face(f);
        const std::size_t n = face.size();
        if (std::none_of(face.begin(), face.end(), [&](Index v) { return vertices.contains(v); }))
            continue;
        double least = kInfinity;
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 here = mesh.position(face[k]);
            const Vec3 a = mesh.position(face[(k + 1) % n]) - here,
                       b = mesh.position(face[(k + n - 1) % n]) - here;
            least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / kPi);
        }
        angles.push_back(least);
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

}  // namespace lissom::test
