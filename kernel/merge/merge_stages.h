/// The stages of a merge; private to kernel/merge. Each is a function of the ones before it:
///
///     make_sides -> Sides -> find_boundaries -> Boundaries -> prepare_merge -> MergePreparation,
///     find_places -> FoundPlaces, match_boundaries -> Matching, deform_source -> DeformedSource,
///     sew_sides -> MergedSides, report_of
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/stats.h"
#include "kernel/merge/blend/fair_spots.h"
#include "kernel/merge/blend/overlap_transition.h"
#include "kernel/merge/blend/transition.h"
#include "kernel/merge/loop/automatic_keys.h"
#include "kernel/merge/loop/correspondence.h"
#include "kernel/merge/loop/curve_fit.h"
#include "kernel/merge/loop/keys.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/merge/loop/loop_values.h"
#include "kernel/merge/loop/part_shape.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/merge_side.h"
#include "kernel/merge/sew/seam_quality.h"
#include "kernel/merge/sew/sew.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Variants of the method: the thesis's choices and the default's.
struct MergeMethod {
    BoundaryDeformOptions deform;
    LoopValueOptions values;
    /// Measure of loops; raw ones meet at vertices only if these coincide.
    LoopMeasure loops = LoopMeasure::robust;
    /// Whether steps at the seam are guarded, and edges flipped.
    bool guard = true;
    /// Its own transition, if one is asked for; else null.
    const OverlapTransition* overlap = nullptr;
};
MergeMethod method_of(const MergeOptions& options);

/// The place of a boundary's vertices in the mesh that was given.
struct GivenLoop {
    std::vector<Index> vertices;
    std::vector<Vec3> points;
};

/// Properties kept of the meshes as given, loops by join.
struct GivenMeshes {
    std::vector<GivenLoop> source_loops, target_loops;
    /// Counts of elements of the first target, of the first two as one mesh, and so on.
    std::vector<std::shared_ptr<const Topology>> target_topology;
};

/// Findings about the sides.
struct SidesFound {
    std::vector<JoinReport> joins;
    bool source_flipped = false;
    std::vector<Index> targets_flipped;
    std::vector<std::string> warnings;
};

/// Copies of the meshes that look outward and have smooth boundaries.
struct Sides {
    MergeSide source;
    std::vector<MergeSide> targets;
    /// For every join the place of its boundary among those of its target.
    std::vector<std::size_t> place;
    GivenMeshes given;
    SidesFound found;
};
/// Errors: as Merger.
Sides make_sides(const Mesh& source, std::span<const Mesh* const> targets,
                 std::span<const Join> joins, const MergeOptions& options, const Context& context);

/// Regions that the thesis's transition takes off the targets.
struct Overlap {
    OverlapTarget target;
    /// The targets' boundaries as they were, by join.
    std::vector<Loop> curves;
};

/// The loops to be joined, on the source and on all targets as one mesh.
struct Boundaries {
    MergeSide source;
    /// By join: whether faces of the source, and of the targets, were split for it.
    std::vector<char> refined, target_refined;
    /// With overlapping regions, the target is without them, and its loops are their far ends.
    std::optional<Overlap> overlap;
    Mesh target;
    MeshMap target_map;
    std::vector<std::vector<Index>> target_loops;
    /// By join, the source's run the other way so that both run the same way.
    std::vector<Loop> source_curves, target_curves;
};
Boundaries find_boundaries(Sides sides, std::span<const Join> joins, const MergeOptions& options,
                           const Context& context);

/// The parts behind the first join, found if loops and directions leave a choice.
class PartShapes {
  public:
    struct Pair {
        PartShape source, target;
    };
    /// Found at the first call; after an error at the next one.
    const Pair& of(const Boundaries& boundaries, const Context& context) const;

  private:
    mutable std::once_flag once_;
    mutable Pair parts_;
};

/// Parts of the source without a join, and their vertices.
struct LooseParts {
    Index parts = 0, vertices = 0;
};

/// The factored systems that deform the source by its boundaries.
struct SourceSystem {
    std::vector<Region> features;
    /// The vertices of loops and features that deform.
    std::optional<Region> kept;
    std::unique_ptr<BoundaryDeformer> deformer;
    /// The system with features held as well, if features of a free configuration are fitted.
    std::unique_ptr<BoundaryDeformer> featured;
};

/// The part of a report that does not depend on keys.
struct PreparationReport {
    SidesFound sides;
    LooseParts loose;
    SeamQuality source_rim, target_rim;
    DeformStats stats;
    double seconds = 0.0;
};

/// All that does not depend on keys. Later stages take the members that they need.
struct MergePreparation {
    /// Memory beside the meshes and factors: origins of elements, loops and parts.
    MemoryCharge charge;
    MergeOptions options;
    MergeMethod method;
    GivenMeshes given;
    Boundaries boundaries;
    std::unique_ptr<PartShapes> parts;
    SourceSystem system;
    PreparationReport report;
};
MergePreparation prepare_merge(const Mesh& source, std::span<const Mesh* const> targets,
                               std::span<const Join> joins, const MergeOptions& options,
                               const Context& context);

