// From a sewn patch to the mesh.

#include <map>
#include <utility>

#include "kernel/merge/sew/seam_collar.h"
#include "kernel/merge/sew/seam_umbrella.h"
#include "kernel/merge/sew/seam_work.h"

namespace lissom {
namespace {

// The part of a vertex that must come from firm ones; rounding takes no half of it.
constexpr double kFirmShare = 0.499;

// The vertices of a loop that a place lies on or between.
std::vector<ElementMap::Source> sources_at(std::span<const Index> loop, Index offset,
                                           const LoopPoint& place) {
    const Index from = loop[place.segment] + offset;
    if (place.t == 0.0) return {{from, 1.0}};
    const std::size_t next = (at(place.segment) + 1) % loop.size();
    return {{from, 1.0 - place.t}, {loop[next] + offset, place.t}};
}

// For each vertex of the unconnected mesh its number in the result, or kNoIndex.
std::vector<Index> numbered(const SeamWork& work) {
    std::vector<Index> number;
    Index next = 0;
    for (Index v = 0; v < work.both.vertex_count(); ++v) {
        number.push_back(work.gone.contains(v) ? kNoIndex : next++);
    }
    return number;
}

// The elements of the result in their order.
class Assembly {
  public:
    Assembly(const SeamWork& work, const SeamFaces& patch, std::span<const Index> number)
        : work_(work), number_(number) {
        add_vertices(patch);
        std::map<Index, std::vector<const SeamFace*>> of_origin;
        for (const Index f : patch.origins()) of_origin[f];
        for (const SeamFace& face : patch.faces()) {
            if (!face.corners.empty()) of_origin[face.origin].push_back(&face);
        }
        auto next = of_origin.begin();
        for (Index f = 0; f < work.both.face_count(); ++f) {
            if (next == of_origin.end() || next->first != f) {
                add_old(f);
                continue;
            }
            for (const SeamFace* face : next->second) add_sewn(*face);
            ++next;
        }
    }

    FaceList faces;
    MeshMap map;
    Places place;
    std::vector<SeamSide> sides;
    std::vector<Vec3> positions;

  private:
    void add_vertices(const SeamFaces& patch) {
        const Topology& topology = work_.both.topology();
        positions.reserve(at(topology.vertex_count()));
        map.vertices.reserve(topology.vertex_count());
        map.faces.reserve(topology.face_count());
        map.corners.reserve(topology.corner_count());
        for (Index v = 0; v < work_.both.vertex_count(); ++v) {
            if (number_[v] == kNoIndex) continue;
            positions.push_back(work_.both.position(v));
            place.vertices.push_back(v);
            const auto seam = work_.sources.find(v);
            if (seam == work_.sources.end()) {
                map.vertices.add_copy(v);
            } else {
                map.vertices.add_blend(seam->second.blend());
            }
        }
        for (const auto& [v, position] : patch.moved()) {
            if (number_[v] != kNoIndex) positions[number_[v]] = position;
        }
    }

    void add_face(Index origin) {
        faces.add(vertices_);
        map.faces.add_copy(origin);
        place.faces.push_back(origin);
        sides.push_back(origin < work_.first_source_face ? SeamSide::target : SeamSide::source);
        vertices_.clear();
    }

    void add_old(Index f) {
        Index corner = work_.both.topology().first_corner(f);
        for (const Index v : work_.both.topology().face(f)) {
            vertices_.push_back(number_[v]);
            map.corners.add_copy(corner++);
        }
        add_face(f);
    }

    void add_sewn(const SeamFace& face) {
        for (const SeamCorner& corner : face.corners) {
            vertices_.push_back(number_[corner.vertex]);
            if (corner.second == kNoIndex) {
                map.corners.add_copy(corner.first);
                continue;
            }
            const ElementMap::Source ends[] = {{corner.first, 1.0 - corner.t},
                                               {corner.second, corner.t}};
            map.corners.add_blend(ends);
        }
        add_face(face.origin);
    }

    const SeamWork& work_;
    std::span<const Index> number_;
    std::vector<Index> vertices_;
};

}  // namespace

std::vector<Index> became_of(const Sewn& sewn, std::span<const Index> firm) {
    std::vector<Index> vertices;
    for (Index v = 0; v < sewn.mesh.vertex_count(); ++v) {
        // A collar makes vertices on the edges between firm ones.
        double share = 0.0;
        for (const ElementMap::Source& source : sewn.map.vertices[v]) {
            if (std::binary_search(firm.begin(), firm.end(), source.element)) {
                share += source.weight;
            }
        }
        if (share >= kFirmShare) vertices.push_back(v);
    }
    return vertices;
}

SeamSources sources_of(const SeamWork& work, const LoopPair& join, const LoopPoint& on_target,
                       const LoopPoint& on_source) {
    return {sources_at(join.target, 0, on_target),
            sources_at(join.source, work.first_source_vertex, on_source)};
}

Sewn finish(const SeamWork& work, const SeamFaces& faces, const SewOptions& options,
            const Context& context) {
    const std::vector<Index> number = numbered(work);
    Assembly assembly(work, faces, number);
    Sewn sewn;
    sewn.mesh = derive(work.both, std::move(assembly.positions), std::move(assembly.faces),
                       assembly.map, context);
    sewn.map = std::move(assembly.map);
    sewn.place = std::move(assembly.place);
    sewn.side_of_face = std::move(assembly.sides);
    for (Index v = 0; v < work.first_source_vertex; ++v) {
        sewn.first_source_vertex += number[v] == kNoIndex ? 0 : 1;
    }
    carry_seam_regions(work.both, work.sources, number, sewn.mesh);
    for (const std::vector<Index>& seam : work.seams) {
        sewn.seams.emplace_back();
        for (const Index v : seam) sewn.seams.back().push_back(number[v]);
    }
    sewn.report = work.report;
    sewn.report.before = seam_quality(sewn.mesh, sewn.seams);
    sewn.kept = options.kept;
    close_morphs(sewn.seams, sewn.side_of_face, sewn.mesh);
    if (options.collar) {
        make_collars(sewn, context);
        close_morphs(sewn.seams, sewn.side_of_face, sewn.mesh);
    }
    sewn.report.smoothed =
        smooth_seams(sewn.mesh, worked_seams(sewn), became_of(sewn, options.firm),
                     {options.smooth, options.guard}, context);
    if (options.flip && sewn.report.smoothed > 0) flip_near_seams(sewn, context);
    sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    return sewn;
}

}  // namespace lissom
