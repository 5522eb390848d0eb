#include "kernel/merge/blend/fair_spots.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/merge/blend/seam_core.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/crumpled_edges.h"
#include "kernel/merge/sew/seam_collar.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/region.h"

namespace lissom {
namespace {

// Umbrella steps within the tangent planes, and times that the surface is bent.
constexpr Index kSpotUmbrella = 2, kSpotPasses = 2;
// Triangles that became thinner than this are flipped away.
constexpr double kSpotThin = 2.0 * kDegree;

// A seam with its radius and the distances from it along edges.
struct SpotSeam {
    std::span<const Index> loop;
    double radius;
    std::vector<double> distance;
};

std::vector<SpotSeam> open_seams(const Sewn& sewn, double reach, const Context& context) {
    const double radii = std::isfinite(reach) ? std::max(reach, kCrumpledReach) : kCrumpledReach;
    std::vector<SpotSeam> seams;
    for (std::size_t j = 0; j < sewn.seams.size(); ++j) {
        if (!sewn.kept.empty() && sewn.kept[j]) continue;
        const double radius = loop_radius(sewn.mesh, sewn.seams[j]);
        seams.push_back({sewn.seams[j], radius,
                         edge_distances(sewn.mesh, sewn.seams[j], radii * radius, context)});
    }
    return seams;
}

// The vertices of crumpled edges of both sides, ascending.
std::vector<Index> crumpled_vertices(const Sewn& sewn, std::span<const SpotSeam> seams,
                                     const SpotFairing& how) {
    const std::pair<SeamSide, std::span<const Vec3>> sides[] = {
        {SeamSide::source, how.source_rest}, {SeamSide::target, how.target_rest}};
    std::vector<Index> vertices;
    for (const SpotSeam& seam : seams) {
        for (const auto& [side, rest] : sides) {
            const std::vector<Index> faces = faces_on(sewn.side_of_face, side);
            const MadeRim rim{sewn.mesh, faces, seam.loop, seam.distance, seam.radius};
            for (const CrumpledEdge& edge : crumpled_edges(rim, rest)) {
                vertices.insert(vertices.end(), {edge.a, edge.b});
            }
        }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

// The vertices of a region that are within reach of a seam and not firm.
Region moving_spots(const Region& region, std::span<const SpotSeam> seams, const SpotFairing& how) {
    const auto is_near = [&](Index v) {
        return std::any_of(seams.begin(), seams.end(), [&](const SpotSeam& seam) {
            return seam.distance[at(v)] <= how.reach * seam.radius;
        });
    };
    std::vector<Index> moving;
    for (const Index v : region.vertices()) {
        const bool near = !std::isfinite(how.reach) || is_near(v);
        if (near && !std::binary_search(how.firm.begin(), how.firm.end(), v)) moving.push_back(v);
    }
    return {region.topology(), std::move(moving)};
}

void bend_spots(BandSystem& band, const SeamCore& core, const Context& context) {
    for (Index i = 0; i < kSpotUmbrella; ++i) core.umbrella(band);
    for (Index pass = 0; pass < kSpotPasses; ++pass) {
        band.bend(core.relaxed(band, band.curvatures(), context), context);
    }
}

}  // namespace

bool fair_spots(Sewn& sewn, const SpotFairing& options, const Context& context) {
    const std::vector<SpotSeam> seams = open_seams(sewn, options.reach, context);
    const std::vector<Index> spots[] = {crumpled_vertices(sewn, seams, options)};
    if (spots[0].empty()) return false;
    Mesh& mesh = sewn.mesh;
    const std::vector<Index> rings = seam_rings(mesh.topology(), spots, 2 * options.rings);
    const Region region = seam_band(mesh.shared_topology(), rings);
    const Region moving = moving_spots(region, seams, options);
    if (moving.empty()) return false;
    BandSystem band(region, moving, mesh.positions());
    band.take_morphs(mesh);
    try {
        bend_spots(band, SeamCore(band, rings, options.rings), context);
    } catch (const Error& error) {
        // A few faces, folded flat, say nothing about how the surface bends.
        if (error.code() != ErrorCode::not_positive_definite) throw;
        return false;
    }
    band.write(mesh);
    sewn.report.after = seam_quality(mesh, sewn.seams);
    if (sewn.report.after.smallest_angle < kSpotThin) {
        flip_near_seams(sewn, context);
        sewn.report.after = seam_quality(sewn.mesh, sewn.seams);
    }
    return true;
}

}  // namespace lissom
