#include "kernel/merge/paste/scatter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "kernel/core/memory_error.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/part/target_bite.h"
#include "kernel/merge/paste/scatter_verdict.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/edit/append.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/finer_near.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {
namespace {

// Width of a place's disk over that of the ring on it, if there is room; paths along edges are up
// to 1.4 times as long as the surface is wide.
constexpr double kPlaceRoom = 1.5, kMinRoom = 0.66, kSmallerDisk = 0.85;
// Edges of the target that a disk is wider than that: the collar of a seam takes up to two if the
// part is much denser, the faces beside it must stay as they are, those that reach beyond the disk
// are not in it, and edges grow longer on the way.
constexpr double kSeamRoom = 5.0;

// Edges of the target within this many times a part's reach are halved if they are longer than the
// first of these parts of it, until none is longer than the second.
constexpr double kFineRoom = 2.0, kCoarseEdge = 0.6, kFineEdge = 0.3;
// A part that crosses something is made smaller by this, as often as that.
constexpr double kShrink = 0.8;
constexpr int kShrinks = 3;
// A place on a sharp edge itself, in reaches of its part, does not tell to which side it may go;
// one that moves goes this far away from the edge.
constexpr double kOnEdge = 0.02, kClearOfEdge = 1.15;

// A mesh while it is put together: for each vertex its origin in the mesh before, which several may
// share, and for each face the place it belongs to.
struct Piece {
    Mesh mesh;
    std::vector<Index> same, place;
};

std::vector<Index> reachable_faces(const Mesh& mesh, std::span<const Index> place,
                                   std::span<const double> distance, Index start, double radius) {
    const Topology& topology = mesh.topology();
    const auto counts = [&](Index f) {
        if (place[at(f)] != kNoIndex) return false;
        const std::span<const Index> face = topology.face(f);
        return f == start || std::all_of(face.begin(), face.end(),
                                         [&](Index v) { return distance[at(v)] <= radius; });
    };
    std::vector<Index> faces{start};
    std::vector<char> seen(at(mesh.face_count()), 0);
    seen[at(start)] = 1;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const std::span<const Index> face = topology.face(faces[i]);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index g = face_left_of(topology, face[(k + 1) % face.size()], face[k]);
            if (g == kNoIndex || seen[at(g)] || !counts(g)) continue;
            seen[at(g)] = 1;
            faces.push_back(g);
        }
    }
    return faces;
}

// Longest edge of the faces around a face.
double longest_edge_at(const Mesh& mesh, Index face) {
    double longest = 0.0;
    for (const Index v : mesh.topology().face(face)) {
        for (const Index n : mesh.topology().neighbors(v)) {
            longest = std::max(longest, (mesh.position(n) - mesh.position(v)).norm());
        }
    }
    return longest;
}

// The largest disk of faces without parts around a face, within `radius` and no narrower than
// `least`; empty if there is none.
std::vector<Index> free_disk(const Piece& current, Index start, double radius, double least,
                             const Context& context) {
    const Topology& topology = current.mesh.topology();
    const std::vector<double> distance =
        edge_distances(current.mesh, topology.face(start), radius, context);
    for (; radius >= least; radius *= kSmallerDisk) {
        std::vector<Index> faces =
            reachable_faces(current.mesh, current.place, distance, start, radius);
        FaceSet set(topology, faces);
        set.grow_at_bow_ties(nullptr);
        faces = set.faces();
        const bool free = std::all_of(faces.begin(), faces.end(),
                                      [&](Index f) { return current.place[at(f)] == kNoIndex; });
        if (free && set.euler_characteristic() == 1 && set.loops().size() == 1) return faces;
    }
    return {};
}

// One place that is pasted in this round: its disk, and then the result of the paste.
struct PlaceWork {
    Index place = kNoIndex;
    MeshPart disk;
    Piece result;
    // Why the part is not good.
    std::vector<MergeReason> reasons = {};
};

