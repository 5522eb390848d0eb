/// The state behind a Merge; private to kernel/merge.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/merge/loop/automatic_keys.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/merge_side.h"
#include "kernel/merge/thesis/thesis_merge.h"

namespace lissom {

/// The place of a boundary's vertices in the mesh that was given.
struct GivenLoop {
    std::vector<Index> vertices;
    std::vector<Vec3> points;
};

/// The boundaries of the targets: those of each target, and for every join its place among them.
struct TargetPaths {
    std::vector<std::vector<Path>> paths;
    std::vector<std::size_t> place;
};

using MergeClock = std::chrono::steady_clock;

inline double seconds_since(MergeClock::time_point start) {
    return std::chrono::duration<double>(MergeClock::now() - start).count();
}

struct Merge::State {
    State(const Mesh& given_source, std::span<const Mesh* const> given_targets,
          std::vector<Join> asked, const MergeOptions& chosen, const Context& context);

    // Preparation.
    void make_sides(const Mesh& given_source, std::span<const Mesh* const> given_targets,
                    const Context& context);
    TargetPaths target_paths(std::size_t targets) const;
    void make_source(const Mesh& given, const Context& context);
    std::vector<MergeSide> make_targets(std::span<const Mesh* const> given,
                                        const TargetPaths& paths, const Context& context);
    void trim_sides(std::vector<MergeSide>& sides, const TargetPaths& paths,
                    const Context& context);
    void take_target_loops(const std::vector<MergeSide>& sides, const TargetPaths& paths);
    void note_flips();
    void note_loose_parts();
    void note_trims(const MergeSide& side, const char* name);
    void combine(std::span<const Mesh* const> given_targets, std::vector<MergeSide>& sides,
                 const Context& context);
    void make_loops();
    void refine_coarse(const Context& context);
    void carry_features();
    Region deforming() const;
    void prepare(const Context& context);

    // Solution.
    std::vector<ParameterPair> keys_of(std::size_t join, std::span<const KeyPair> keys) const;
    std::vector<ParameterPair> keys_of(std::size_t join) const {
        return keys_of(join, joins[join].keys);
    }
    std::vector<OffsetGuess> guesses(const Context& context);
    std::vector<LoopPair> correspond(MergeReport& now, const Context& context);
    std::vector<BoundaryValue> values_of(const std::vector<LoopPair>& pairs,
                                         const Region& held) const;
    BoundaryDeformation deform(const std::vector<LoopPair>& pairs, const Context& context);
    std::vector<Vec3> all_positions(const BoundaryDeformation& deformed) const;
    void follow(const BoundaryDeformation& deformed, std::vector<Vec3>& positions) const;
    void turn_directions(const BoundaryDeformation& deformed, Mesh& moved) const;
    std::optional<ThesisMerge> thesis_merge(const std::vector<LoopPair>& pairs,
                                            const MergeReport& now, const Context& context) const;

    // Seams.
    SewOptions sewing(bool collar) const;
    Sewn sew_sides(const Mesh& moved, const std::vector<LoopPair>& pairs,
                   const std::optional<ThesisMerge>& thesis, MergeReport& now,
                   const Context& context) const;
    std::vector<TransitionWidths> asked_widths(const MergeReport& now) const;
    std::vector<FacePair> new_intersections(const Sewn& sewn, const Context& context) const;
    std::vector<Index> changed_faces(const Sewn& sewn) const;
    std::vector<FacePair> own_intersections(const std::vector<Index>& origins,
                                            const Context& context) const;
    void finish_seams(Sewn& sewn, const std::optional<ThesisMerge>& thesis, MergeReport& now,
                      const Context& context) const;

    MergeOptions options;
    std::vector<Join> joins;
    /// Boundaries as given, by join; the source's side, and the targets appended to one mesh.
    std::vector<GivenLoop> given_source_loops, given_target_loops;
    MergeSide source;
    Mesh target;
    MeshMap target_map;
    /// Counts of the elements of the targets as given, together.
    std::shared_ptr<const Topology> given_target_topology;
    std::vector<std::vector<Index>> target_loops;
    /// Loops by join, the source's run the other way so that both run the same way.
    std::vector<Loop> source_curves, target_curves;
    std::vector<Region> features;
    /// The parts behind the first join, once they were asked for.
    std::optional<PartShape> source_part, target_part;
    MergeReport report;
    std::unique_ptr<BoundaryDeformer> deformer;
    /// With the features of a free configuration held as well.
    std::unique_ptr<BoundaryDeformer> featured;
};

}  // namespace lissom
