/// Faults of hair that engines and films do not take, each with the strands that have it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Receiver of the hair.
enum class StrandTarget {
    unreal,  ///< strands of Unreal Engine's groom assets
    unity,   ///< strands of Unity's hair package
    godot,   ///< cards, as there are no strands
    film,    ///< renderers of strands without limits
};

/// Limits of a target.
struct StrandLimits {
    /// Points of one strand.
    Index min_points = 2, max_points = 0;
    /// Strands and points of one group; strands without a group count as one.
    Index max_strands = 0, max_points_of_group = 0;
    /// Triangles of cards.
    Index max_triangles = 0;
};

/// Returns the limits of a target. Unreal stores 8 bits for the points of a strand, 22 for the
/// strands and 24 for the points of a group; Unity has 3 to 128 points and 64,000 strands. The
/// triangles of a head of hair are advice.
StrandLimits limits_of(StrandTarget target);

enum class StrandFault {
    not_finite,       ///< a coordinate is NaN or infinite
    no_length,        ///< all points lie on one place
    few_points,       ///< fewer points than the target takes
    many_points,      ///< more points than the target takes
    large_group,      ///< a group has more strands or points than the target takes
    no_widths,        ///< a width is zero, negative or not finite
    no_root_uvs,      ///< roots have no texture coordinates
    off_head,         ///< a root is not on the head
    inside_head,      ///< a strand runs through the head
    duplicate_roots,  ///< another strand has the same root
    wrong_unit,       ///< the hair has not the size of a head
    wrong_axis,       ///< the hair does not stand up along y
    lost_guide,       ///< the guide of a strand is not among the strands
    short_guide,      ///< a strand is longer than its guide reaches
    many_triangles,   ///< cards have more triangles than the target takes
};

struct StrandCheckFinding {
    StrandFault fault = StrandFault::not_finite;
    /// The target takes the hair nevertheless.
    bool is_warning = false;
    /// Strands with the fault, in their order; empty if it is one of all hair.
    std::vector<Index> strands;
    /// Number of strands, or of triangles for many_triangles.
    Index count = 0;
    /// A sentence with the figure and the limit.
    std::string message;
};

struct StrandCheckOptions {
    StrandTarget target = StrandTarget::unreal;
    /// Signed distance in metres to the head, negative inside; empty: roots and depth are not
    /// checked. Called on several threads.
    std::function<double(const Vec3&)> distance = {};
    /// Triangles of the cards that stand for the hair; none if absent.
    std::optional<Index> triangles = std::nullopt;
    /// Metres from the head that a root may be, and that a strand may lie inside.
    double root_distance = 0.005, depth = 0.002;
};

/// Checks strands for a target. Faults come in the order of StrandFault. Errors: invalid_argument
/// for distances that are negative or not finite; cancelled.
std::vector<StrandCheckFinding> check_strands(const Strands& strands,
                                              const StrandCheckOptions& options = {},
                                              const Context& context = {});

}  // namespace lissom
