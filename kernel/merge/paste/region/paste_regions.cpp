#include "kernel/merge/paste/region/paste_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "kernel/core/error.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/region/joined_outlines.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

// Steps by which a disk that does not close on itself is sought, down to a hundredth of its size.
constexpr double kDiskShrink = 0.85;
constexpr int kDiskShrinks = 28;

// Factor by which the share of a sought ring is made smaller, and the least share that is tried.
constexpr double kNarrowerShare = 0.6, kMinShare = 0.05;

Elements vertices_named(std::span<const Index> vertices) {
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : vertices) elements.add(v);
    return elements;
}

Elements faces_named(std::span<const Index> faces) {
    Elements elements{ElementKind::face, 0, {}};
    for (const Index f : faces) elements.add(f);
    return elements;
}

// Keeps, of several parts, the one with most faces of `wanted`; of equals the largest.
void keep_one_part(FaceSet& set, std::span<const Index> wanted) {
    const std::vector<std::vector<Index>> parts = set.parts();
    const FaceSet marked(set.topology(), wanted);
    const auto held = [&](const std::vector<Index>& part) {
        return std::count_if(part.begin(), part.end(), [&](Index f) { return marked.contains(f); });
    };
    std::size_t best = 0;
    for (std::size_t k = 1; k < parts.size(); ++k) {
        if (held(parts[k]) > held(parts[best])) best = k;
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (k == best) continue;
        for (const Index f : parts[k]) set.remove(f);
    }
}

// The faces from the first part to the nearest other one, by the fewest faces inside `bounds`.
std::vector<Index> bridge(const FaceSet& set, const FaceSet& bounds,
                          const std::vector<Index>& first) {
    const Topology& topology = set.topology();
    std::vector<Index> from(at(topology.face_count()), kNoIndex), queue = first;
    for (const Index f : first) from[at(f)] = f;
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const Index f = queue[i];
        const std::span<const Index> face = topology.face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index g = face_left_of(topology, face[(k + 1) % face.size()], face[k]);
            if (g == kNoIndex || from[at(g)] != kNoIndex || !bounds.contains(g)) continue;
            from[at(g)] = f;
            if (!set.contains(g)) {
                queue.push_back(g);
                continue;
            }
            std::vector<Index> way;
            for (Index step = f; from[at(step)] != step; step = from[at(step)]) way.push_back(step);
            return way;
        }
    }
    return {};
}

void join_parts(FaceSet& feature, const FaceSet& region, const Context& context) {
    for (auto parts = feature.parts(); parts.size() > 1; parts = feature.parts()) {
        context.checkpoint();
        const std::vector<Index> way = bridge(feature, region, parts.front());
        for (const Index f : way) feature.add(f);
        if (way.empty()) return;
    }
}

FaceSet clean_region(const Mesh& source, const Region& region, std::span<const Index> seed,
                     const char* name) {
    FaceSet set(source.topology(), region.faces());
    if (set.size() == 0) {
        throw Error(ErrorCode::region_empty, std::string("the ") + name +
                                                 " holds no face: mark all vertices of the faces "
                                                 "that belong to it");
    }
    keep_one_part(set, seed);
    set.grow_at_bow_ties(nullptr);
    fill_islands(set, nullptr);
    return set;
}

// Vertices of the set's longest outline.
std::vector<Index> outline_of(const FaceSet& set) {
    const std::vector<std::vector<Index>> outlines = inner_outlines(set);
    return outlines.empty() ? std::vector<Index>() : outlines.front();
}

// The faces of a region, and those along the middle of the strips that join its outlines.
struct MarkedRegion {
    FaceSet faces;
    std::vector<Index> middles;

    bool joined() const { return !middles.empty(); }
};

