/// Strands as a graphics card draws them: a ribbon each, in an even random order, so that the first
/// of them are a fair sample of all.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/render/draw/snapshot.h"
#include "viewer/render/strands/view_strands.h"

namespace lissom {

/// Points of at most this many strands stand for all while something moves, each with at most so
/// many points.
inline constexpr Index kFewStrands = 4096;
inline constexpr Index kFewPoints = 16;

struct PackedPoint {
    /// Metres, as the strands have them.
    std::array<float, 3> position;
    /// Square roots of the linear colour over `kBrightest`, tones included, and of the width over
    /// the widest; times 255.
    std::array<std::uint8_t, 4> look;

    bool operator==(const PackedPoint&) const = default;
};
/// A strand may have a colour so bright, tones included.
inline constexpr float kBrightest = 2.0f;

/// Every ribbon begins and ends with a point of no width that lies on its neighbour: one strip of
/// triangles through all points then draws nothing between ribbons.
struct PackedRibbons {
    std::vector<PackedPoint> points;
    /// Radians by which reflections lean more: -shift_jitter (0) to shift_jitter (255); one a
    /// point.
    std::vector<std::uint8_t> shifts;
    /// Strand i, in drawing order, has the points offsets[i] to offsets[i + 1] - 1; none if it has
    /// no two finite points that follow each other.
    std::vector<Index> offsets{0};

    Index size() const { return count_of(offsets) - 1; }
    std::size_t bytes() const { return points.size() * sizeof(PackedPoint) + shifts.size(); }
};

struct PackedStrands {
    /// All that are drawn; and few, with fewer points, that stand for them.
    PackedRibbons all, few;
    /// Metres.
    float widest = 0.0f;
    /// Square metres: of all ribbons seen from the side, and of the hair seen from outside,
    /// roughly.
    double ribbon_area = 0.0, outer_area = 0.0;
};

/// Returns the first `count` strands in an even random order: near each other along a curve that
/// fills the space of their roots, they are taken in bit-reversed order. The roots of every
/// beginning are spread as those of all.
std::vector<Index> even_order(const Strands& strands, Index count);

/// Returns the strands that `drawn.style` asks for. `few_only`: `all` stays empty. Errors: those of
/// view_strands; memory_limit; cancelled.
PackedStrands pack_strands(const DrawnStrands& drawn, bool few_only = false,
                           const Context& context = {});

/// Returns the factor of the widths if `count` strands stand for `all`: as much wider as they are
/// fewer. Beyond four times only as far as opacity needs: if strands hide each other many times
/// over, few strands may be thinner.
double widening(const PackedStrands& packed, Index count, Index all);

}  // namespace lissom
