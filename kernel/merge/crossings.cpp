#include "kernel/merge/crossings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/merge/crossings/hidden_crossings.h"
#include "kernel/merge/crossings/shallow_crossings.h"
#include "kernel/merge/sew/seam_guard.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

// Within this many radii of a seam, faces cross because of the seam.
constexpr double kAtSeam = 1.0;
// In radii of a seam: of 33 groups of crossings in 80 merges of real models, those that cannot be
// seen (lips, eyelids, folds of a neck) part by .005, others by .02 or not by .05.
constexpr double kShallow = 0.01;
// Rings of faces that the line slides over along which separate parts cross, as one of them bends.
constexpr int kPartsSlide = 3;

// The faces of the source, which is deformed, and those of the target that were made or moved.
std::vector<Index> changed_faces(const Mesh& target, const Sewn& sewn) {
    const auto is_same = [&](Index v) {
        const auto sources = sewn.map.vertices[v];
        return sources.size() == 1 && sources.front().element < target.vertex_count() &&
               sewn.mesh.position(v) == target.position(sources.front().element);
    };
    const auto stays = [&](Index f) {
        const std::span<const Index> face = sewn.mesh.topology().face(f);
        const std::span<const Index> old = target.topology().face(sewn.map.faces.main_source(f));
        if (face.size() != old.size()) return false;
        for (std::size_t k = 0; k < face.size(); ++k) {
            if (!is_same(face[k]) || sewn.map.vertices.main_source(face[k]) != old[k]) return false;
        }
        return true;
    };
    std::vector<Index> faces;
    for (Index f = 0; f < sewn.mesh.face_count(); ++f) {
        if (sewn.side_of_face[f] == SeamSide::source || !stays(f)) faces.push_back(f);
    }
    return faces;
}

// Those of the targets and of the source as they are, among the given faces: of the targets, then
// of the source.
std::vector<FacePair> own_intersections(const Mesh& target, const Mesh& source,
                                        const std::vector<Index>& origins, const Context& context) {
    std::vector<FacePair> result;
    Index shift = 0;
    for (const Mesh* mesh : {&target, &source}) {
        std::vector<Index> faces;
        for (const Index f : origins) {
            if (f >= shift && f < shift + mesh->face_count()) faces.push_back(f - shift);
        }
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        if (!faces.empty()) {
            for (const FacePair& pair : self_intersections(*mesh, {faces, faces}, context)) {
                result.push_back({pair.first + shift, pair.second + shift});
            }
        }
        shift += mesh->face_count();
    }
    return result;
}

// Whether vertices lie within one radius of a seam.
std::vector<char> near_seams(const Sewn& sewn, const Context& context) {
    std::vector<char> near(at(sewn.mesh.vertex_count()), 0);
    for (const std::vector<Index>& seam : sewn.seams) {
        const double reach = kAtSeam * loop_radius(sewn.mesh, seam);
        const std::vector<double> distance = edge_distances(sewn.mesh, seam, reach, context);
        for (std::size_t v = 0; v < near.size(); ++v) near[v] |= distance[v] <= reach ? 1 : 0;
    }
    return near;
}

bool touches(const Mesh& mesh, const std::vector<char>& near, Index f) {
    const std::span<const Index> face = mesh.topology().face(f);
    return std::any_of(face.begin(), face.end(), [&](Index v) { return near[at(v)] != 0; });
}

// Tells which pairs of faces of the sides at rest, in the numbers of the unconnected mesh, a pair
// of the merged mesh comes from.
class Origins {
  public:
    Origins(const Mesh& target, const Mesh& source, const Sewn& sewn, const Context& context)
        : old_(target.topology()),
          other_(source.topology()),
          sewn_(sewn),
          near_(near_seams(sewn, context)) {}

    std::vector<Index> of(Index f) const {
        if (sewn_.side_of_face[at(f)] == SeamSide::target) {
            return origin_faces(old_, sewn_.mesh.topology(), sewn_.map, f);
        }
        std::vector<Index> faces = origin_faces(other_, sewn_.mesh.topology(), sewn_.map, f,
                                                {old_.face_count(), old_.corner_count()});
        for (Index& face : faces) face += old_.face_count();
        return faces;
    }

