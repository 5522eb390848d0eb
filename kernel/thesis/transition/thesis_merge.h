/// Merging with the transition regions of the thesis, to the letter (section 3.3.3); private to
/// kernel/thesis. A region of the source comes to lie on one of the target: its boundary on the far
/// end of the target's region, its far end on the target's boundary. Both deform at once, so that
/// the Laplacian coordinates of one region draw near those of the other (E_T). The solution does
/// not bring them together exactly, so one is kept: that of the source, sewn to the rest of the
/// target and reconstructed from linearly interpolated coordinates.
///
///     const OpenedForOverlap opened = open_for_overlap(target, loops, width, context);
///     ThesisMerge thesis(opened.whole, opened.mesh, source, joins, 0.1, context);
///     const BoundaryDeformation deformed = thesis.deform(region, held, ordinary, context);
///     Sewn sewn = sew(opened.mesh, moved_by(deformed), pairs);
///     const TransitionReport report = thesis.reconstruct(sewn, context);
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/merge/blend/band_place.h"
#include "kernel/merge/blend/band_system.h"
#include "kernel/merge/blend/overlap_transition.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/thesis/transition/thesis_band.h"
#include "kernel/thesis/transition/thesis_transition.h"

namespace lissom {

/// The thesis leaves some choices open, made here as follows. The target stays outside its regions,
/// and its boundaries are as free as they. Both meshes are brought to one scale, by the mean of the
/// joins' (geometric), and to unit size. Laplacian coordinates at open boundaries are not
/// curvatures and take no part in E_T. Interpolation is linear in the height of the unit square:
/// all of the target's at the source's boundary, all of the source's at its region's far end.
/// Coordinates are those by area, as loops of unlike density have others without.
class ThesisMerge final : public OverlapMerge {
  public:
    /// Parameterises the regions. The meshes must stay as they are meanwhile.
    /// Errors: invalid_argument if a region is no band (see make_thesis_band), or if regions of two
    /// joins meet; memory_limit; cancelled.
    ThesisMerge(const OverlapTarget& whole, const Mesh& opened, const Mesh& source,
                std::vector<OverlapJoin> joins, double weight, const Context& context);

    /// Eq 2.8 with w_T E_T for both meshes, and the removal of shear (Eq 2.11). `region` of the
    /// source deforms; its part `held` keeps the values of `ordinary`, without transition.
    /// Errors: as thesis_transition.
    BoundaryDeformation deform(const Region& region, const Region& held,
                               const BoundaryDeformation& ordinary,
                               const Context& context) override;

    /// After `deform` and sewing: the vertices of the source's regions, without its boundaries,
    /// take those positions whose Laplacian coordinates are nearest to the interpolated ones, in
    /// the least squares weighted by area; at the seam these are the target's. Everything else
    /// stays to the bit. "normal" attributes turn with the surface, and offsets of morph targets go
    /// through the same steps.
    /// Errors: not_positive_definite; memory_limit; cancelled. The mesh is then unchanged.
    TransitionReport reconstruct(Sewn& sewn, const Context& context) const override;

    const std::vector<ThesisBand>& target_bands() const { return target_bands_; }
    const std::vector<ThesisBand>& source_bands() const { return source_bands_; }

  private:
    /// A vertex of a region and its place in the other mesh.
    struct Match {
        Index vertex = kNoIndex;
        BandPlace place;
        /// Fraction of its own coordinates, 0 to 1.
        double fraction = 0.5;
    };
    /// The vertices of a region without its boundary's, and those of them with a place.
    struct Matches {
        std::vector<Index> members;
        std::vector<Match> matches;
        TransitionBand report;
    };
    struct Frames;

    static Matches match(const ThesisBand& own, const ThesisBand& other, const Mesh& mesh,
                         const Mesh& across);
    void turn_to_end(std::size_t join);
    std::vector<Index> moving_of_target() const;
    Frames frames(const Region& region, const Region& held,
                  const BoundaryDeformation& ordinary) const;
    void hold_source(const Region& region, const BoundaryDeformation& ordinary, const Frames& frame,
                     TransitionMesh& source) const;
    void add_counterparts(std::span<const Index> target_local, TransitionMesh& target,
                          TransitionMesh& source) const;
    void keep_coordinates(const Mesh& part, std::span<const Index> vertices,
                          const TransitionShape& solved, const Region& moving);
    Vec3 seen_in_target(const BandPlace& place, const std::vector<Vec3>& coordinates,
                        const Vec3& otherwise) const;
    void want_at_seams(const BandSystem& band, std::span<const Index> local,
                       const std::vector<Vec3>& coordinates, std::vector<Vec3>& wanted) const;
    void want_in_regions(std::span<const Index> local, const std::vector<Vec3>& coordinates,
                         std::vector<Vec3>& wanted) const;
    Region moving_in(const Sewn& sewn, std::span<const Index> source_at) const;

    const OverlapTarget& whole_;
    const Mesh& target_;
    const Mesh& opened_;
    const Mesh& source_;
    std::vector<OverlapJoin> joins_;
    double weight_;
    std::vector<ThesisBand> target_bands_, source_bands_;
    std::vector<Matches> of_target_, of_source_;
    /// Results of the last `deform`: the coordinates of the target's vertices with a known value,
    /// those of its morph targets by attribute, and the vertices of the source that stay.
    std::vector<Vec3> coordinates_;
    std::map<std::string, std::vector<Vec3>> morph_coordinates_;
    std::vector<char> has_coordinates_, source_held_;
};

}  // namespace lissom
