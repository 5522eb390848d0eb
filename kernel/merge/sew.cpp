#include "kernel/merge/sew.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "kernel/merge/seam_attributes.h"
#include "kernel/merge/seam_loop.h"
#include "kernel/merge/seam_patch.h"
#include "kernel/merge/seam_umbrella.h"

namespace lissom {
namespace {

// Dihedral angles up to this may arise from flips.
constexpr double kAllowedDihedral = 20.0 * kPi / 180.0;

void require_options(const SewOptions& options) {
    if (options.smooth < 0) {
        throw Error(ErrorCode::invalid_argument, "smooth must not be negative");
    }
    if (!(options.snap >= 0.0 && options.snap <= 1.0)) {
        throw Error(ErrorCode::invalid_argument, "snap must lie between 0 and 1");
    }
}

std::vector<Index> loop_vertices(std::span<const LoopPair> joins, Index first_source) {
    std::vector<Index> vertices;
    for (const LoopPair& join : joins) {
        vertices.insert(vertices.end(), join.target.begin(), join.target.end());
        for (const Index v : join.source) vertices.push_back(v + first_source);
    }
    return vertices;
}

// Sews along loops whose vertices become those of both sides. Elements have the numbers of the
// unconnected mesh until `finish`.
class ConformingSeam {
  public:
    ConformingSeam(const Mesh& both, Index first_source_vertex, Index first_source_face,
                   std::span<const LoopPair> joins, const SewOptions& options)
        : both_(both),
          options_(options),
          first_source_vertex_(first_source_vertex),
          first_source_face_(first_source_face),
          patch_(both, first_source_face, loop_vertices(joins, first_source_vertex)) {
        for (const LoopPair& join : joins) sew(join);
        patch_.close(seams_);
        if (options.flip) report_.flipped = patch_.flip_edges(kAllowedDihedral);
    }

    Sewn finish(const Context& context);

  private:
    void sew(const LoopPair& join);
    Index vertex_of(const LoopPair& join, const SeamVertex& v) const {
        return v.of_target ? join.target[v.on_target.segment] : source_vertex(join, v);
    }
    Index source_vertex(const LoopPair& join, const SeamVertex& v) const {
        return first_source_vertex_ + join.source[v.on_source.segment];
    }
    void split_target(const LoopPair& join, std::span<const SeamVertex> seam);
    void split_source(const LoopPair& join, std::span<const SeamVertex> seam);
    void note_sources(const LoopPair& join, std::span<const SeamVertex> seam);
    void number_vertices();
    MeshMap element_map(FaceList& faces, std::vector<SeamSide>& sides) const;
    std::vector<Vec3> positions(const ElementMap& vertices) const;