FaceSet deep_faces(const Mesh& source, const FaceSet& region, double share,
                   const Context& context) {
    if (!(share > 0.0 && share < 1.0)) {
        throw Error(ErrorCode::invalid_argument, "the ring's share must lie between 0 and 1");
    }
    const std::vector<Index> outline = outline_of(region);
    if (outline.empty()) {
        throw Error(ErrorCode::region_empty,
                    "the region has no outline inside its mesh; mark a part of the surface only");
    }
    const std::vector<double> distance =
        edge_distances(source, outline, std::numeric_limits<double>::infinity(), context);
    double deepest = 0.0;
    for (const Index f : region.faces()) {
        for (const Index v : source.topology().face(f)) {
            if (std::isfinite(distance[at(v)])) deepest = std::max(deepest, distance[at(v)]);
        }
    }
    // A feature that stands out is deep itself: the ring is no wider than the outline allows.
    double around = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        around += (source.position(outline[(k + 1) % outline.size()]) - source.position(outline[k]))
                      .norm();
    }
    deepest = std::min(deepest, around / (2.0 * kPi));
    FaceSet deep(source.topology(), {});
    for (const Index f : region.faces()) {
        const std::span<const Index> face = source.topology().face(f);
        if (std::all_of(face.begin(), face.end(),
                        [&](Index v) { return distance[at(v)] > share * deepest; })) {
            deep.add(f);
        }
    }
    keep_one_part(deep, {});
    return deep;
}

// Open boundaries inside the region, and the faces around them, belong to the feature that is
// sought, unless they touch the region's outline.
void add_open_boundaries(const FaceSet& region, FaceSet& feature) {
    const Topology& topology = region.topology();
    const std::vector<Index> outline = outline_of(region);
    std::vector<char> outer(at(topology.vertex_count()), 0);
    for (const Index v : outline) outer[at(v)] = 1;
    for (const std::vector<Index>& loop : region.loops()) {
        std::vector<Index> around;
        bool apart = true;
        for (const Index v : loop) {
            for (const Index f : topology.faces_around(v)) {
                const std::span<const Index> face = topology.face(f);
                apart = apart && region.contains(f) &&
                        std::none_of(face.begin(), face.end(),
                                     [&](Index n) { return outer[at(n)] != 0; });
                around.push_back(f);
            }
        }
        if (!apart) continue;
        for (const Index f : around) feature.add(f);
    }
}

// The faces of the feature as marked, or those that are deep in the region; with the middle of the
// strips that join its outlines.
FaceSet marked_feature(const Mesh& source, const MarkedRegion& region, const PasteMarks& marks,
                       double share, const Context& context) {
    FaceSet set(source.topology(), {});
    if (!marks.feature || region.joined()) set = deep_faces(source, region.faces, share, context);
    for (const Index f : region.middles) set.add(f);
    if (!marks.feature) {
        add_open_boundaries(region.faces, set);
        return set;
    }
    for (const Index f : marks.feature->faces()) set.add(f);
    return set;
}

// The faces of a region that do not touch its outline.
FaceSet without_rim(const FaceSet& region) {
    FaceSet inside = region;
    for (const Index v : outline_of(region)) {
        for (const Index f : region.topology().faces_around(v)) {
            if (inside.contains(f)) inside.remove(f);
        }
    }
    return inside;
}

FaceSet clean_feature(const FaceSet& region, FaceSet set, const Context& context) {
    for (const Index f : set.faces()) {
        if (!region.contains(f)) set.remove(f);
    }
    if (set.size() == 0) {
        throw Error(ErrorCode::region_empty,
                    "the feature holds no face of the region; mark a feature inside the region");
    }
    join_parts(set, without_rim(region), context);
    join_parts(set, region, context);
    set.grow_at_bow_ties(&region);
    fill_islands(set, &region);
    return set;
}

