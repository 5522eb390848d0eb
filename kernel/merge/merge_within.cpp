#include "kernel/merge/merge_within.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kernel/core/clock.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/merge/loop/face_angles.h"
#include "kernel/merge/verdict.h"
#include "kernel/mesh/fill/bridge.h"

namespace lissom {
namespace {

void require_plain(std::span<const Join> joins) {
    if (joins.empty()) throw Error(ErrorCode::invalid_argument, "give at least one join");
    for (const Join& join : joins) {
        if (join.keys.empty() && join.target_mesh == 0) continue;
        throw Error(ErrorCode::invalid_argument,
                    "boundaries of one mesh are joined as they lie, without keys; leave them out, "
                    "or merge a copy of the mesh");
    }
}

// A path of the mesh before it was bridged, whose vertices are the same.
Path on(const Mesh& mesh, const Path& path) {
    return Path(mesh.shared_topology(), path.vertices(), path.closed());
}

void require_boundaries(const Mesh& mesh, std::span<const Join> joins) {
    std::set<Index> used;
    for (const Join& join : joins) {
        for (const Path* path : {&join.source, &join.target}) {
            if (path->on_mesh()) require_same_topology(mesh, path->topology(), "the boundary");
            if (!path->is_boundary()) {
                throw Error(ErrorCode::not_a_boundary,
                            "only open boundaries can be joined; take boundaries of the mesh");
            }
            const std::vector<Index>& loop = path->vertices();
            const Index first = *std::min_element(loop.begin(), loop.end());
            if (used.insert(first).second) continue;
            throw Error(ErrorCode::boundary_conflict,
                        "a boundary is joined twice; each can be in one join",
                        {ElementKind::vertex, 1, {first}});
        }
    }
}

void add_bridge(const Join& join, MergeResult& result, const Context& context) {
    const BridgeReport added =
        bridge(result.mesh, on(result.mesh, join.target), on(result.mesh, join.source), context);
    for (const Index face : added.beside) {
        result.provenance.faces.add_copy(face);
        for (int k = 0; k < 3; ++k) result.provenance.corners.add_new();
    }
    result.side_of_face.resize(at(result.mesh.face_count()), SeamSide::source);
    result.seams.push_back(join.target.vertices());
    result.seams.push_back(join.source.vertices());
    JoinReport& report = result.report.joins.emplace_back();
    report.source_size = join.source.size();
    report.target_size = join.target.size();
    report.placed = Placing::as_placed;
}

// A triangle of a bridge is a needle if the angles at its boundary edge are at least this.
constexpr double kNeedleFoot = 30.0 * kDegree;

// The smallest tip of the needles that stand on short edges of a boundary: as nothing moves, a
// strip between unlike boundaries has them. 0 without any.
double thinnest_needle(const Mesh& bridged, Index first_face) {
    double thinnest = 0.0;
    for (Index f = first_face; f < bridged.face_count(); ++f) {
        const std::span<const Index> face = bridged.topology().face(f);
        const Vec3 along = bridged.position(face[1]) - bridged.position(face[0]);
        const Vec3 first = bridged.position(face[2]) - bridged.position(face[0]);
        const Vec3 second = bridged.position(face[2]) - bridged.position(face[1]);
        const bool upright = angle_between(along, first) >= kNeedleFoot &&
                             angle_between(-along, second) >= kNeedleFoot;
        const double tip = angle_between(first, second);
        if (upright && (thinnest == 0.0 || tip < thinnest)) thinnest = tip;
    }
    return thinnest;
}

void measure(const Mesh& before, std::span<const Join> joins, bool sought, MergeResult& result,
             const Context& context) {
    MergeReport& report = result.report;
    std::vector<std::vector<Index>> sources, targets;
    for (const Join& join : joins) {
        sources.push_back(join.source.vertices());
        targets.push_back(join.target.vertices());
    }
    report.source_rim = seam_quality(before, sources);
    report.target_rim = seam_quality(before, targets);
    // Judged as the polygons that a seam divides.
    report.source_rim.polygon_angle = thinnest_needle(result.mesh, before.face_count());
    report.seam.before = report.seam.after = seam_quality(result.mesh, result.seams);
    if (sought) {
        std::vector<Index> added(at(result.mesh.face_count() - before.face_count()));
        std::iota(added.begin(), added.end(), before.face_count());
        report.intersections = self_intersections(result.mesh, {added, std::nullopt}, context);
    }
    if (!report.intersections.empty()) {
        report.warnings.push_back(std::to_string(report.intersections.size()) +
                                  " pairs of faces run through one another that did not "
                                  "before; see the report's intersections");
    }
    judge(report, {.sought = sought});
}

}  // namespace

MergeResult merge_within(const Mesh& mesh, std::span<const Join> joins, bool find_intersections,
                         const Context& context) {
    require_plain(joins);
    require_boundaries(mesh, joins);
    const auto start = Clock::now();
    MergeResult result;
    result.mesh = mesh;
    result.provenance = {ElementMap::identity(mesh.vertex_count()),
                         ElementMap::identity(mesh.topology().corner_count()),
                         ElementMap::identity(mesh.face_count())};
    result.side_of_face.assign(at(mesh.face_count()), SeamSide::target);
    for (const Join& join : joins) add_bridge(join, result, context);
    measure(mesh, joins, find_intersections, result, context);
    result.report.solve_seconds = seconds_since(start);
    return result;
}

}  // namespace lissom
