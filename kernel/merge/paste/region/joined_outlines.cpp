#include "kernel/merge/paste/region/joined_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "kernel/merge/loop/face_angles.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/query/front_distances.h"
#include "kernel/mesh/query/path.h"

namespace lissom {
namespace {

// Rings of faces on either side of the shortest way that a strip has at least, and those of them
// that are its middle: the others are the ring around that.
constexpr Index kStripRings = 2, kMiddleRings = 1;

// Whether one of the faces meets the set.
bool lies_beside(const FaceSet& set, std::span<const Index> faces) {
    return std::any_of(faces.begin(), faces.end(), [&](Index f) {
        const std::span<const Index> face = set.topology().face(f);
        return std::any_of(face.begin(), face.end(), [&](Index v) {
            const auto around = set.topology().faces_around(v);
            return std::any_of(around.begin(), around.end(),
                               [&](Index g) { return set.contains(g); });
        });
    });
}

// The surface outside the set around one of its outlines, and the way from that to the next one.
class Between {
  public:
    Between(const Mesh& mesh, const FaceSet& set, const std::vector<Index>& outline,
            const Context& context)
        : context_(context), part_(extract_faces(mesh, around(set, outline), context)) {
        for (std::size_t k = 0; k < part_.vertex_map.size(); ++k) {
            places_[part_.vertex_map[k]].push_back(index_of(k));
        }
        first_ = here(outline);
        from_first_ = front_distances(part_.mesh, first_, kFar, context);
    }

    // The vertex of an outline that is nearest to the first one, in the part; kNoIndex if no way
    // leads there.
    Index nearest_of(std::span<const Index> outline) const {
        Index nearest = kNoIndex;
        for (const Index v : here(outline)) {
            if (!std::isfinite(distance(v))) continue;
            if (nearest == kNoIndex || distance(v) < distance(nearest)) nearest = v;
        }
        return nearest;
    }
    double distance(Index v) const { return from_first_[at(v)]; }

    // Faces of the mesh from the first outline to the one that has vertex `end`: those that a
    // detour of at most `radius` to the side of the shortest way reaches.
    std::vector<Index> strip(std::span<const Index> outline, Index end, double radius) const {
        const std::vector<double> from_other =
            front_distances(part_.mesh, here(outline), kFar, context_);
        const double half = 0.5 * distance(end) + radius;
        const double longest = 2.0 * (std::hypot(half, radius) - radius);
        std::vector<char> chosen(at(part_.mesh.vertex_count()), 0);
        for (std::size_t v = 0; v < chosen.size(); ++v) {
            chosen[v] = from_first_[v] + from_other[v] <= longest;
        }
        for (const Index v : shortest_way(end)) chosen[at(v)] = 1;
        return faces_of(chosen);
    }

    // Faces of the mesh within so many rings of the shortest way.
    std::vector<Index> along_way(Index end, Index rings) const {
        const Region way(part_.mesh.shared_topology(), shortest_way(end));
        std::vector<char> chosen(at(part_.mesh.vertex_count()), 0);
        for (const Index v : way.grown(rings).vertices()) chosen[at(v)] = 1;
        return faces_of(chosen);
    }

  private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();

    static std::vector<Index> around(const FaceSet& set, std::span<const Index> outline) {
        for (std::vector<Index>& part : set.outside_parts(nullptr)) {
            const FaceSet members(set.topology(), part);
            const bool touches = std::any_of(outline.begin(), outline.end(), [&](Index v) {
                const auto fan = set.topology().faces_around(v);
                return std::any_of(fan.begin(), fan.end(),
                                   [&](Index f) { return members.contains(f); });
            });
            if (touches) return std::move(part);
        }
        return {};
    }

    std::vector<Index> here(std::span<const Index> outline) const {
        std::vector<Index> found;
        for (const Index v : outline) {
            const auto place = places_.find(v);
            if (place == places_.end()) continue;
            found.insert(found.end(), place->second.begin(), place->second.end());
        }
        return found;
    }