[[noreturn]] void refuse_room() {
    throw Error(ErrorCode::boundary_conflict,
                "there is no room for the seam between parts, or beside the border of the target; "
                "choose a smaller scale or places that are farther apart");
}

// New edges from rim to rim might be there outside the disk.
void require_no_chords(const Topology& disk, const Topology& made, std::span<const Index> kept) {
    std::vector<Index> old(at(made.vertex_count()), kNoIndex);
    for (Index v = 0; v < disk.vertex_count(); ++v) {
        if (disk.is_boundary(v)) old[at(kept[at(v)])] = v;
    }
    for (Index v = 0; v < made.vertex_count(); ++v) {
        if (old[at(v)] == kNoIndex) continue;
        const auto before = disk.neighbors(old[at(v)]);
        for (const Index n : made.neighbors(v)) {
            const Index other = old[at(n)];
            if (other == kNoIndex) continue;
            if (std::find(before.begin(), before.end(), other) == before.end()) refuse_room();
        }
    }
}

// The rim of a disk must come out of a paste unchanged, since the rest meets it there.
void require_rim(const Topology& disk, const Mesh& made, std::span<const Index> kept) {
    for (const std::vector<Index>& loop : disk.boundary_loops()) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Index a = kept[at(loop[k])], b = kept[at(loop[(k + 1) % loop.size()])];
            const bool there = a != kNoIndex && b != kNoIndex &&
                               face_left_of(made.topology(), a, b) != kNoIndex &&
                               face_left_of(made.topology(), b, a) == kNoIndex;
            if (!there) refuse_room();
        }
    }
    require_no_chords(disk, made.topology(), kept);
}

// For each vertex of a disk the new one that is nothing but it, or kNoIndex. Elements of the
// feature are numbered after those of the disk.
std::vector<Index> kept_of_disk(const ElementMap& map, Index count) {
    std::vector<Index> kept(at(count), kNoIndex);
    for (Index v = 0; v < map.size(); ++v) {
        if (map[v].size() != 1) continue;
        const Index from = map[v].front().element;
        if (from < count && kept[at(from)] == kNoIndex) kept[at(from)] = v;
    }
    return kept;
}

Piece pasted_disk(const PasteSource& feature, PlaceWork& work, const PastePlacement& placement,
                  const ScatterOptions& options, const Context& context) {
    const Mesh& disk = work.disk.mesh;
    Paste paste = feature.on(disk, Region::all(disk.shared_topology()), placement, context);
    if (options.iterations > 0) paste.optimize(options.iterations, context);
    MergeResult merged = paste.merge(options.merge, context).merged;
    work.reasons = std::move(merged.report.reasons);
    const std::vector<Index> kept = kept_of_disk(merged.provenance.vertices, disk.vertex_count());
    require_rim(disk.topology(), merged.mesh, kept);
    Piece piece{std::move(merged.mesh), {}, {}};
    piece.same.assign(at(piece.mesh.vertex_count()), kNoIndex);
    for (Index v = 0; v < disk.vertex_count(); ++v) {
        if (disk.topology().is_boundary(v)) {
            piece.same[at(kept[at(v)])] = work.disk.vertex_map[at(v)];
        }
    }
    for (const SeamSide side : merged.side_of_face) {
        piece.place.push_back(side == SeamSide::source ? work.place : kNoIndex);
    }
    return piece;
}

Piece joined_pieces(Piece first, const Piece& second, const Context& context) {
    append(first.mesh, second.mesh, context);
    first.same.insert(first.same.end(), second.same.begin(), second.same.end());
    first.place.insert(first.place.end(), second.place.begin(), second.place.end());
    return first;
}

// All pieces as one, by halves: each element is copied a few times only.
Piece joined_pieces(std::vector<Piece> pieces, const Context& context) {
    for (std::size_t step = 1; step < pieces.size(); step *= 2) {
        for (std::size_t i = 0; i + step < pieces.size(); i += 2 * step) {
            pieces[i] = joined_pieces(std::move(pieces[i]), pieces[i + step], context);
            pieces[i + step] = {};
        }
    }
    return std::move(pieces.front());
}

