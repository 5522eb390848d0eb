#include "kernel/merge/paste/erase/erase_feature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/paste/erase/domed_patch.h"
#include "kernel/merge/paste/erase/patch_values.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/region/joined_outlines.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/distances.h"

namespace lissom {
namespace {

// Steps by which a ring that is none is made narrower, how often, and the rings of edges that are
// tried then.
constexpr double kNarrower = 0.7;
constexpr int kNarrowings = 5;
constexpr Index kFewestRings = 2;
// A patch that turns less than this is even, whatever another one does.
constexpr double kEvenTurn = 15.0 * kDegree;
// A patch that turns more than this, and than the surface around it, shows; it is made this many
// times as dense then.
constexpr double kSteepPatch = 30.0 * kDegree;
constexpr double kDensities[] = {1.0, 2.0, 4.0};
// Curvature is continued if it varies, around the cut, by less than this part of its mean.
constexpr double kEvenCurvature = 0.05;
constexpr Index kRimRings = 3;
// A surface that has turned away by more than this is another side of a crease.
constexpr double kReliefCrease = 60.0 * kDegree;
// Times that curvatures are averaged with those around.
constexpr int kCurvatureAverages = 2;

void check_options(const EraseOptions& options) {
    require(options.ring >= 0.0 && std::isfinite(options.ring),
            "the width of the ring around a region must be 0 or more");
    require(options.bend >= 0.0 && std::isfinite(options.bend),
            "the weight of curvature must be 0 or more");
    require(options.maximum_vertices >= 0, "maximum_vertices must be 0 or more");
}

double outline_radius(const Mesh& mesh, const Region& region) {
    double longest = 0.0;
    for (const std::vector<Index>& loop : region.boundaries()) {
        longest = std::max(longest, outline_length(mesh, loop));
    }
    return longest / (2.0 * kPi);
}

// A band around the surface has two outlines, of which a cut can follow one only.
void require_one_outline(const Mesh& mesh, std::span<const Index> region) {
    std::vector<std::vector<Index>> loops = FaceSet(mesh.topology(), region).loops();
    std::erase_if(loops, [&](const std::vector<Index>& loop) {
        return std::all_of(loop.begin(), loop.end(),
                           [&](Index v) { return mesh.topology().is_boundary(v); });
    });
    if (loops.size() == 1) return;
    Elements elements{ElementKind::vertex, 0, {}};
    for (const Index v : loops.back()) elements.add(v);
    throw Error(ErrorCode::not_a_disk,
                "the surface around the region has " + std::to_string(loops.size()) +
                    " outlines and must have one; mark a part that does not run around the "
                    "surface; the smallest is at " +
                    describe(elements),
                elements);
}

struct Surrounded {
    PasteRegions regions;
    double width = 0.0;
};

// Elements that an erasure may take beside its region: distances from that, infinite beyond the
// ring and across creases.
class ErasureReach {
  public:
    ErasureReach(const Mesh& mesh, const Region& region, double width, const Context& context)
        : mesh_(mesh),
          width_(width),
          distance_(edge_distances(mesh, region.vertices(), width, context)),
          origin_(at(mesh.vertex_count()), kNoIndex) {
        const std::vector<char> marked = region.mask();
        std::vector<Index> near;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (marked[at(v)]) origin_[at(v)] = v;
            if (!marked[at(v)] && distance_[at(v)] <= width) near.push_back(v);
        }
        std::stable_sort(near.begin(), near.end(),
                         [&](Index a, Index b) { return distance_[at(a)] < distance_[at(b)]; });
        find_normals(region);
        for (const Index v : near) go_on_to(v);
    }

    bool holds(Index v) const { return origin_[at(v)] != kNoIndex; }
    double distance(Index v) const {
        return holds(v) ? distance_[at(v)] : std::numeric_limits<double>::infinity();
    }
    bool holds_all(std::span<const Index> vertices) const {
        return std::all_of(vertices.begin(), vertices.end(), [&](Index v) { return holds(v); });
    }

    // Takes a part of the surface that the region runs around, if all of it lies within the ring:
    // its creases are the feature's own, as at the tip of a horn.
    void take_island(std::span<const Index> faces) {
        const auto is_near = [&](Index v) { return distance_[at(v)] <= width_; };
        for (const Index f : faces) {
            const std::span<const Index> face = mesh_.topology().face(f);
            if (!std::all_of(face.begin(), face.end(), is_near)) return;
        }
        for (const Index f : faces) {
            for (const Index v : mesh_.topology().face(f)) {
                if (!holds(v)) origin_[at(v)] = v;
            }
        }
    }