    const Mesh& both_;
    const SewOptions& options_;
    Index first_source_vertex_, first_source_face_;
    SeamPatch patch_;
    std::vector<std::vector<Index>> seams_;
    std::unordered_map<Index, SeamSources> sources_;
    std::unordered_set<Index> gone_;
    std::vector<Index> new_number_;
    SewReport report_;
};

// The vertices of a loop, or between two of them, that a place stands for.
std::vector<ElementMap::Source> sources_at(std::span<const Index> loop, Index offset,
                                           const LoopPoint& place) {
    const Index from = loop[place.segment] + offset;
    if (place.t == 0.0) return {{from, 1.0}};
    const std::size_t next = (static_cast<std::size_t>(place.segment) + 1) % loop.size();
    return {{from, 1.0 - place.t}, {loop[next] + offset, place.t}};
}

void ConformingSeam::sew(const LoopPair& join) {
    std::vector<Vec3> points;
    for (const Index v : join.target) points.push_back(both_.position(v));
    std::vector<SeamVertex> seam = seam_loop(join);
    report_.snapped += snap(seam, points, options_.snap);
    split_target(join, seam);
    split_source(join, seam);
    note_sources(join, seam);
    std::vector<Index> vertices;
    for (const SeamVertex& v : seam) {
        vertices.push_back(vertex_of(join, v));
        if (!v.of_target) patch_.move(vertices.back(), seam_point(points, v));
        if (!(v.of_target && v.of_source)) continue;
        patch_.merge_vertex(source_vertex(join, v), vertices.back());
        gone_.insert(source_vertex(join, v));
    }
    seams_.push_back(std::move(vertices));
}

void ConformingSeam::split_target(const LoopPair& join, std::span<const SeamVertex> seam) {
    for (std::size_t k = 0; k < seam.size();) {
        std::vector<Index> inserted;
        std::vector<double> fractions;
        const std::size_t from = k++;
        for (; k < seam.size() && !seam[k].of_target; ++k) {
            inserted.push_back(source_vertex(join, seam[k]));
            fractions.push_back(seam[k].on_target.t);
        }
        if (inserted.empty()) continue;
        patch_.split_edge(vertex_of(join, seam[from]), vertex_of(join, seam[k % seam.size()]),
                          inserted, fractions);
        report_.inserted_into_target += static_cast<Index>(inserted.size());
    }
}

// The source's faces see their boundary the other way round.
void ConformingSeam::split_source(const LoopPair& join, std::span<const SeamVertex> seam) {
    const std::size_t n = seam.size();
    std::size_t first = 0;
    while (!seam[first].of_source) ++first;
    for (std::size_t k = first; k < first + n;) {
        std::vector<Index> inserted;
        std::vector<double> fractions;
        const std::size_t from = k++;
        for (; !seam[k % n].of_source; ++k) {
            inserted.insert(inserted.begin(), join.target[seam[k % n].on_target.segment]);
            fractions.insert(fractions.begin(), 1.0 - seam[k % n].on_source.t);
        }
        if (inserted.empty()) continue;
        patch_.split_edge(source_vertex(join, seam[k % n]), source_vertex(join, seam[from % n]),
                          inserted, fractions);
        report_.inserted_into_source += static_cast<Index>(inserted.size());
    }
}

void ConformingSeam::note_sources(const LoopPair& join, std::span<const SeamVertex> seam) {
    for (const SeamVertex& v : seam) {
        sources_[vertex_of(join, v)] = {sources_at(join.target, 0, v.on_target),
                                        sources_at(join.source, first_source_vertex_, v.on_source)};
    }
}

void ConformingSeam::number_vertices() {
    Index next = 0;
    for (Index v = 0; v < both_.vertex_count(); ++v) {
        new_number_.push_back(gone_.contains(v) ? kNoIndex : next++);
    }
}

MeshMap ConformingSeam::element_map(FaceList& faces, std::vector<SeamSide>& sides) const {
    MeshMap map;
    for (Index v = 0; v < both_.vertex_count(); ++v) {
        if (new_number_[v] == kNoIndex) continue;
        const auto seam = sources_.find(v);
        if (seam == sources_.end()) {
            map.vertices.add_copy(v);
        } else {
            map.vertices.add_blend(seam->second.blend());
        }
    }
    const auto add_corner = [&](const SeamCorner& corner) {
        if (corner.second == kNoIndex) {
            map.corners.add_copy(corner.first);
        } else {
            const ElementMap::Source ends[] = {{corner.first, 1.0 - corner.t},
                                               {corner.second, corner.t}};
            map.corners.add_blend(ends);
        }
    };
    std::vector<std::size_t> order(patch_.faces().size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return patch_.faces()[a].origin < patch_.faces()[b].origin;
    });
    auto next = order.begin();
    std::vector<Index> vertices;
    for (Index f = 0; f < both_.face_count(); ++f) {
        const SeamSide side = f < first_source_face_ ? SeamSide::target : SeamSide::source;
        const auto add_face = [&] {
            faces.add(vertices);
            map.faces.add_copy(f);
            sides.push_back(side);
        };
        if (next == order.end() || patch_.faces()[*next].origin != f) {
            vertices.clear();
            for (const Index v : both_.topology().face(f)) vertices.push_back(new_number_[v]);
            for (Index c = both_.topology().first_corner(f);
                 c < both_.topology().first_corner(f + 1); ++c) {
                map.corners.add_copy(c);
            }
            add_face();
            continue;
        }
        for (; next != order.end() && patch_.faces()[*next].origin == f; ++next) {
            vertices.clear();
            for (const SeamCorner& corner : patch_.faces()[*next].corners) {
                vertices.push_back(new_number_[corner.vertex]);
                add_corner(corner);
            }
            add_face();
        }
    }
    return map;
}

std::vector<Vec3> ConformingSeam::positions(const ElementMap&) const {
    std::vector<Vec3> positions;
    for (Index v = 0; v < both_.vertex_count(); ++v) {
        if (new_number_[v] != kNoIndex) positions.push_back(patch_.position(v));
    }
    return positions;
}

Sewn ConformingSeam::finish(const Context& context) {
    number_vertices();
    Sewn sewn;
    FaceList faces;
    sewn.map = element_map(faces, sewn.side_of_face);
    sewn.mesh = derive(both_, positions(sewn.map.vertices), std::move(faces), sewn.map, context);
    carry_seam_regions(both_, sources_, new_number_, sewn.mesh);
    for (const std::vector<Index>& seam : seams_) {
        sewn.seams.emplace_back();
        for (const Index v : seam) sewn.seams.back().push_back(new_number_[v]);
    }
    report_.before = seam_quality(sewn.mesh, sewn.seams);
    smooth_seams(patch_, options_.smooth);
    std::vector<Index> moved;
    for (const auto& [v, position] : patch_.moved()) {
        if (new_number_[v] == kNoIndex) continue;
        sewn.mesh.set_position(new_number_[v], position);
        moved.push_back(new_number_[v]);
    }
    for (const std::vector<Index>& seam : sewn.seams) {
        moved.insert(moved.end(), seam.begin(), seam.end());
    }
    renew_normals(sewn.mesh, moved);
    report_.after = seam_quality(sewn.mesh, sewn.seams);
    sewn.report = report_;
    return sewn;
}

}  // namespace

Sewn sew(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins,
         const SewOptions& options, const Context& context) {
    require_options(options);
    require_joins(target.topology(), source.topology(), joins);
    Progress progress(context, "sew");
    const Mesh both = unconnected(target, source, context);
    ConformingSeam seam(both, target.vertex_count(), target.face_count(), joins, options);
    return seam.finish(context);
}

}  // namespace lissom