    bool is_source(Index f) const { return sewn_.side_of_face[at(f)] == SeamSide::source; }

    // Separate parts move each as a whole while the others bend; away from a seam the source bends
    // by itself. The line along which it crosses itself slides over so many rings of faces.
    int slide(const FacePair& pair) const {
        if (!is_source(pair.first) || !is_source(pair.second)) return 0;
        if (part(of(pair.first).front()) != part(of(pair.second).front())) return kPartsSlide;
        const bool near =
            touches(sewn_.mesh, near_, pair.first) || touches(sewn_.mesh, near_, pair.second);
        return near ? 0 : 1;
    }

    // The part of the source that a face at rest belongs to.
    Index part(Index f) const {
        return other_.components()[at(other_.face(f - old_.face_count())[0])];
    }

    // The faces next to some, `rings` times.
    std::vector<Index> around(std::vector<Index> faces, int rings) const {
        for (int i = 0; i < rings; ++i) faces = around(faces);
        return faces;
    }

    std::vector<Index> around(std::span<const Index> faces) const {
        std::vector<Index> result;
        for (const Index f : faces) {
            for (const Index v : other_.face(f - old_.face_count())) {
                for (const Index g : other_.faces_around(v)) {
                    result.push_back(g + old_.face_count());
                }
            }
        }
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

  private:
    const Topology& old_;
    const Topology& other_;
    const Sewn& sewn_;
    std::vector<char> near_;
};

// Parts of the source without a joined boundary that ran through another at rest, such as handles
// stuck into a body: the target takes the place of that body, and they are stuck into it.
class StuckParts {
  public:
    StuckParts(const Mesh& source, const Sewn& sewn, const Origins& origins, const Context& context)
        : joined_(at(components_of(source)), 0), stuck_(joined_.size(), 0) {
        for (const std::vector<Index>& seam : sewn.seams) {
            for (const Index v : seam) {
                for (const Index f : sewn.mesh.topology().faces_around(v)) {
                    if (!origins.is_source(f)) continue;
                    joined_[at(origins.part(origins.of(f).front()))] = 1;
                }
            }
        }
        note_stuck(source, context);
    }

    // Whether one face is of such a part and the other of the target.
    bool explain(const FacePair& pair, const Origins& origins) const {
        const bool first = origins.is_source(pair.first), second = origins.is_source(pair.second);
        if (first == second) return false;
        return stuck_[at(origins.part(origins.of(first ? pair.first : pair.second).front()))] != 0;
    }

  private:
    static Index components_of(const Mesh& source) {
        Index count = 0;
        for (const Index c : source.topology().components()) count = std::max(count, c + 1);
        return count;
    }

    void note_stuck(const Mesh& source, const Context& context) {
        const std::vector<Index>& part = source.topology().components();
        std::vector<Index> loose;
        for (Index f = 0; f < source.face_count(); ++f) {
            if (!joined_[at(part[at(source.topology().face(f)[0])])]) loose.push_back(f);
        }
        if (loose.empty()) return;
        for (const FacePair& pair : self_intersections(source, {loose, std::nullopt}, context)) {
            const Index a = part[at(source.topology().face(pair.first)[0])];
            const Index b = part[at(source.topology().face(pair.second)[0])];
            if (a == b) continue;
            for (const Index c : {a, b}) stuck_[at(c)] = joined_[at(c)] ? 0 : 1;
        }
    }