  private:
    // The region's own side counts if its outline runs along a crease.
    void find_normals(const Region& region) {
        normals_ = vertex_normals(mesh_);
        std::vector<Vec3> own(normals_.size(), Vec3::Zero());
        for (const Index f : region.faces()) {
            const Vec3 area = area_vector(mesh_, f);
            for (const Index v : mesh_.topology().face(f)) own[at(v)] += area;
        }
        for (std::size_t v = 0; v < own.size(); ++v) {
            if (own[v].squaredNorm() > 0.0) normals_[v] = own[v].stableNormalized();
        }
    }

    // From a neighbour that is held, unless the surface has turned away since the region.
    void go_on_to(Index v) {
        Index nearest = kNoIndex;
        for (const Index n : mesh_.topology().neighbors(v)) {
            if (!holds(n) || !(distance_[at(n)] < distance_[at(v)])) continue;
            if (turns_away(origin_[at(n)], v)) continue;
            if (nearest == kNoIndex || distance_[at(n)] < distance_[at(nearest)]) nearest = n;
        }
        if (nearest != kNoIndex) origin_[at(v)] = origin_[at(nearest)];
    }

    bool turns_away(Index origin, Index v) const {
        const Vec3& up = normals_[at(origin)];
        const bool falls = (mesh_.position(v) - mesh_.position(origin)).dot(up) < 0.0;
        return falls && up.dot(normals_[at(v)]) < std::cos(kReliefCrease);
    }

    const Mesh& mesh_;
    double width_;
    std::vector<double> distance_;
    std::vector<Index> origin_;
    std::vector<Vec3> normals_;
};

// The region with a ring around it: as wide as was asked for, or as there is, but for `narrower`
// steps.
Surrounded surrounded(const Mesh& mesh, const Region& region, const ErasureReach& reach,
                      double width, int narrower_steps, const Context& context) {
    width *= std::pow(kNarrower, narrower_steps);
    for (int step = narrower_steps;; ++step, width *= kNarrower) {
        std::vector<Index> near;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (reach.distance(v) <= width) near.push_back(v);
        }
        const Region fewest = region.grown(kFewestRings);
        const Region around = step > kNarrowings
                                  ? fewest
                                  : Region(mesh.shared_topology(), std::move(near)).united(fewest);
        try {
            Surrounded found{paste_regions(mesh, {around, region}, context), width};
            require_one_outline(mesh, found.regions.region);
            return found;
        } catch (const Error& error) {
            const ErrorCode code = error.code();
            const bool narrower = code == ErrorCode::not_a_disk ||
                                  code == ErrorCode::boundary_conflict ||
                                  code == ErrorCode::region_empty;
            if (!narrower || step > kNarrowings) throw;
        }
    }
}

// |k1| + |k2| at a vertex: the angles at its edges times their lengths, over the area around it.
double curvature_at(const Mesh& mesh, Index v) {
    double turn = 0.0, area = 0.0;
    for (const Index n : mesh.topology().neighbors(v)) {
        turn += edge_dihedral(mesh, v, n) * (mesh.position(n) - mesh.position(v)).norm();
    }
    for (const Index f : mesh.topology().faces_around(v)) area += area_vector(mesh, f).norm() / 6.0;
    return area > 0.0 ? 0.5 * turn / area : 0.0;
}