// Vertices that are the same become one, the first of them.
Piece welded(Piece piece, const Context& context) {
    const Topology& topology = piece.mesh.topology();
    std::unordered_map<Index, Index> known;
    std::vector<Index> number(piece.same.size(), kNoIndex), copies;
    std::vector<Vec3> positions;
    for (Index v = 0; v < topology.vertex_count(); ++v) {
        const Index same = piece.same[at(v)];
        if (same != kNoIndex) {
            const auto [found, is_new] = known.try_emplace(same, index_of(copies.size()));
            number[at(v)] = found->second;
            if (!is_new) continue;
        }
        number[at(v)] = index_of(copies.size());
        copies.push_back(v);
        positions.push_back(piece.mesh.position(v));
    }
    FaceList faces;
    for (Index f = 0; f < topology.face_count(); ++f) {
        std::vector<Index> face;
        for (const Index v : topology.face(f)) face.push_back(number[at(v)]);
        faces.add(face);
    }
    const MeshMap map{ElementMap::copies(copies), ElementMap::identity(topology.corner_count()),
                      ElementMap::identity(topology.face_count())};
    Piece result{derive(piece.mesh, std::move(positions), std::move(faces), map, context), {}, {}};
    result.same.assign(copies.size(), kNoIndex);
    result.place = std::move(piece.place);
    return result;
}

// The mesh with the results in its disks.
Piece put_together(const Piece& current, std::vector<PlaceWork> works, const Context& context) {
    std::vector<char> gone(at(current.mesh.face_count()), 0),
        rim(at(current.mesh.vertex_count()), 0);
    for (const PlaceWork& work : works) {
        for (const Index f : work.disk.face_map) gone[at(f)] = 1;
        for (Index v = 0; v < work.disk.mesh.vertex_count(); ++v) {
            if (work.disk.mesh.topology().is_boundary(v)) rim[at(work.disk.vertex_map[at(v)])] = 1;
        }
    }
    std::vector<Index> kept;
    Piece rest;
    for (Index f = 0; f < current.mesh.face_count(); ++f) {
        if (gone[at(f)]) continue;
        kept.push_back(f);
        rest.place.push_back(current.place[at(f)]);
    }
    MeshPart part = extract_faces(current.mesh, kept, context);
    for (const Index v : part.vertex_map) rest.same.push_back(rim[at(v)] ? v : kNoIndex);
    rest.mesh = std::move(part.mesh);
    std::vector<Piece> pieces;
    pieces.push_back(std::move(rest));
    for (PlaceWork& work : works) pieces.push_back(std::move(work.result));
    return welded(joined_pieces(std::move(pieces), context), context);
}

// Faults that spoil a scatter of many parts.
bool is_grave(MergeFault fault) {
    return fault == MergeFault::bite || fault == MergeFault::folds;
}

std::string refusal_for(const MergeReason& reason) {
    return reason.fault == MergeFault::bite ? "its part would bite into a sharp edge of the target"
                                            : "its part would fold beside the seam";
}

// The point of sharp edges nearest to a point. Lines of edges shorter than half a reach are grain.
Vec3 nearest_edge_point(std::span<const SharpEdge> edges, const Vec3& point, double reach) {
    Vec3 nearest = point;
    double least = std::numeric_limits<double>::infinity();
    for (const SharpEdge& edge : edges) {
        if (edge.line < 0.5 * reach) continue;
        const Vec3 found = nearest_point_of(edge, point);
        const double square = (found - point).squaredNorm();
        if (!(square < least)) continue;
        least = square;
        nearest = found;
    }
    return nearest;
}

