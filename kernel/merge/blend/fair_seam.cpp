#include "kernel/merge/blend/fair_seam.h"

#include "kernel/core/error.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/merge/blend/seam_core.h"

namespace lissom {
namespace {

void check_fairing(const SeamFairing& options) {
    if (options.rings < 1 || options.core < 1 || options.core > options.rings) {
        throw Error(ErrorCode::invalid_argument,
                    "a seam is faired over 1 ring or more, with a core of 1 ring at least and all "
                    "of them at most");
    }
    if (options.umbrella < 0 || options.passes < 1) {
        throw Error(ErrorCode::invalid_argument,
                    "fairing a seam needs 0 umbrella steps or more and 1 pass or more");
    }
}

// A seam that turns by less does not show among edges that turn as much; fairing may leave up to
// this much, if it removes steeper edges beside the seam.
constexpr double kFaintSeam = 20.0 * kDegree;

SeamQuality faint_seam() {
    SeamQuality quality;
    quality.max_dihedral = kFaintSeam;
    return quality;
}

}  // namespace

std::vector<Index> fair_seam(Mesh& mesh, std::span<const std::vector<Index>> seams,
                             const SeamFairing& options, const Context& context) {
    check_fairing(options);
    for (const std::vector<Index>& seam : seams) require_vertices(mesh.topology(), seam);
    const std::vector<Index> rings = seam_rings(mesh.topology(), seams, options.rings);
    const Region region = seam_band(mesh.shared_topology(), rings);
    const Region moving = region.minus(Region(mesh.shared_topology(), options.firm));
    if (moving.empty()) return {};

    Progress progress(context, "fair the seam");
    BandSystem band(region, moving, mesh.positions());
    band.take_morphs(mesh);
    const SeamCore core(band, rings, options.core);
    for (Index i = 0; i < options.umbrella; ++i) core.umbrella(band);
    try {
        for (Index pass = 0; pass < options.passes; ++pass) {
            progress.update(pass, options.passes);
            band.bend(core.relaxed(band, band.curvatures(), context), context);
        }
    } catch (const Error& error) {
        // A few faces, folded flat, say nothing about how the surface bends.
        if (error.code() != ErrorCode::not_positive_definite) throw;
        return {};
    }
    band.write_guarded(mesh, seams, faint_seam(), context);
    return moving.vertices();
}

}  // namespace lissom
