// The mesh with the vertices that a refinement of coarse borders inserted.
#include <algorithm>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/mesh/derive.h"

namespace lissom {
namespace {

class RefinedMesh {
  public:
    RefinedMesh(const Mesh& mesh, const Patch& patch)
        : mesh_(mesh), topology_(mesh.topology()), patch_(patch) {
        for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
            part_of_.emplace_back(patch.triangles.face[t], t);
            const Triangle& corners = patch.triangles.triangle[t];
            if (std::any_of(corners.begin(), corners.end(),
                            [&](Index v) { return v >= patch.mesh_count(); })) {
                refined_.push_back(patch.triangles.face[t]);
            }
        }
        std::sort(part_of_.begin(), part_of_.end());
        std::sort(refined_.begin(), refined_.end());
    }

    Mesh build(std::vector<Vec3> positions, const Context& context) {
        map_.vertices = ElementMap::identity(topology_.vertex_count());
        for (const SparseRow& row : patch_.inserted) {
            map_.vertices.add_blend(sources(row, [&](Index v) { return patch_.mesh_vertex[v]; }));
        }
        for (Index f = 0; f < topology_.face_count(); ++f) {
            if (std::binary_search(refined_.begin(), refined_.end(), f)) {
                add_triangles(f);
            } else {
                copy_face(f);
            }
        }
        return derive(mesh_, std::move(positions), std::move(faces_), map_, context);
    }

  private:
    template <typename Element>
    static std::vector<ElementMap::Source> sources(const SparseRow& row, const Element& element) {
        std::vector<ElementMap::Source> result;
        for (const auto& [v, c] : row) result.push_back({element(v), c});
        return result;
    }

    void copy_face(Index f) {
        const auto corners = count_of(topology_.face(f));
        faces_.add(topology_.face(f));
        map_.faces.add_copy(f);
        for (Index k = 0; k < corners; ++k) map_.corners.add_copy(topology_.first_corner(f) + k);
    }

    // Every vertex of a triangle is a mean of corners of the face that the triangle is part of.
    void add_triangles(Index f) {
        const std::span<const Index> face = topology_.face(f);
        const auto corner = [&](Index v) {
            const auto at = std::find(face.begin(), face.end(), patch_.mesh_vertex[v]);
            return topology_.first_corner(f) + index_of(at - face.begin());
        };
        auto part =
            std::lower_bound(part_of_.begin(), part_of_.end(), std::pair(f, std::size_t{0}));
        for (; part != part_of_.end() && part->first == f; ++part) {
            std::vector<Index> vertices;
            for (const Index v : patch_.triangles.triangle[part->second]) {
                const Index beyond = v - patch_.mesh_count();
                if (beyond < 0) {
                    vertices.push_back(patch_.mesh_vertex[v]);
                    map_.corners.add_copy(corner(v));
                } else {
                    vertices.push_back(topology_.vertex_count() + beyond);
                    map_.corners.add_blend(sources(patch_.inserted[beyond], corner));
                }
            }
            faces_.add(vertices);
            map_.faces.add_copy(f);
        }
    }

    const Mesh& mesh_;
    const Topology& topology_;
    const Patch& patch_;
    /// Each triangle with its face, in the order of faces; the faces with inserted vertices.
    std::vector<std::pair<Index, std::size_t>> part_of_;
    std::vector<Index> refined_;
    FaceList faces_;
    MeshMap map_;
};

}  // namespace

Mesh subdivided_mesh(Deformer& deformer, const Mesh& mesh, const Context& given) {
    auto& s = DeformerAccess::state(deformer);
    const Context& context = s.chosen(given);
    return with_memory_errors([&] {
        Mesh deformed = mesh;
        deformer.apply_to(deformed);
        const std::shared_ptr<const WorkingPatch> work =
            s.shown->patch ? s.shown->patch : s.prepare(context)->work;
        const Patch& patch = work->patch;
        if (patch.inserted.empty()) return deformed;
        const std::span<const Vec3> own = deformed.positions();
        std::vector<Vec3> positions(own.begin(), own.end());
        if (s.shown->patch) {
            positions.insert(positions.end(), s.shown->inserted.begin(), s.shown->inserted.end());
        } else {
            for (Index v = patch.mesh_count(); v < patch.real_count; ++v) {
                positions.push_back(patch.rest[v] + patch.origin);
            }
        }
        return RefinedMesh(deformed, patch).build(std::move(positions), context);
    });
}

}  // namespace lissom