class Scatterer {
  public:
    /// `crosses` tells whether the feature crosses itself on its source.
    Scatterer(const PasteSource& feature, const Mesh& target,
              std::span<const PastePlacement> places, const ScatterOptions& options, bool crosses,
              const Context& context)
        : feature_(feature),
          places_(places.begin(), places.end()),
          options_(options),
          crosses_itself_(crosses),
          shrinks_(places.size(), 0),
          moved_(places.size(), 0),
          faults_(places.size()),
          edges_(sharp_edges(target, context)) {
        current_.mesh = with_room(target, context);
        current_.same.assign(at(current_.mesh.vertex_count()), kNoIndex);
        current_.place.assign(at(current_.mesh.face_count()), kNoIndex);
        base_.emplace(target, context);
        for (Index i = 0; i < count_of(places); ++i) waiting_.push_back(i);
    }

    ScatterResult run(const Context& context) {
        Progress progress(context, "scatter");
        while (!waiting_.empty()) {
            const auto all = static_cast<double>(places_.size());
            progress.update(1.0 - static_cast<double>(waiting_.size()) / all);
            std::vector<PlaceWork> works = chosen(context);
            paste_all(works, context);
            if (works.empty()) continue;
            current_ = without_crossings(std::move(works), context);
            ++result_.rounds;
        }
        note_altered();
        std::sort(result_.refused.begin(), result_.refused.end(),
                  [](const auto& a, const auto& b) { return a.place < b.place; });
        result_.mesh = std::move(current_.mesh);
        result_.place_of_face = std::move(current_.place);
        judge_scatter(result_, count_of(places_));
        return std::move(result_);
    }

  private:
    void refuse(Index place, ErrorCode code, const std::string& message) {
        result_.refused.push_back({place, code, message});
    }

    Mesh with_room(const Mesh& target, const Context& context) const {
        if (places_.empty()) return target;
        const SpatialTree tree(target, context);
        std::vector<FinePlace> fine;
        for (const PastePlacement& place : places_) {
            const SurfacePoint point = tree.nearest(place.at);
            const double reach = feature_.reach(place.scale);
            fine.push_back({point.face, point.position, kFineRoom * reach, kCoarseEdge * reach,
                            kFineEdge * reach});
        }
        std::optional<FinerMesh> finer = finer_near(target, fine, context);
        if (finer) return std::move(finer->mesh);
        return target;
    }

    // The mesh with the parts of a round, but for those that cross something.
    Piece without_crossings(std::vector<PlaceWork> works, const Context& context) {
        Piece next = put_together(current_, works, context);
        const std::vector<std::pair<Index, Index>> pairs = crossings_of(next, works, context);
        if (options_.crossings == ScatterCrossings::keep) {
            result_.crossings += count_of(pairs);
            return next;
        }
        if (pairs.empty()) return next;
        for (const auto& [place, other] : pairs) give_way(works, place, other);
        std::sort(waiting_.begin(), waiting_.end());
        return works.empty() ? std::move(current_)
                             : put_together(current_, std::move(works), context);
    }

    // For each pair of crossing faces, the place that gives way, of two the one that comes later,
    // and the place that it crosses.
    std::vector<std::pair<Index, Index>> crossings_of(const Piece& piece,
                                                      const std::vector<PlaceWork>& works,
                                                      const Context& context) const {
        std::vector<char> is_new(places_.size(), 0);
        for (const PlaceWork& work : works) is_new[at(work.place)] = 1;
        SelfIntersectionOptions options;
        options.faces.emplace();
        for (Index f = 0; f < piece.mesh.face_count(); ++f) {
            const Index place = piece.place[at(f)];
            if (place != kNoIndex && is_new[at(place)]) options.faces->push_back(f);
        }
        std::vector<std::pair<Index, Index>> pairs;
        for (const FacePair& pair : self_intersections(piece.mesh, options, context)) {
            Index place = piece.place[at(pair.first)], other = piece.place[at(pair.second)];
            if (place == other && crosses_itself_) continue;
            const bool gives_way = place != kNoIndex && is_new[at(place)] &&
                                   (other == kNoIndex || !is_new[at(other)] || other < place);
            if (!gives_way) std::swap(place, other);
            pairs.emplace_back(place, other);
        }
        return pairs;
    }