void require_apart(std::span<const Index> outer, const FaceSet& feature) {
    std::vector<Index> touching;
    for (const Index v : outer) {
        const auto around = feature.topology().faces_around(v);
        if (std::any_of(around.begin(), around.end(),
                        [&](Index f) { return feature.contains(f); })) {
            touching.push_back(v);
        }
    }
    if (touching.empty()) return;
    const Elements elements = vertices_named(touching);
    throw Error(ErrorCode::boundary_conflict,
                "the feature touches the outline of its region at " + describe(elements) +
                    "; mark a larger region or a smaller feature, so that a ring lies between them",
                elements);
}

std::string sizes_of(const std::vector<std::vector<Index>>& loops) {
    std::string text;
    for (const std::vector<Index>& loop : loops) {
        text += (text.empty() ? "" : ", ") + std::to_string(loop.size());
    }
    return text;
}

void require_annulus(const FaceSet& ring) {
    const std::vector<std::vector<Index>> loops = ring.loops();
    const Index chi = ring.euler_characteristic();
    if (loops.size() == 2 && chi == 0 && ring.parts().size() == 1) return;
    const Elements elements = vertices_named(loops.empty() ? std::vector<Index>() : loops.back());
    const std::string found = loops.size() == 2 && chi != 0
                                  ? "has a handle"
                                  : "has " + std::to_string(loops.size()) + " boundaries, of " +
                                        sizes_of(loops) + " vertices";
    throw Error(ErrorCode::not_a_disk,
                "the ring between the feature and the outline of its region " + found +
                    " and must have two and no handle; take holes and handles into the feature, "
                    "or leave them out of the region; the smallest is at " +
                    describe(elements),
                elements);
}

bool is_disk(const FaceSet& set) {
    return set.loops().size() == 1 && set.euler_characteristic() == 1;
}

// Whether the surroundings of a connected set without bow-ties are certainly connected: beside its
// one loop there are faces everywhere, which meet from each vertex of it to the next.
bool has_no_islands(const FaceSet& set) {
    const std::vector<std::vector<Index>> loops = set.loops();
    return loops.size() == 1 && std::none_of(loops[0].begin(), loops[0].end(), [&](Index v) {
               return set.topology().is_boundary(v);
           });
}

void require_disk(const FaceSet& set) {
    const std::vector<std::vector<Index>> loops = set.loops();
    if (is_disk(set)) return;
    // A closed surface has no boundary to name.
    const Elements elements =
        loops.empty() ? faces_named(set.faces()) : vertices_named(loops.back());
    throw Error(ErrorCode::not_a_disk,
                "the region of the target has " + std::to_string(loops.size()) + " boundaries (" +
                    sizes_of(loops) + " vertices) and Euler characteristic " +
                    std::to_string(set.euler_characteristic()) +
                    "; it must be a disk: leave holes and handles out of it, or fill them first; " +
                    (loops.empty() ? "it is closed, of " : "the smallest is at ") +
                    describe(elements),
                elements);
}

MarkedRegion marked_region(const Mesh& source, const PasteMarks& marks, const Context& context) {
    const std::vector<Index> seed = marks.feature ? marks.feature->faces() : std::vector<Index>();
    MarkedRegion region{clean_region(source, marks.region, seed, "region"), {}};
    if (marks.join_outlines) region.middles = join_outlines(source, region.faces, context);
    return region;
}

PasteRegions regions_around(const MarkedRegion& region, const FaceSet& core) {
    const FaceSet& whole = region.faces;
    PasteRegions result;
    result.outer = outline_of(whole);
    require_apart(result.outer, core);
    FaceSet ring = whole;
    for (const Index f : core.faces()) ring.remove(f);
    if (ring.size() == 0 || result.outer.empty()) {
        throw Error(ErrorCode::region_empty,
                    "there is no ring around the feature; mark a region that is larger than it");
    }
    require_annulus(ring);
    result.region = whole.faces();
    result.feature = core.faces();
    result.ring = ring.faces();
    result.inner = outline_of(core);
    result.joined = region.joined();
    return result;
}

PasteRegions regions_with(const Mesh& source, const MarkedRegion& region, const PasteMarks& marks,
                          double share, const Context& context) {
    return regions_around(
        region, clean_feature(region.faces, marked_feature(source, region, marks, share, context),
                              context));
}

