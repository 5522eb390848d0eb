#include "kernel/mesh/edit/triangulate.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/polygon_splitter.h"

namespace lissom {
namespace {

// Those among `faces` that have more than three corners, ascending, once each.
std::vector<Index> polygons_among(const Topology& topology, std::span<const Index> faces) {
    require_faces(topology, faces);
    std::vector<Index> polygons;
    for (const Index f : faces) {
        if (topology.face(f).size() > 3) polygons.push_back(f);
    }
    std::sort(polygons.begin(), polygons.end());
    polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
    return polygons;
}

}  // namespace

void triangulate(Mesh& mesh, std::span<const Index> faces, const Context& context) {
    const Topology& topology = mesh.topology();
    const std::vector<Index> polygons = polygons_among(topology, faces);
    if (polygons.empty()) return;
    Progress progress(context, "triangulate");
    // Sources of the elements.
    const MemoryCharge working = context.charge(mesh.memory_bytes(), "triangulating a mesh");
    const PolygonSplitter splitter(topology, mesh.positions(), polygons);

    FaceList result;
    std::vector<Index> corners, face_map;
    std::size_t next = 0;
    for (Index f = 0; f < topology.face_count(); ++f) {
        const std::span<const Index> face = topology.face(f);
        const Index first = topology.first_corner(f);
        if (next == polygons.size() || polygons[next] != f) {
            result.add(face);
            for (std::size_t k = 0; k < face.size(); ++k) {
                corners.push_back(first + index_of(k));
            }
            face_map.push_back(f);
            continue;
        }
        for (const auto& [a, b, c] : splitter.triangles(next++)) {
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
    std::vector<Index> all(mesh.face_count());
    std::iota(all.begin(), all.end(), 0);
    triangulate(mesh, all, context);
}

}  // namespace lissom