    // Leaves a place out of this round: it waits to be tried smaller, or is refused.
    void give_way(std::vector<PlaceWork>& works, Index place, Index other) {
        const auto work = std::find_if(works.begin(), works.end(),
                                       [&](const PlaceWork& w) { return w.place == place; });
        if (work == works.end()) return;
        works.erase(work);
        const std::string what = other == kNoIndex ? "the target"
                                 : other == place  ? "itself"
                                                   : "that of place " + std::to_string(other + 1);
        shrink_or_refuse(place, "its part would run through " + what);
    }

    void shrink_or_refuse(Index place, const std::string& reason) {
        const bool smaller = options_.crossings == ScatterCrossings::shrink;
        if (smaller && shrinks_[at(place)] < kShrinks) {
            ++shrinks_[at(place)];
            places_[at(place)].scale *= kShrink;
            waiting_.push_back(place);
            return;
        }
        refuse(place, ErrorCode::boundary_conflict, reason);
    }

    // Whether a part may stand: it waits for another try, or is refused, if it may not.
    bool stands(const PlaceWork& work) {
        faults_[at(work.place)] = work.reasons;
        if (options_.crossings == ScatterCrossings::keep) return true;
        const auto grave =
            std::find_if(work.reasons.begin(), work.reasons.end(),
                         [](const MergeReason& reason) { return is_grave(reason.fault); });
        if (grave == work.reasons.end()) return true;
        if (grave->fault == MergeFault::bite && move_off_edge(work.place)) return false;
        shrink_or_refuse(work.place, refusal_for(*grave));
        return false;
    }

    // Moves a place once, away from the nearest sharp edge until its part does not reach that.
    bool move_off_edge(Index place) {
        if (options_.crossings != ScatterCrossings::shrink || moved_[at(place)]) return false;
        moved_[at(place)] = 1;
        PastePlacement& placement = places_[at(place)];
        const std::optional<Vec3> away = away_from_edges(placement);
        if (!away) return false;
        placement.at = *away;
        waiting_.push_back(place);
        return true;
    }

    std::optional<Vec3> away_from_edges(const PastePlacement& placement) const {
        const double reach = feature_.reach(placement.scale);
        const Vec3 from = base_->nearest(placement.at).position;
        const Vec3 edge = nearest_edge_point(edges_, from, reach);
        const Vec3 way = from - edge;
        if (!(way.norm() > kOnEdge * reach) || way.norm() > kClearOfEdge * reach) return {};
        return base_->nearest(edge + kClearOfEdge * reach * way.normalized()).position;
    }