// Costs of the ring's edges; infinite at open boundaries, which a patch cannot replace. So are they
// beyond the reach of the erasure.
std::vector<double> cut_costs(const Mesh& mesh, const LoopSearch& ring, const ErasureReach& reach,
                              double scale) {
    std::vector<double> curvature(at(mesh.vertex_count()), 0.0);
    std::vector<char> counts(curvature.size(), 0);
    for (const auto& [a, b] : ring.edges()) counts[at(a)] = counts[at(b)] = 1;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (counts[at(v)]) curvature[at(v)] = curvature_at(mesh, v);
    }
    for (int round = 0; round < kCurvatureAverages; ++round) {
        std::vector<double> sum = curvature, weight(curvature.size(), 1.0);
        for (const auto& [a, b] : ring.edges()) {
            sum[at(a)] += curvature[at(b)];
            sum[at(b)] += curvature[at(a)];
            ++weight[at(a)];
            ++weight[at(b)];
        }
        for (std::size_t v = 0; v < sum.size(); ++v) curvature[v] = sum[v] / weight[v];
    }
    std::vector<double> costs;
    for (const auto& [a, b] : ring.edges()) {
        const bool open = mesh.topology().is_boundary(a) || mesh.topology().is_boundary(b) ||
                          !reach.holds(a) || !reach.holds(b);
        const double bent = 0.5 * (curvature[at(a)] + curvature[at(b)]);
        costs.push_back(open ? std::numeric_limits<double>::infinity()
                             : (mesh.position(a) - mesh.position(b)).norm() * (1.0 + scale * bent));
    }
    return costs;
}

double cost_of(const LoopSearch& ring, std::span<const Index> loop, std::span<const double> costs) {
    double sum = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        sum += costs[at(ring.edge_between(loop[k], loop[(k + 1) % loop.size()]))];
    }
    return sum;
}

// The boundary of the rest that the loop has become.
Path hole_in(const MeshPart& rest, std::span<const Index> loop) {
    const auto place = std::find(rest.vertex_map.begin(), rest.vertex_map.end(), loop.front());
    const Index vertex = index_of(place - rest.vertex_map.begin());
    for (const std::vector<Index>& boundary : rest.mesh.topology().boundary_loops()) {
        if (std::find(boundary.begin(), boundary.end(), vertex) != boundary.end()) {
            return {rest.mesh.shared_topology(), boundary, true};
        }
    }
    throw Error(ErrorCode::internal, "the hole of an erased region has no boundary");
}

MeshPart without_faces(const Mesh& mesh, std::span<const Index> faces, const Context& context) {
    const FaceSet gone(mesh.topology(), faces);
    std::vector<Index> kept;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!gone.contains(f)) kept.push_back(f);
    }
    return extract_faces(mesh, kept, context);
}

void add_face_dihedrals(const Mesh& mesh, Index f, GreatestAngle& angle) {
    const std::span<const Index> face = mesh.topology().face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
        add_edge_dihedral(mesh, face[k], face[(k + 1) % face.size()], angle);
    }
}

double max_turn(const Mesh& mesh, Index first_face) {
    GreatestAngle angle;
    for (Index f = first_face; f < mesh.face_count(); ++f) add_face_dihedrals(mesh, f, angle);
    return angle.value();
}

// Whether the known curvature around a hole is worth continuing.
bool has_even_rim(const Mesh& rest, const Path& hole) {
    const Region rim(rest.shared_topology(), hole.vertices());
    std::vector<double> values;
    double sum = 0.0, squares = 0.0;
    for (const Index v : rim.grown(kRimRings).minus(rim).vertices()) {
        if (rest.topology().is_boundary(v)) continue;
        values.push_back(curvature_at(rest, v));
        sum += values.back();
    }
    if (values.empty()) return false;
    const double mean = sum / static_cast<double>(values.size());
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size())) <= kEvenCurvature * mean;
}

// The hole closed one way, and how much the patch turns.
struct Closed {
    Mesh mesh;
    FillReport patch;
    FairContinuity continuity;
    double density, turn;
};

Closed closed_by(const Mesh& rest, const Path& hole, const FillOptions& how,
                 const Context& context) {
    Closed closed{rest, {}, how.continuity, how.density, 0.0};
    closed.patch = fill(closed.mesh, hole, how, context);
    closed.turn = max_turn(closed.mesh, closed.patch.first_face);
    return closed;
}

Closed closed_by_dome(const Mesh& rest, const Path& hole, FillOptions how, const Context& context) {
    how.fair = false;
    Closed closed{rest, {}, FairContinuity::tangents, how.density, 0.0};
    closed.patch = fill(closed.mesh, hole, how, context);
    dome(closed.mesh, closed.patch, hole);
    closed.turn = max_turn(closed.mesh, closed.patch.first_face);
    return closed;
}