    std::vector<Index> shortest_way(Index end) const {
        const auto nearer = [&](Index a, Index b) {
            return (part_.mesh.position(a) - part_.mesh.position(end)).squaredNorm() <
                   (part_.mesh.position(b) - part_.mesh.position(end)).squaredNorm();
        };
        const Index start = *std::min_element(first_.begin(), first_.end(), nearer);
        return path_through(part_.mesh, std::array{start, end}, false, context_).vertices();
    }

    std::vector<Index> faces_of(std::span<const char> chosen) const {
        std::vector<Index> faces;
        for (Index f = 0; f < part_.mesh.face_count(); ++f) {
            const std::span<const Index> face = part_.mesh.topology().face(f);
            if (std::all_of(face.begin(), face.end(),
                            [&](Index v) { return chosen[at(v)] != 0; })) {
                faces.push_back(part_.face_map[at(f)]);
            }
        }
        return faces;
    }

    const Context& context_;
    MeshPart part_;
    std::unordered_map<Index, std::vector<Index>> places_;
    std::vector<Index> first_;
    std::vector<double> from_first_;
};

// The outline other than the first that is nearest to it, and its vertex there.
struct NextOutline {
    std::size_t number = 0;
    Index end = kNoIndex;
};
std::optional<NextOutline> next_outline(const Between& between,
                                        std::span<const std::vector<Index>> outlines) {
    std::optional<NextOutline> next;
    for (std::size_t k = 1; k < outlines.size(); ++k) {
        const Index end = between.nearest_of(outlines[k]);
        if (end == kNoIndex) continue;
        if (!next || between.distance(end) < between.distance(next->end)) next = {k, end};
    }
    return next;
}

// Adds a strip; returns its middle, empty if no way leads to another outline.
std::vector<Index> join_two(const Mesh& mesh, FaceSet& set,
                            std::span<const std::vector<Index>> outlines, const Context& context) {
    const Between between(mesh, set, outlines.front(), context);
    const std::optional<NextOutline> next = next_outline(between, outlines);
    if (!next) return {};
    const std::vector<Index>& other = outlines[next->number];
    const double radius =
        std::min(outline_length(mesh, outlines.front()), outline_length(mesh, other)) / (2.0 * kPi);
    for (const Index f : between.strip(other, next->end, radius)) set.add(f);
    for (const Index f : between.along_way(next->end, kStripRings)) set.add(f);
    set.grow_at_bow_ties(nullptr);
    fill_islands(set, nullptr);
    return between.along_way(next->end, kMiddleRings);
}

}  // namespace

double outline_length(const Mesh& mesh, std::span<const Index> loop) {
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        sum += (mesh.position(loop[(k + 1) % loop.size()]) - mesh.position(loop[k])).norm();
    }
    return sum;
}

std::vector<std::vector<Index>> inner_outlines(const FaceSet& set) {
    const Topology& topology = set.topology();
    std::vector<std::vector<Index>> loops = set.loops();
    std::erase_if(loops, [&](const std::vector<Index>& loop) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Index a = loop[k], b = loop[(k + 1) % loop.size()];
            if (face_left_of(topology, b, a) != kNoIndex) return false;
        }
        return true;
    });
    return loops;
}

void fill_islands(FaceSet& set, const FaceSet* bounds) {
    std::vector<std::vector<Index>> outside = set.outside_parts(bounds);
    std::erase_if(outside, [&](const auto& part) { return !lies_beside(set, part); });
    for (std::size_t k = 1; k < outside.size(); ++k) {
        for (const Index f : outside[k]) set.add(f);
    }
}

std::vector<Index> join_outlines(const Mesh& mesh, FaceSet& set, const Context& context) {
    std::vector<Index> middles;
    for (auto outlines = inner_outlines(set); outlines.size() > 1;) {
        context.checkpoint();
        const std::vector<Index> middle = join_two(mesh, set, outlines, context);
        if (middle.empty()) return middles;
        middles.insert(middles.end(), middle.begin(), middle.end());
        const std::size_t before = outlines.size();
        outlines = inner_outlines(set);
        if (outlines.size() >= before) return middles;
    }
    return middles;
}

}  // namespace lissom
