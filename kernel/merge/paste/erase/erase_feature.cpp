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
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/loop_search.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/extract.h"
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
// Curvature is continued where it varies, around the cut, by less than this part of its mean.
constexpr double kEvenCurvature = 0.05;
constexpr Index kRimRings = 3;
// Times that curvatures are averaged with those around.
constexpr int kCurvatureAverages = 2;

void check_options(const EraseOptions& options) {
    require(options.ring > 0.0 && std::isfinite(options.ring),
            "the width of the ring around a region must be above 0");
    require(options.bend >= 0.0 && std::isfinite(options.bend),
            "the weight of curvature must be 0 or more");
    require(options.maximum_vertices >= 0, "maximum_vertices must be 0 or more");
}

double length_of(const Mesh& mesh, std::span<const Index> loop) {
    double length = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        length += (mesh.position(loop[(k + 1) % loop.size()]) - mesh.position(loop[k])).norm();
    }
    return length;
}

double outline_radius(const Mesh& mesh, const Region& region) {
    double longest = 0.0;
    for (const std::vector<Index>& loop : region.boundaries()) {
        longest = std::max(longest, length_of(mesh, loop));
    }
    return longest / (2.0 * kPi);
}

// A band around the surface has two outlines, of which a cut can follow one only.
void require_one_outline(const Mesh& mesh, const PasteRegions& regions) {
    std::vector<std::vector<Index>> loops = FaceSet(mesh.topology(), regions.region).loops();
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

// The region with a ring around it: as wide as was asked for, or as there is.
Surrounded surrounded(const Mesh& mesh, const Region& region, double width,
                      const Context& context) {
    const std::vector<double> distance =
        edge_distances(mesh, region.vertices(), std::max(width, 0.0), context);
    for (int step = 0;; ++step, width *= kNarrower) {
        std::vector<Index> near;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (distance[at(v)] <= width) near.push_back(v);
        }
        const Region fewest = region.grown(kFewestRings);
        const Region around = step > kNarrowings
                                  ? fewest
                                  : Region(mesh.shared_topology(), std::move(near)).united(fewest);
        try {
            Surrounded found{paste_regions(mesh, around, region, 0.5, context), width};
            require_one_outline(mesh, found.regions);
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

// Of the ring's edges; infinite at open boundaries, which a patch cannot take the place of.
std::vector<double> cut_costs(const Mesh& mesh, const LoopSearch& ring, double scale) {
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
        const bool open = mesh.topology().is_boundary(a) || mesh.topology().is_boundary(b);
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

double greatest_turn(const Mesh& mesh, Index first_face) {
    GreatestAngle angle;
    for (Index f = first_face; f < mesh.face_count(); ++f) {
        const std::span<const Index> face = mesh.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            add_edge_dihedral(mesh, face[k], face[(k + 1) % face.size()], angle);
        }
    }
    return angle.value();
}

// Whether what is known of the curvature around a hole is worth continuing.
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
    closed.turn = greatest_turn(closed.mesh, closed.patch.first_face);
    return closed;
}

Closed closed_by_dome(const Mesh& rest, const Path& hole, FillOptions how, const Context& context) {
    how.fair = false;
    Closed closed{rest, {}, FairContinuity::tangents, how.density, 0.0};
    closed.patch = fill(closed.mesh, hole, how, context);
    dome(closed.mesh, closed.patch, hole);
    closed.turn = greatest_turn(closed.mesh, closed.patch.first_face);
    return closed;
}

// Tangents are continued first, which never does harm: by a patch as dense as the surface around
// it, or by denser ones and caps where that bends too little from a steep rim.
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
    for (const Index f : rim.grown(kRimRings).faces()) {
        const std::span<const Index> face = rest.topology().face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            add_edge_dihedral(rest, face[k], face[(k + 1) % face.size()], angle);
        }
    }
    return angle.value();
}

void judge(EraseReport& report, double allowed) {
    const auto degrees = [](double angle) {
        return std::to_string(static_cast<int>(std::lround(angle / kDegree))) + " degrees";
    };
    const std::string turns = degrees(report.greatest_dihedral);
    report.ok = report.greatest_dihedral <= allowed;
    report.verdict =
        report.ok ? "good: the patch turns by at most " + turns + " from face to face"
                  : "not good: the patch turns by " + turns +
                        " from face to face, and the surface around it by " +
                        degrees(report.greatest_around) +
                        " at most; mark a region whose rim is less steep, or subdivide the mesh";
}

Mesh closed_rest(const MeshPart& rest, const Path& hole, const EraseOptions& options,
                 EraseReport& report, const Context& context) {
    FillOptions how;
    how.maximum_vertices = options.maximum_vertices;
    report.greatest_around = turn_around(rest.mesh, hole);
    const double allowed = std::max(kSteepPatch, report.greatest_around);
    Closed best = closed_bending(rest.mesh, hole, how, allowed, context);
    if (options.continuity == FairContinuity::curvature && has_even_rim(rest.mesh, hole)) {
        how.continuity = FairContinuity::curvature;
        Closed round = closed_by(rest.mesh, hole, how, context);
        if (round.turn <= std::max(kEvenTurn, best.turn)) best = std::move(round);
    }
    report.patch = best.patch;
    report.continuity = best.continuity;
    report.density = best.density;
    report.greatest_dihedral = best.turn;
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

}  // namespace

ErasedFeature erase_feature(const Mesh& mesh, const Region& region, const EraseOptions& options,
                            const Context& context) {
    check_options(options);
    require_same_topology(mesh, region.topology(), "the region");
    Progress progress(context, "erase");
    progress.step(0.4);
    const double radius = outline_radius(mesh, region);
    const Surrounded around = surrounded(mesh, region, options.ring * radius, context);
    const LoopSearch ring(mesh, around.regions, context);
    const std::vector<double> costs = cut_costs(mesh, ring, options.bend * radius);
    const std::vector<Index> loop = ring.cheapest(costs, context);
    if (loop.empty()) {
        throw Error(ErrorCode::boundary_conflict,
                    "no loop around the region stays off the open boundaries of the mesh; mark a "
                    "smaller region, or fill the boundary first");
    }
    progress.step(0.2);
    const PastePart gone = part_inside(mesh, around.regions, loop, context);
    std::vector<Index> faces;
    for (Index f = 0; f < gone.mesh.face_count(); ++f) {
        faces.push_back(gone.map.faces.main_source(f));
    }
    MeshPart rest = without_faces(mesh, faces, context);
    EraseReport report;
    report.loop_size = count_of(loop);
    report.loop_cost = cost_of(ring, loop, costs);
    report.ring = around.width;
    report.removed_faces = count_of(faces);
    report.removed_vertices = gone.mesh.vertex_count() - report.loop_size;
    progress.step(0.4);
    Mesh filled = closed_rest(rest, hole_in(rest, loop), options, report, context);
    continue_values(filled, report.patch.first_vertex, report.patch.first_face, context);
    MeshMap map = with_patch(rest, mesh.topology(), filled);
    return {std::move(filled), std::move(map), Path(mesh.shared_topology(), loop, true), report};
}

}  // namespace lissom
