/// Scatter: one feature pasted many times over a surface. Each paste sees a small disk of the
/// target alone, and all that do not touch are put into the mesh together, so that the cost of
/// hundreds follows their size, not the target's.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/merge.h"
#include "kernel/merge/paste/paste.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Treatment of a part that would run through itself, the target or a part before it, or that would
/// bite into sharp edges of the target or fold beside its seam.
enum class ScatterCrossings {
    /// One that bites moves away from the edge first, by its own reach at most. It is made smaller,
    /// by a fifth at a time and by a half at most; one that is no good even then is refused.
    shrink,
    /// Its place is refused.
    leave_out,
    /// It stays, and the report tells it.
    keep,
};

struct ScatterOptions {
    /// `clear` and `cleared` must not be set.
    PasteOptions paste;
    /// `draft` must not be set.
    PasteMergeOptions merge = {.find_intersections = false, .compare = false};
    /// Iterations of the search for each boundary; 0 takes the outline of the region.
    Index iterations = 4;
    ScatterCrossings crossings = ScatterCrossings::shrink;
};

/// A place without the feature, and the reason.
struct RefusedPlace {
    Index place = kNoIndex;
    ErrorCode code = ErrorCode::internal;
    std::string message;
};

/// A place whose part was made smaller so that it crosses nothing, and the scale that it has.
struct ShrunkPlace {
    Index place = kNoIndex;
    double scale = 1.0;
};

/// A place whose part was moved away from a sharp edge of the target, and its new position.
struct MovedPlace {
    Index place = kNoIndex;
    Vec3 at = Vec3::Zero();
};

/// A part that stands though it is not good, and why; see MergeReport.
struct FaultyPlace {
    Index place = kNoIndex;
    std::vector<MergeReason> reasons;
};

struct ScatterResult {
    /// Whether all parts that stand are good, none runs through another, and nine of ten places
    /// have one; in one line why not; and each reason, with its figure, limit and remedy.
    bool ok = false;
    std::string verdict;
    std::vector<MergeReason> reasons;
    /// Parts that stand.
    Index placed = 0;
    Mesh mesh;
    /// For each face the place that it belongs to, or kNoIndex for those of the target.
    std::vector<Index> place_of_face;
    /// In the order of their numbers.
    std::vector<RefusedPlace> refused;
    std::vector<ShrunkPlace> shrunk;
    std::vector<MovedPlace> moved;
    std::vector<FaultyPlace> faulty;
    /// Pairs of faces that cross, of parts that were kept nevertheless.
    Index crossings = 0;
    /// Times that pastes were put into the mesh together.
    Index rounds = 0;
};

/// Pastes the feature at all `places`, those with lower numbers first if two meet: a place that
/// lies on a part, or has no room for the ring between parts, is refused, and so is each whose
/// paste fails, would cross other parts or would not be good (ScatterCrossings). Long edges of the
/// target beside a place are halved until there is room (finer_near). The result does not depend on
/// the number of threads. The target's faces away from places keep their order and their values to
/// the bit, its vertices too.
/// Errors: as Paste's constructor for the source and its regions; topology_mismatch; mesh_empty;
/// invalid_argument for options out of range, a scale that is not above 0 or a target to be
/// cleared; not_finite; memory_limit; cancelled.
ScatterResult scatter(const Mesh& source, const Mesh& target, const Region& region,
                      const std::optional<Region>& feature, std::span<const PastePlacement> places,
                      const ScatterOptions& options = {}, const Context& context = {});

}  // namespace lissom