/// Keys of one join, on its loops. Errors: key_conflict.
std::vector<ParameterPair> parameters_of(const GivenMeshes& given, const Boundaries& boundaries,
                                         const MergeMethod& method, std::size_t join,
                                         std::span<const KeyPair> keys);

/// Places of joins without keys: one key and the certainty of each join.
struct FoundPlaces {
    std::vector<ParameterPair> keys;
    Placing by = Placing::as_placed;
    std::vector<double> certainty;
    bool any_turn = false;
    /// For `as_placed`, the angle (radians) from the turn that the shapes surely suggest; 0 if it
    /// is less than a quarter turn.
    double off_shape = 0.0;
};
FoundPlaces find_places(const Boundaries& boundaries, const PartShapes& parts,
                        const SourceSystem& system, const MergeOptions& options,
                        const Context& context);

/// Correspondence of the boundaries.
struct Matching {
    std::vector<LoopPair> pairs;
    /// By join the vertex of the source's loop at the first key, or the first.
    std::vector<Index> starts;
    /// With overlapping regions, the place of the same key on the target's boundary, or 0.
    std::vector<Index> overlap_starts;
    /// Fit of the parts, by join, if they fit.
    std::vector<std::optional<CurveFit>> fits;
    std::vector<JoinReport> joins;
    std::vector<std::string> warnings;
};
/// `keys` by join, and `joins` with the findings about the sides. `find` is called once, if a join
/// without keys does not fit as it lies.
Matching match_boundaries(const GivenMeshes& given, const Boundaries& boundaries,
                          const MergeOptions& options, std::vector<JoinReport> joins,
                          std::span<const std::vector<KeyPair>> keys,
                          const std::function<FoundPlaces()>& find);

/// The source as the boundaries of `pairs` deform it, or move it if parts fit; `fits` by join, or
/// none. Errors: cancelled.
BoundaryDeformation deformed_by(const Boundaries& boundaries, const SourceSystem& system,
                                const LoopValueOptions& how, std::span<const LoopPair> pairs,
                                std::span<const std::optional<CurveFit>> fits,
                                const Context& context);

/// A turn of a source with one join, and its distortion.
struct JudgedTurn {
    TurnCandidate turn;
    /// RMS distance of the deformed source's vertices from the similarity that fits them best, in
    /// its sizes.
    double bend = 0.0;
    /// Lower is better; and the probability that the right turn is within 30 degrees of this one.
    double score = 0.0, certainty = 0.0;
};
/// Deforms the source by every turn that the shapes of the parts suggest, with the factors kept.
std::vector<JudgedTurn> judged_turns(const Boundaries& boundaries, const PartShapes& parts,
                                     const SourceSystem& system, const MergeOptions& options,
                                     const Context& context);

/// The source brought to the target.
struct DeformedSource {
    Mesh source;
    BoundaryTimes seconds;
    /// The thesis's transition, if it is made; else null.
    std::shared_ptr<OverlapMerge> overlap;
};
/// The boundaries must outlive the result.
DeformedSource deform_source(const Boundaries& boundaries, const SourceSystem& system,
                             const MergeOptions& options, const Matching& matching,
                             const Context& context);

/// The sides sewn together.
struct MergedSides {
    Sewn sewn;
    TransitionReport transition;
    std::vector<std::string> warnings;
    std::vector<FacePair> intersections;
    Index known_intersections = 0;
};
MergedSides sew_sides(const Boundaries& boundaries, const MergeOptions& options,
                      const Matching& matching, const DeformedSource& moved,
                      const Context& context);

/// Smooths the places beside the seams at which the surface folds or crosses itself or has new
/// thorns and pits (relax_faults), with `rings` around them. Returns false, and changes nothing, if
/// there are none.
bool relax_sides(const Boundaries& boundaries, const MergeOptions& options,
                 const MergeReport& report, Index rings, MergedSides& merged,
                 const Context& context);

/// A way to fair places: how many rings of vertices around one are bent anew, and whether creases
/// of the source stay.
struct SpotWay {
    Index rings = kMinSpotRings;
    bool creases = true;
};

/// Fairs the places beside the seams at which a side crumpled (fair_spots). Creases and flat faces
/// of the targets stay. Returns false, and changes nothing, if there are no such places.
bool fair_sides(const Boundaries& boundaries, const MergeOptions& options, const SpotWay& way,
                MergedSides& merged, const Context& context);

MergeReport report_of(const PreparationReport& prepared, const Boundaries& boundaries,
                      const MergeOptions& options, const Matching& matching,
                      const DeformedSource& moved, const MergedSides& merged,
                      const Context& context);

/// Sewn sides and their report.
struct JudgedSides {
    MergedSides merged;
    MergeReport report;
};
/// Sews and judges, and mends if the options allow it.
JudgedSides judged_sides(const PreparationReport& prepared, const Boundaries& boundaries,
                         const MergeOptions& options, const Matching& matching,
                         const DeformedSource& moved, const Context& context);

}  // namespace lissom
