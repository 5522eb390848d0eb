#include "kernel/merge/blend/fair_spots.h"

#include <algorithm>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/merge/blend/seam_core.h"
#include "kernel/merge/loop/band_quality.h"
#include "kernel/merge/loop/crumpled_edges.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/mesh/query/distances.h"
#include "kernel/mesh/region.h"

namespace lissom {
namespace {

// Umbrella steps within the tangent planes, and times that the surface is bent.
constexpr Index kSpotUmbrella = 2, kSpotPasses = 2;

// The vertices of crumpled edges of both sides, ascending.
std::vector<Index> crumpled_vertices(const Sewn& sewn, const SpotFairing& how,
                                     const Context& context) {
    const std::pair<SeamSide, std::span<const Vec3>> sides[] = {
        {SeamSide::source, how.source_rest}, {SeamSide::target, how.target_rest}};
    std::vector<Index> vertices;
    for (std::size_t j = 0; j < sewn.seams.size(); ++j) {
        if (!sewn.kept.empty() && sewn.kept[j]) continue;
        const std::vector<Index>& seam = sewn.seams[j];
        const double radius = loop_radius(sewn.mesh, seam);
        const std::vector<double> distance = edge_distances(sewn.mesh, seam, radius, context);
        for (const auto& [side, rest] : sides) {
            const std::vector<Index> faces = faces_on(sewn.side_of_face, side);
            const MadeRim rim{sewn.mesh, faces, seam, distance, radius};
            for (const CrumpledEdge& edge : crumpled_edges(rim, rest)) {
                vertices.insert(vertices.end(), {edge.a, edge.b});
            }
        }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

void bend_spots(BandSystem& band, const SeamCore& core, const Context& context) {
    for (Index i = 0; i < kSpotUmbrella; ++i) core.umbrella(band);
    for (Index pass = 0; pass < kSpotPasses; ++pass) {
        band.bend(core.relaxed(band, band.curvatures(), context), context);
    }
}

}  // namespace

bool fair_spots(Sewn& sewn, const SpotFairing& options, const Context& context) {
    const std::vector<Index> spots[] = {crumpled_vertices(sewn, options, context)};
    if (spots[0].empty()) return false;
    Mesh& mesh = sewn.mesh;
    const std::vector<Index> rings = seam_rings(mesh.topology(), spots, 2 * options.rings);
    const Region region = seam_band(mesh.shared_topology(), rings);
    const Region moving = region.minus(Region(mesh.shared_topology(), options.firm));
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
    return true;
}

}  // namespace lissom
