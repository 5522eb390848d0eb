/// Merging with the transition regions of the thesis, to the letter (section 3.3.3); private to
/// kernel/merge. Both meshes deform at once, so that the Laplacian coordinates of one transition
/// region draw near those of the other (E_T); after sewing both regions are reconstructed from
/// linearly interpolated coordinates.
///
///     ThesisMerge thesis(target, source, joins, 0.1, context);
///     const BoundaryDeformation deformed = thesis.deform(region, held, ordinary, context);
///     Sewn sewn = sew(target, moved_by(deformed), pairs);
///     const TransitionReport report = thesis.reconstruct(sewn, context);
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/merge/blend/band_place.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/merge/thesis/thesis_band.h"
#include "kernel/merge/thesis/thesis_transition.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ThesisJoin {
    LoopPair pair;
    /// Place in `pair.source` of a key, where the cuts begin.
    Index start = 0;
    /// How much the source grows at this join; 1 where it stays as it was put.
    double scale = 1.0;
    /// Of the transition regions: along edges, each in its mesh's own unit.
    double target_width = 0.0, source_width = 0.0;
};

/// What the thesis leaves open is done as follows. The regions lie side by side at the seam, as the
/// meshes do, so that a vertex corresponds to one as far from the seam on its other side. The
/// target stays outside its regions, at its loops and at open boundaries. Both meshes are brought
/// to one scale, by the mean of the joins' (geometric), and to unit size. Laplacian coordinates at
/// open boundaries are not curvatures and take no part in E_T. Interpolation runs from one region's
/// end to the other's over the lengths of paths in widths, with halves of both at the seam.
class ThesisMerge {
  public:
    /// Parameterises the regions. The meshes must stay as they are meanwhile.
    /// Errors: invalid_argument for widths that are not finite and above 0, where a region is no
    /// band (see make_thesis_band), or where regions of two joins meet; memory_limit; cancelled.
    ThesisMerge(const Mesh& target, const Mesh& source, std::vector<ThesisJoin> joins,
                double weight, const Context& context);

    /// Eq 2.8 with w_T E_T for both meshes, and the removal of shear (Eq 2.11). `region` of the
    /// source deforms, `held` of it keeps what `ordinary`, the merge without transition, gave it.
    /// Errors: as thesis_transition.
    BoundaryDeformation deform(const Region& region, const Region& held,
                               const BoundaryDeformation& ordinary, const Context& context);

    /// After `deform` and sewing: the target's regions take their deformed shape, and then the
    /// vertices of all regions and seams those positions whose Laplacian coordinates are nearest
    /// to the interpolated ones, in the least squares weighted by area. Those of the seam and of
    /// two rings beside it, which sewing has changed, are interpolated harmonically from what is
    /// around. Everything else stays to the bit. "normal" attributes turn with the surface.
    /// Errors: not_positive_definite; memory_limit; cancelled. The mesh is then unchanged.
    TransitionReport reconstruct(Sewn& sewn, const Context& context) const;

    const std::vector<ThesisBand>& target_bands() const { return target_bands_; }
    const std::vector<ThesisBand>& source_bands() const { return source_bands_; }

  private:
    /// A vertex of a region and its place in the other mesh.
    struct Match {
        Index vertex = kNoIndex;
        BandPlace place;
        /// Fraction of its own coordinates, one half to 1.
        double fraction = 0.5;
    };
    /// The vertices of a region that are on no open boundary, and those of them with a place.
    struct Matches {
        std::vector<Index> members;
        std::vector<Match> matches;
        TransitionBand report;
    };
    struct Frames;
    struct SewnBands;

    static Matches match(const ThesisBand& own, const ThesisBand& other, const Mesh& mesh,
                         const Mesh& across);
    static void interpolate(std::span<const Match> matches, std::span<const Index> local,
                            std::span<const Index> across, std::span<const Vec3> own,
                            std::vector<Vec3>& wanted);
    std::vector<Index> members_of_target() const;
    Frames frames(const Region& region, const Region& held,
                  const BoundaryDeformation& ordinary) const;
    void hold_source(const Region& region, const BoundaryDeformation& ordinary, const Frames& frame,
                     TransitionMesh& source) const;
    void add_counterparts(std::span<const Index> target_local, TransitionMesh& target,
                          TransitionMesh& source) const;
    SewnBands sewn_bands(const Sewn& sewn) const;

    const Mesh& target_;
    const Mesh& source_;
    std::vector<ThesisJoin> joins_;
    double weight_;
    std::vector<ThesisBand> target_bands_, source_bands_;
    std::vector<Matches> of_target_, of_source_;
    /// Of the last `deform`: how far each vertex of the target moved, and which of the source stay.
    std::vector<Vec3> target_shift_;
    std::vector<char> source_held_;
};

}  // namespace lissom
