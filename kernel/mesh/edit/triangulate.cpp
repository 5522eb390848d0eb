#include "kernel/mesh/edit/triangulate.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// One flag a face: polygons among `faces`.
std::vector<char> polygons_among(const Topology& topology, std::span<const Index> faces) {
    require_faces(topology, faces);
    std::vector<char> chosen(static_cast<std::size_t>(topology.face_count()), 0);
    for (const Index f : faces) chosen[f] = topology.face(f).size() > 3;
    return chosen;
}

}  // namespace

void triangulate(Mesh& mesh, std::span<const Index> faces, const Context& context) {
    const Topology& topology = mesh.topology();
    const std::vector<char> chosen = polygons_among(topology, faces);
    if (std::find(chosen.begin(), chosen.end(), 1) == chosen.end()) return;
    Progress progress(context, "triangulate");

    FaceList result;
    std::vector<Index> corners, face_map;
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (Index f = 0; f < topology.face_count(); ++f) {
        const std::span<const Index> face = topology.face(f);
        const Index first = topology.first_corner(f);
        if (!chosen[f]) {
            result.add(face);
            for (std::size_t k = 0; k < face.size(); ++k) {
                corners.push_back(first + static_cast<Index>(k));
            }
            face_map.push_back(f);
            continue;
        }
        points.clear();
        triangles.clear();
        for (const Index v : face) points.push_back(mesh.position(v));
        triangulate_polygon(points, triangles);
        for (const auto& [a, b, c] : triangles) {
            result.add({face[a], face[b], face[c]});
            corners.insert(corners.end(), {first + a, first + b, first + c});
            face_map.push_back(f);
        }
    }
    const MeshMap map{ElementMap::identity(mesh.vertex_count()), ElementMap::copies(corners),
                      ElementMap::copies(face_map)};
    mesh.replace_by(derive(mesh, {mesh.positions().begin(), mesh.positions().end()},
                           std::move(result), map, context));
}

void triangulate(Mesh& mesh, const Context& context) {
    std::vector<Index> all(static_cast<std::size_t>(mesh.face_count()));
    std::iota(all.begin(), all.end(), 0);
    triangulate(mesh, all, context);
}

}  // namespace lissom
