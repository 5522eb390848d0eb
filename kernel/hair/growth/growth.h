/// Growth: strands that follow the direction field from their roots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/hair/field/hair_field.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Gathers the strands that pass through a disc, as the first cross section of a ponytail does.
struct HairTie {
    Vec3 center = Vec3::Zero();
    /// Strands are caught on their way through the disc in this direction, its normal; of any
    /// length but 0.
    Vec3 direction = Vec3::UnitY();
    double radius = 0.0;
    /// Length grown past the tie, shortened by up to the fraction `ragged`: half of it at random,
    /// more of it more often (as the root of an even chance), half by the square of the strand's
    /// distance from the spine, as a share of the radius. So a tail thins out like a brush, and few
    /// strands are as long as it. Absent: strands become as long as they would without the tie.
    std::optional<double> tail_length = 0.25;
    double ragged = 0.45;
    /// The way of the tail from the center on. As far as it goes the length is measured along it,
    /// so that hair at the outside of a bend ends level with hair at its inside; beyond, or if it
    /// is empty, along each strand.
    std::vector<Vec3> spine = {};
    /// Radii of the tail at the points of `spine`, as many or none: hair fills it. Each strand is
    /// drawn to a place of its own in the cross section over the first few steps behind the tie,
    /// the longest in the middle, so that a tail is round for any hair at its tie.
    std::vector<double> radii = {};
};

/// Cuts hair along a plane.
struct HairCut {
    Vec3 point = Vec3::Zero();
    /// Normal on the side without hair, so down for hair cut to one length; of any length but 0. A
    /// strand ends at its first crossing of the plane in this direction; one that is rooted beyond
    /// the plane is not cut before it has come back.
    Vec3 normal = -Vec3::UnitY();
    /// Each strand has a plane of its own, up to this far before or behind the given one.
    double ragged = 0.0;
};

inline constexpr double kMinSegment = 0.01, kMaxSegment = 10.0;

/// Returns the greatest length that hair in a grid can be asked for: twice the diagonal of its box.
double longest_hair(const GridLayout& layout);

/// Lengths and points are those of the field's grid.
struct GrowthOptions {
    /// Length of a strand, and the fraction by which it varies at random. At most longest_hair of
    /// the grid, as are the lengths of tails.
    double length = 0.25;
    double variation = 0.1;
    /// Factors of the length for every vertex of the head, interpolated at roots; finite and not
    /// negative. Empty for none.
    std::vector<double> length_map = {};
    /// Multiply these factors, those of the length alone; in the coordinates of the field.
    std::vector<MaskStroke> masks = {};
    /// l of section 4.6, in steps of the grid, kMinSegment to kMaxSegment: a segment is l
    /// v(p) long, with the length of v limited to 1.
    double segment = 0.5;
    /// A strand ends if the field is shorter than this.
    double min_speed = 0.05;
    /// A strand ends before a segment that turns by more than this, radians from 0 to pi, as about
    /// a sink of the field. At 88 degrees rounding of the points makes no right angle of it; pi
    /// lets strands turn as they like, until they are long enough or have `max_segments`.
    double max_turn = 88.0 * kPi / 180.0;
    /// Segments at most: flow lines around a ponytail may be closed.
    Index max_segments = 400;
    /// Share of the normal in the first segment, which never points inward unless `start_outward`
    /// is false.
    double lift = 0.15;
    bool start_outward = true;
    /// Vectors longer than 1 count as of length 1, as the field may overshoot.
    bool cap_speed = true;
    /// Strands stay this far outside the head, and up to `layer` farther, most of them near it;
    /// over the first `ramp` of their length the distance grows from nothing. Off: strands follow
    /// the field into the head.
    bool avoid = true;
    double clearance = 0.002, layer = 0.012, ramp = 0.03;
    /// A strand is caught by the first tie that it passes, and by no other.
    std::vector<HairTie> ties = {};
    /// A strand ends at the first of several cuts that it reaches; with `spare_tied`, none cuts
    /// strands that were caught by a tie.
    std::vector<HairCut> cuts = {};
    bool spare_tied = true;
    /// From the coordinates of the field to those of the strands.
    Affine placement = {};
    std::uint64_t seed = 1;
};

/// Reason for the end of a strand.
enum class StrandEnd {
    length,     ///< it is as long as it should be
    cut,        ///< a cut
    slow,       ///< the field is shorter than min_speed
    left_grid,  ///< it left the grid; its last point lies outside
    turned,     ///< the next segment would have turned by more than max_turn
    stuck,      ///< pushed back to its start
    segments,   ///< it has as many segments as allowed
};
inline constexpr int kStrandEnds = 7;

struct GrowthReport {
    /// The tie that caught each strand, as its place in the options, or kNoIndex; empty if there
    /// are no ties.
    std::vector<Index> ties;
    /// Numbers of strands, by the reasons of their ends.
    std::array<Index, kStrandEnds> ends{};

    Index ended_by(StrandEnd end) const { return ends[static_cast<std::size_t>(end)]; }
};

/// Grows strands from the same roots repeatedly, for instance while a curve is dragged: results
/// that depend on the roots alone are computed once, and those of the seed or the length map when
/// they change. Strands grow side by side, neighbours one after the other; the results are the same
/// to the bit on any number of threads and with any vector instructions. For use by one thread at a
/// time.
class StrandGrower {
  public:
    /// Copies its inputs from `head`, which must be the mesh of the roots and in the coordinates of
    /// the fields. Errors: invalid_argument for roots that are not of this mesh; not_finite;
    /// memory_limit; cancelled.
    StrandGrower(const Mesh& head, std::span<const Root> roots, const Context& context = {});
    ~StrandGrower();
    StrandGrower(StrandGrower&&) noexcept;
    StrandGrower& operator=(StrandGrower&&) noexcept;

    /// Number of roots.
    Index size() const;

    /// Grows a strand from every root. Replaces the contents of `strands` and reuses its buffers.
    /// Strand i is that of root i, for any other roots. A strand that cannot grow is its root
    /// alone. No segment is shorter than a thousandth of `segment`. Errors: invalid_argument for
    /// options out of range, or a length map of the wrong size, or more points than can be
    /// numbered; memory_limit; cancelled. After an error there are no strands, but for options out
    /// of range, which are refused first.
    GrowthReport grow(const HairField& field, const GrowthOptions& options, Strands& strands,
                      const Context& context = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Grows strands once, as StrandGrower does.
GrowthReport grow(const Mesh& head, const HairField& field, std::span<const Root> roots,
                  const GrowthOptions& options, Strands& strands, const Context& context = {});

}  // namespace lissom