    std::vector<char> joined_, stuck_;
};

// The faces at rest that a pair of the merged mesh may have crossed as.
struct RestPair {
    std::vector<Index> first, second;
};

RestPair rest_pair(const Origins& origins, const FacePair& pair) {
    RestPair rest{origins.of(pair.first), origins.of(pair.second)};
    const int rings = origins.slide(pair);
    if (rings == 0) return rest;
    return {origins.around(std::move(rest.first), rings),
            origins.around(std::move(rest.second), rings)};
}

bool is_among(const std::vector<FacePair>& known, const RestPair& rest) {
    for (const Index a : rest.first) {
        for (const Index b : rest.second) {
            const FacePair own{std::min(a, b), std::max(a, b)};
            if (std::binary_search(known.begin(), known.end(), own)) return true;
        }
    }
    return false;
}

CrossingPlace place_of(const Sewn& sewn, const std::vector<char>& near, const FacePair& pair) {
    if (touches(sewn.mesh, near, pair.first) || touches(sewn.mesh, near, pair.second)) {
        return CrossingPlace::seam;
    }
    const SeamSide first = sewn.side_of_face[at(pair.first)];
    if (first != sewn.side_of_face[at(pair.second)]) return CrossingPlace::between;
    return first == SeamSide::source ? CrossingPlace::source : CrossingPlace::target;
}

double smallest_radius(const Sewn& sewn) {
    double least = INFINITY;
    for (const std::vector<Index>& seam : sewn.seams) {
        least = std::min(least, loop_radius(sewn.mesh, seam));
    }
    return least;
}

std::vector<Index> faces_of(std::span<const FacePair> pairs) {
    std::vector<Index> faces;
    for (const FacePair& pair : pairs) {
        faces.push_back(pair.first);
        faces.push_back(pair.second);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
}

Vec3 middle_of_faces(const Mesh& mesh, std::span<const Index> faces) {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const Index f : faces) {
        for (const Index v : mesh.topology().face(f)) {
            sum += mesh.position(v);
            count += 1.0;
        }
    }
    return count > 0.0 ? Vec3(sum / count) : sum;
}

}  // namespace

Crossings new_crossings(const Mesh& target, const Mesh& source, const Sewn& sewn,
                        const Context& context) {
    Crossings found{
        self_intersections(sewn.mesh, {changed_faces(target, sewn), std::nullopt}, context), 0};
    if (found.pairs.empty()) return found;
    const Origins origins(target, source, sewn, context);
    std::vector<RestPair> rest;
    std::vector<Index> concerned;
    for (const FacePair& pair : found.pairs) {
        rest.push_back(rest_pair(origins, pair));
        for (const std::vector<Index>* faces : {&rest.back().first, &rest.back().second}) {
            concerned.insert(concerned.end(), faces->begin(), faces->end());
        }
    }
    const std::vector<FacePair> before = own_intersections(target, source, concerned, context);
    std::vector<FacePair> fresh;
    for (std::size_t k = 0; k < rest.size(); ++k) {
        if (!is_among(before, rest[k])) fresh.push_back(found.pairs[k]);
    }
    if (!fresh.empty()) {
        const StuckParts stuck(source, sewn, origins, context);
        std::erase_if(fresh, [&](const FacePair& pair) { return stuck.explain(pair, origins); });
    }
    found.known = count_of(found.pairs) - count_of(fresh);
    found.pairs = std::move(fresh);
    return found;
}

std::vector<CrossingGroup> crossing_groups(const Sewn& sewn, std::span<const FacePair> pairs,
                                           const Context& context) {
    if (pairs.empty()) return {};
    const std::vector<char> near = near_seams(sewn, context);
    const std::vector<char> hidden = hidden_pairs(sewn.mesh, pairs, context);
    using Kind = std::pair<CrossingPlace, bool>;
    std::map<Kind, std::vector<FacePair>> grouped;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        grouped[{place_of(sewn, near, pairs[k]), hidden[k] != 0}].push_back(pairs[k]);
    }
    std::vector<CrossingGroup> result;
    for (const auto& [kind, members] : grouped) {
        CrossingGroup group{kind.first, count_of(members), faces_of(members)};
        group.middle = middle_of_faces(sewn.mesh, group.faces);
        group.hidden = kind.second;
        group.shallow = is_shallow(sewn.mesh, members, kShallow * smallest_radius(sewn), context);
        result.push_back(std::move(group));
    }
    return result;
}

}  // namespace lissom