// Tangents are continued first, which never does harm: by a patch as dense as the surface around
// it, or by denser ones and caps if that bends too little from a steep rim.
Closed closed_bending(const Mesh& rest, const Path& hole, FillOptions how, double allowed,
                      const Context& context) {
    Closed best = closed_by(rest, hole, how, context);
    const auto consider = [&](Closed other) {
        if (other.turn < best.turn) best = std::move(other);
    };
    for (const double density : kDensities) {
        if (best.turn <= allowed) break;
        how.density = density;
        consider(closed_by(rest, hole, how, context));
        consider(closed_by_dome(rest, hole, how, context));
    }
    return best;
}

double turn_around(const Mesh& rest, const Path& hole) {
    const Region rim(rest.shared_topology(), hole.vertices());
    GreatestAngle angle;
    for (const Index f : rim.grown(kRimRings).faces()) add_face_dihedrals(rest, f, angle);
    return angle.value();
}

void judge(EraseReport& report, double allowed) {
    const auto degrees = [](double angle) {
        return std::to_string(static_cast<int>(std::lround(angle / kDegree))) + " degrees";
    };
    const std::string turns = degrees(report.max_dihedral);
    report.ok = report.max_dihedral <= allowed;
    report.verdict =
        report.ok
            ? "good: the patch turns by at most " + turns + " from face to face"
            : "not good: the patch turns by " + turns +
                  " from face to face, and the surface around it by " + degrees(report.max_around) +
                  " at most; mark a region whose rim is less steep, or subdivide the mesh";
}

Mesh closed_rest(const MeshPart& rest, const Path& hole, const EraseOptions& options,
                 EraseReport& report, const Context& context) {
    FillOptions how;
    how.maximum_vertices = options.maximum_vertices;
    report.max_around = turn_around(rest.mesh, hole);
    const double allowed = std::max(kSteepPatch, report.max_around);
    Closed best = closed_bending(rest.mesh, hole, how, allowed, context);
    if (options.continuity == FairContinuity::curvature && has_even_rim(rest.mesh, hole)) {
        how.continuity = FairContinuity::curvature;
        Closed round = closed_by(rest.mesh, hole, how, context);
        if (round.turn <= std::max(kEvenTurn, best.turn)) best = std::move(round);
    }
    report.patch = best.patch;
    report.continuity = best.continuity;
    report.density = best.density;
    report.max_dihedral = best.turn;
    judge(report, allowed);
    return std::move(best.mesh);
}

MeshMap with_patch(const MeshPart& rest, const Topology& old, const Mesh& filled) {
    MeshMap map = part_map(rest, old);
    while (map.vertices.size() < filled.vertex_count()) map.vertices.add_new();
    while (map.faces.size() < filled.face_count()) map.faces.add_new();
    while (map.corners.size() < filled.topology().corner_count()) map.corners.add_new();
    return map;
}

// Cut faces, and the loop along which they are cut.
struct Excision {
    std::vector<Index> faces, loop;
    double cost = 0.0, width = 0.0;
};

[[noreturn]] void refuse_open_boundary() {
    throw Error(ErrorCode::boundary_conflict,
                "no loop around the region stays off the open boundaries of the mesh; mark a "
                "smaller region, or fill the boundary first");
}

// The faces to be cut that lie beyond the reach of the erasure.
Elements taken_beyond(const Mesh& mesh, const ErasureReach& reach, std::span<const Index> faces) {
    Elements elements{ElementKind::face, 0, {}};
    for (const Index f : faces) {
        if (!reach.holds_all(mesh.topology().face(f))) elements.add(f);
    }
    return elements;
}

Excision cut_in_ring(const Mesh& mesh, const Surrounded& around, const ErasureReach& reach,
                     double scale, const Context& context) {
    const LoopSearch ring(mesh, around.regions, context);
    const std::vector<double> costs = cut_costs(mesh, ring, reach, scale);
    Excision cut;
    cut.loop = ring.cheapest(costs, context);
    if (cut.loop.empty()) refuse_open_boundary();
    cut.cost = cost_of(ring, cut.loop, costs);
    cut.width = around.width;
    const PastePart gone = part_inside(mesh, around.regions, cut.loop, context);
    for (Index f = 0; f < gone.mesh.face_count(); ++f) {
        cut.faces.push_back(gone.map.faces.main_source(f));
    }
    return cut;
}

[[noreturn]] void refuse_to_run_around(const Elements& beyond) {
    throw Error(ErrorCode::not_a_disk,
                "the region runs around " + describe(beyond) +
                    ", which it does not hold; mark these as well, or a part that does not run "
                    "around them",
                beyond);
}

