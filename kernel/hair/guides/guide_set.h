/// Guide sets: a few strands that move, and all others as sums of three of them, as engines and
/// simulations keep hair.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

enum class GuideChoice {
    count,   ///< as many as are asked for
    groups,  ///< one for each group
    locks,   ///< one for each guide that strands follow, as one a curl
};

struct GuideSetOptions {
    GuideChoice of = GuideChoice::count;
    /// Number of guides, for GuideChoice::count; at least 3.
    Index count = 200;
    /// Points of each guide and of each strand that is rebuilt, at equal steps; 2 to 256.
    Index points = 16;
    /// Weight of shapes: ClusterOptions::shape.
    double shape = 1.0;
};

/// A strand as a sum of guides. Its point k is root + length * (the sum over i of weights[i] *
/// (guide(guides[i], k) - guide(guides[i], 0))), plus its detail.
struct GuidedStrand {
    Eigen::Vector3f root = Eigen::Vector3f::Zero();
    /// Factor of the guides' shape; 0 for strands without length.
    float length = 0.0f;
    /// Numbers of guides, the one of the greatest weight first; a guide with weight 0 may repeat.
    std::array<std::uint32_t, 3> guides{};
    /// 0 or more; they sum to 1.
    std::array<float, 3> weights{1.0f, 0.0f, 0.0f};
    /// Id of the strand, and the diameter at its root in metres.
    std::uint32_t id = 0;
    float width = kHairWidth;
};

/// Distances between strands and their sums of guides without details, over all points, in metres.
struct GuideError {
    double rms = 0.0, max = 0.0;
    /// The strand with the greatest.
    Index strand = kNoIndex;
};

struct GuideSet {
    Index points = 0;
    /// The strand that each guide is.
    std::vector<Index> strands;
    /// Points of all guides, one guide after the other; metres.
    std::vector<Eigen::Vector3f> curves;
    /// One for each strand.
    std::vector<GuidedStrand> guided;
    /// Differences of the strands' points from the sums of guides: three integers a point, times
    /// detail_step metres.
    std::vector<std::int16_t> details;
    float detail_step = 0.0f;
    GuideError error;
    /// Group of each guide, as a place in `group_names`, or kNoIndex; empty if there are none.
    std::vector<Index> groups;
    std::vector<std::string> group_names;

    Index guide_count() const { return count_of(strands); }
};

/// Chooses guides, as cluster_strands has medoids, and finds for each strand the three of its group
/// and the weights with the least squared error among the six guides that are most alike.
/// Errors: invalid_argument for options out of range, if fewer than three strands have a length, or
/// if there are no groups or locks; not_finite naming strands; memory_limit; cancelled.
GuideSet make_guide_set(const Strands& strands, const GuideSetOptions& options = {},
                        const Context& context = {});

struct RebuildOptions {
    /// Points of the moved guides, as GuideSet::curves; empty for those at rest.
    std::span<const Eigen::Vector3f> curves = {};
    /// Adds the details, turned with the first guide of the strand as lissom_hair.h does.
    bool details = true;
};

/// Returns the points of all strands, GuideSet::points each. Roots move as the roots of their
/// guides do. Errors: invalid_argument for another number of points; memory_limit; cancelled.
std::vector<Eigen::Vector3f> rebuild_strands(const GuideSet& set,
                                             const RebuildOptions& options = {},
                                             const Context& context = {});

}  // namespace lissom
