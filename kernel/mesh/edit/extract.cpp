#include "kernel/mesh/edit/extract.h"

#include <algorithm>
#include <utility>

#include "kernel/mesh/derive.h"

namespace lissom {
namespace {

// Gathers the chosen faces of a mesh and gives each separate fan of them a vertex of its own.
class Extraction {
  public:
    Extraction(const Mesh& mesh, std::vector<char> face_chosen, std::vector<char> isolated_chosen)
        : mesh_(mesh),
          topology_(mesh.topology()),
          chosen_(std::move(face_chosen)),
          isolated_(std::move(isolated_chosen)),
          vertex_of_corner_(topology_.corner_count(), kNoIndex) {}

    MeshPart take(const Context& context) {
        number_vertices();
        context.checkpoint();
        FaceList faces;
        std::vector<Index> corner_map, face_map, face;
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (!chosen_[f]) continue;
            face.clear();
            for (Index c = topology_.first_corner(f); c < topology_.first_corner(f + 1); ++c) {
                face.push_back(vertex_of_corner_[c]);
                corner_map.push_back(c);
            }
            faces.add(face);
            face_map.push_back(f);
        }
        const MeshMap map{ElementMap::copies(vertex_map_), ElementMap::copies(corner_map),
                          ElementMap::copies(face_map)};
        MeshPart part;
        part.mesh =
            derive(mesh_, blend_positions(mesh_, map.vertices), std::move(faces), map, context);
        part.vertex_map = std::move(vertex_map_);
        part.face_map = std::move(face_map);
        return part;
    }

  private:
    // First one vertex for each old one that is kept, in their order; then the copies for further
    // fans.
    void number_vertices() {
        std::vector<std::vector<Index>> further_fans;
        for (Index v = 0; v < topology_.vertex_count(); ++v) {
            std::vector<std::vector<Index>> fans = chosen_fans(v);
            if (fans.empty() && !(topology_.is_isolated(v) && isolated_[v])) continue;
            const auto id = count_of(vertex_map_);
            vertex_map_.push_back(v);
            for (std::size_t i = 0; i < fans.size(); ++i) {
                if (i == 0) {
                    for (const Index corner : fans[i]) vertex_of_corner_[corner] = id;
                } else {
                    further_fans.push_back(std::move(fans[i]));
                }
            }
        }
        for (const std::vector<Index>& fan : further_fans) {
            for (const Index corner : fan) {
                vertex_of_corner_[corner] = count_of(vertex_map_);
            }
            vertex_map_.push_back(topology_.faces().vertices[fan[0]]);
        }
    }

    // The corners at `v` of chosen faces, one list for each run of faces that share edges.
    std::vector<std::vector<Index>> chosen_fans(Index v) const {
        const std::span<const Index> around = topology_.faces_around(v);
        const std::size_t n = around.size();
        std::vector<std::vector<Index>> fans;
        // A closed fan is read from behind a face that was not chosen, so that no run is cut in
        // two.
        std::size_t start = 0;
        if (!topology_.is_boundary(v)) {
            while (start < n && chosen_[around[start]]) ++start;
        }
        bool in_run = false;
        for (std::size_t i = 0; i < n; ++i) {
            const Index f = around[(start + i) % n];
            if (chosen_[f]) {
                if (!in_run) fans.emplace_back();
                fans.back().push_back(corner_at(f, v));
            }
            in_run = chosen_[f] != 0;
        }
        return fans;
    }

    Index corner_at(Index f, Index v) const {
        const std::span<const Index> face = topology_.face(f);
        const auto at = std::find(face.begin(), face.end(), v) - face.begin();
        return topology_.first_corner(f) + index_of(at);
    }

    const Mesh& mesh_;
    const Topology& topology_;
    std::vector<char> chosen_, isolated_;
    std::vector<Index> vertex_of_corner_, vertex_map_;
};

std::vector<char> faces_of(const Mesh& mesh, const Region& region) {
    require_same_topology(mesh, region.topology(), "the region");
    std::vector<char> chosen(mesh.face_count(), 0);
    const std::vector<Index> faces = region.faces();
    if (faces.empty()) {
        throw Error(ErrorCode::region_empty,
                    "the region contains no whole face of the mesh; enlarge it");
    }
    for (const Index f : faces) chosen[f] = 1;
    return chosen;
}

// Sources of the elements of the part.
MemoryCharge room_for_part(const Mesh& mesh, const Context& context) {
    return context.charge(mesh.memory_bytes(), "a part of a mesh");
}

}  // namespace

MeshPart extract(const Mesh& mesh, const Region& region, const Context& context) {
    Progress progress(context, "extract");
    const MemoryCharge working = room_for_part(mesh, context);
    return Extraction(mesh, faces_of(mesh, region), region.mask()).take(context);
}

MeshPart remove(const Mesh& mesh, const Region& region, const Context& context) {
    Progress progress(context, "remove");
    const MemoryCharge working = room_for_part(mesh, context);
    std::vector<char> faces = faces_of(mesh, region);
    std::vector<char> vertices = region.mask();
    for (char& chosen : faces) chosen = !chosen;
    for (char& chosen : vertices) chosen = !chosen;
    return Extraction(mesh, std::move(faces), std::move(vertices)).take(context);
}

MeshPart extract_faces(const Mesh& mesh, std::span<const Index> faces, const Context& context) {
    require_faces(mesh.topology(), faces);
    Progress progress(context, "extract");
    const MemoryCharge working = room_for_part(mesh, context);
    std::vector<char> chosen(mesh.face_count(), 0);
    for (const Index f : faces) chosen[f] = 1;
    std::vector<char> none(mesh.vertex_count(), 0);
    return Extraction(mesh, std::move(chosen), std::move(none)).take(context);
}

}  // namespace lissom