// The largest part of the surface beside a region is the rest; other parts go with the region, so
// that they must lie within its reach, or be pinholes of single vertices.
void require_no_islands(const Mesh& mesh, const Region& region, ErasureReach& reach) {
    const std::vector<char> marked = region.mask();
    const auto is_beside = [&](Index v) {
        const auto around = mesh.topology().neighbors(v);
        return marked[at(v)] ||
               std::any_of(around.begin(), around.end(), [&](Index n) { return marked[at(n)]; });
    };
    const FaceSet faces(mesh.topology(), region.faces());
    std::vector<std::vector<Index>> outside = faces.outside_parts(nullptr);
    std::erase_if(outside, [&](const std::vector<Index>& part) {
        return std::none_of(part.begin(), part.end(), [&](Index f) {
            const std::span<const Index> face = mesh.topology().face(f);
            return std::any_of(face.begin(), face.end(), [&](Index v) { return marked[at(v)]; });
        });
    });
    for (std::size_t k = 1; k < outside.size(); ++k) {
        reach.take_island(outside[k]);
        std::vector<Index> inner = outside[k];
        std::erase_if(inner, [&](Index f) {
            const std::span<const Index> face = mesh.topology().face(f);
            return std::all_of(face.begin(), face.end(), is_beside);
        });
        const Elements beyond = taken_beyond(mesh, reach, inner);
        if (beyond.count > 0) refuse_to_run_around(beyond);
    }
}

// A ring that closes around an unmarked part is made narrower.
Excision cut_around(const Mesh& mesh, const Region& region, const EraseOptions& options,
                    const Context& context) {
    const double radius = outline_radius(mesh, region), width = options.ring * radius;
    ErasureReach reach(mesh, region, width, context);
    require_no_islands(mesh, region, reach);
    for (int step = 0;; ++step) {
        const Surrounded around = surrounded(mesh, region, reach, width, step, context);
        Excision cut = cut_in_ring(mesh, around, reach, options.bend * radius, context);
        // Faces that join the parts of the region, at bow-ties too, have to go with it.
        const FaceSet feature(mesh.topology(), around.regions.feature);
        std::vector<Index> others = cut.faces;
        std::erase_if(others, [&](Index f) { return feature.contains(f); });
        const Elements beyond = taken_beyond(mesh, reach, others);
        if (beyond.count == 0) return cut;
        if (step > kNarrowings) refuse_to_run_around(beyond);
    }
}

Excision cut_along_outline(const Mesh& mesh, const Region& region, const Context& context) {
    ErasureReach reach(mesh, region, 0.0, context);
    require_no_islands(mesh, region, reach);
    Excision cut;
    cut.faces = outlined_faces(mesh, region, context);
    require_one_outline(mesh, cut.faces);
    cut.loop = FaceSet(mesh.topology(), cut.faces).loops().front();
    cut.cost = outline_length(mesh, cut.loop);
    const bool open = std::any_of(cut.loop.begin(), cut.loop.end(),
                                  [&](Index v) { return mesh.topology().is_boundary(v); });
    if (open) refuse_open_boundary();
    return cut;
}

}  // namespace

ErasedFeature erase_feature(const Mesh& mesh, const Region& region, const EraseOptions& options,
                            const Context& context) {
    check_options(options);
    require_same_topology(mesh, region.topology(), "the region");
    Progress progress(context, "erase");
    progress.step(0.6);
    EraseReport report;
    const Excision cut = options.ring > 0.0 ? cut_around(mesh, region, options, context)
                                            : cut_along_outline(mesh, region, context);
    MeshPart rest = without_faces(mesh, cut.faces, context);
    report.loop_size = count_of(cut.loop);
    report.loop_cost = cut.cost;
    report.ring = cut.width;
    report.removed_faces = count_of(cut.faces);
    report.removed_vertices = mesh.vertex_count() - rest.mesh.vertex_count();
    progress.step(0.4);
    Mesh filled = closed_rest(rest, hole_in(rest, cut.loop), options, report, context);
    continue_values(filled, report.patch.first_vertex, report.patch.first_face, context);
    MeshMap map = with_patch(rest, mesh.topology(), filled);
    return {std::move(filled), std::move(map), Path(mesh.shared_topology(), cut.loop, true),
            report};
}

}  // namespace lissom