    void note_altered() {
        std::vector<char> refused(places_.size(), 0);
        for (const RefusedPlace& one : result_.refused) refused[at(one.place)] = 1;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (refused[i]) continue;
            ++result_.placed;
            const Index place = index_of(i);
            if (shrinks_[i] > 0) result_.shrunk.push_back({place, places_[i].scale});
            if (moved_[i]) result_.moved.push_back({place, places_[i].at});
            if (!faults_[i].empty()) result_.faulty.push_back({place, std::move(faults_[i])});
        }
    }

    // Waiting places whose disks do not meet those of ones before them.
    std::vector<PlaceWork> chosen(const Context& context) {
        const SpatialTree tree(current_.mesh, context);
        std::vector<char> claimed(at(current_.mesh.face_count()), 0);
        std::vector<PlaceWork> works;
        std::vector<Index> later;
        for (const Index i : waiting_) {
            const std::vector<Index> faces = disk_at(tree, i, context);
            if (faces.empty()) continue;
            const bool meets = std::any_of(faces.begin(), faces.end(),
                                           [&](Index f) { return claimed[at(f)] != 0; });
            for (const Index f : faces) claimed[at(f)] = 1;
            if (meets) {
                later.push_back(i);
            } else {
                works.push_back({i, extract_faces(current_.mesh, faces, context), {}});
            }
        }
        waiting_ = std::move(later);
        return works;
    }

    // Empty if the place is refused.
    std::vector<Index> disk_at(const SpatialTree& tree, Index i, const Context& context) {
        const PastePlacement& placement = places_[at(i)];
        const SurfacePoint point = tree.nearest(placement.at);
        if (current_.place[at(point.face)] != kNoIndex) {
            refuse(i, ErrorCode::boundary_conflict,
                   "the part of place " + std::to_string(current_.place[at(point.face)] + 1) +
                       " is there already");
            return {};
        }
        const double reach = feature_.reach(placement.scale);
        const double radius =
            kPlaceRoom * reach + kSeamRoom * longest_edge_at(current_.mesh, point.face);
        std::vector<Index> faces =
            free_disk(current_, point.face, radius, kMinRoom * reach, context);
        if (faces.empty()) {
            refuse(i, ErrorCode::not_a_disk, "the surface around it is no disk between parts");
        }
        return faces;
    }

    // Those that fail are refused.
    void paste_all(std::vector<PlaceWork>& works, const Context& context) {
        std::vector<PlaceWork> done;
        for (PlaceWork& work : works) {
            context.checkpoint();
            try {
                work.result =
                    pasted_disk(feature_, work, places_[at(work.place)], options_, context);
                if (stands(work)) done.push_back(std::move(work));
            } catch (const Error& error) {
                if (error.code() == ErrorCode::cancelled ||
                    error.code() == ErrorCode::memory_limit) {
                    throw;
                }
                refuse(work.place, error.code(), error.what());
            }
        }
        works = std::move(done);
        std::sort(waiting_.begin(), waiting_.end());
    }

    const PasteSource& feature_;
    std::vector<PastePlacement> places_;
    const ScatterOptions& options_;
    bool crosses_itself_;
    // How often each place was made smaller.
    std::vector<int> shrinks_;
    // Whether each was moved, or may not be any more.
    std::vector<char> moved_;
    std::vector<std::vector<MergeReason>> faults_;
    // Sharp edges of the target as given, and its surface.
    std::vector<SharpEdge> edges_;
    std::optional<SpatialTree> base_;
    Piece current_;
    std::vector<Index> waiting_;
    ScatterResult result_;
};

void check_scatter(std::span<const PastePlacement> places, const ScatterOptions& options) {
    require(!options.paste.clear && !options.paste.cleared,
            "a target is not cleared for many parts at once; erase its features first");
    require(!options.merge.draft, "many parts are not pasted as drafts");
    require(options.iterations >= 0, "a search takes 0 iterations or more");
    for (const PastePlacement& placement : places) {
        require(placement.scale > 0.0 && std::isfinite(placement.scale),
                "the scale of a placement must be above 0");
        if (placement.at.allFinite()) continue;
        throw Error(ErrorCode::not_finite, "the point of a placement is NaN or infinite");
    }
}

}  // namespace

ScatterResult scatter(const Mesh& source, const Mesh& target, const Region& region,
                      const std::optional<Region>& feature, std::span<const PastePlacement> places,
                      const ScatterOptions& options, const Context& context) try {
    check_scatter(places, options);
    if (target.face_count() == 0) {
        throw Error(ErrorCode::mesh_empty, "parts cannot be scattered over a mesh without faces");
    }
    const PasteSource part(source, region, feature, options.paste, context);
    SelfIntersectionOptions marked;
    marked.faces = region.faces();
    const bool crosses = !self_intersections(source, marked, context).empty();
    return Scatterer(part, target, places, options, crosses, context).run(context);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

}  // namespace lissom