// Shares of a sought ring in the order that they are tried: that asked for, narrower ones, which
// leave more of the handles of the surface to the feature, and wider ones, whose feature keeps away
// from an outline that is drawn in somewhere.
std::vector<double> shares_from(double asked) {
    std::vector<double> shares{asked};
    if (!(asked > 0.0 && asked < 1.0)) return shares;
    while (shares.back() * kNarrowerShare >= kMinShare) {
        shares.push_back(shares.back() * kNarrowerShare);
    }
    for (double inside = 1.0 - asked; inside * kNarrowerShare >= kMinShare;) {
        inside *= kNarrowerShare;
        shares.push_back(1.0 - inside);
    }
    return shares;
}

// Whether another ring may be possible.
bool depends_on_ring(ErrorCode code) {
    return code == ErrorCode::not_a_disk || code == ErrorCode::boundary_conflict ||
           code == ErrorCode::region_empty;
}

}  // namespace

PasteRegions paste_regions(const Mesh& source, const PasteMarks& marks, const Context& context) {
    require_same_topology(source, marks.region.topology(), "the region");
    if (marks.feature) require_same_topology(source, marks.feature->topology(), "the feature");
    const MarkedRegion region = marked_region(source, marks, context);
    const bool sought = !marks.feature || region.joined();
    if (!sought) return regions_with(source, region, marks, marks.share, context);
    std::optional<Error> first;
    const auto attempt = [&](const auto& make) -> std::optional<PasteRegions> {
        try {
            return make();
        } catch (const Error& error) {
            if (!depends_on_ring(error.code())) throw;
            if (!first) first = error;
            return std::nullopt;
        }
    };
    for (const double share : shares_from(marks.share)) {
        const auto found =
            attempt([&] { return regions_with(source, region, marks, share, context); });
        if (found) return *found;
    }
    // All but the faces at the outline, if handles and holes come that close to it.
    const auto all = attempt([&] {
        return regions_around(region,
                              clean_feature(region.faces, without_rim(region.faces), context));
    });
    if (all) return *all;
    throw Error(*first);
}

std::vector<Index> outlined_faces(const Mesh& mesh, const Region& region, const Context& context) {
    context.checkpoint();
    require_same_topology(mesh, region.topology(), "the region");
    const FaceSet set = clean_region(mesh, region, {}, "region");
    if (!outline_of(set).empty()) return set.faces();
    throw Error(ErrorCode::region_empty,
                "the region has no outline inside its mesh; mark a part of the surface only");
}

std::vector<Index> target_faces(const Mesh& target, const Region& onto, const Context& context) {
    context.checkpoint();
    require_same_topology(target, onto.topology(), "the target's region");
    const FaceSet set = clean_region(target, onto, {}, "target's region");
    require_disk(set);
    return set.faces();
}

std::vector<Index> disk_around(const Mesh& target, const SurfacePoint& point, double radius,
                               const Context& context) {
    const std::vector<double> distance = edge_distances(target, point, radius, context);
    const Topology& topology = target.topology();
    for (int step = 0;; ++step, radius *= kDiskShrink) {
        context.checkpoint();
        FaceSet set(topology, {});
        for (Index f = 0; f < topology.face_count(); ++f) {
            const std::span<const Index> face = topology.face(f);
            if (f == point.face || std::all_of(face.begin(), face.end(), [&](Index v) {
                    return distance[at(v)] <= radius;
                })) {
                set.add(f);
            }
        }
        const Index seed[] = {point.face};
        keep_one_part(set, seed);
        set.grow_at_bow_ties(nullptr);
        // Far faces are read only if they must be.
        if (!has_no_islands(set)) fill_islands(set, nullptr);
        if (is_disk(set)) return set.faces();
        if (step == kDiskShrinks) require_disk(set);
    }
}

}  // namespace lissom
