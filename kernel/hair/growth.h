/// Growth: strands that follow the direction field from their roots.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/hair_field.h"
#include "kernel/hair/roots.h"
#include "kernel/hair/strands.h"

namespace lissom {

/// Lengths are in the unit of the mesh.
struct GrowthOptions {
    /// Length of a strand, and by which share of it at most each is longer or shorter.
    double length = 0.25;
    double variation = 0.1;
    /// Factors of the length for every vertex of the head, interpolated at roots; finite and not
    /// negative. Empty for none.
    std::vector<double> length_map = {};
    /// l of section 4.6, in steps of the grid: a segment is l v(p) long, where the length of v is
    /// at most 1.
    double segment = 0.5;
    /// A strand ends where the field is shorter than this.
    double least_speed = 0.05;
    /// Segments at most: flow lines around a ponytail may be closed.
    Index most_segments = 400;
    /// Share of the normal in the first segment, which never points inward.
    double lift = 0.15;
    /// Strands stay this far outside the head, and up to `layer` farther, most of them near it;
    /// over the first `ramp` of their length the distance grows from nothing. Off: strands follow
    /// the field into the head.
    bool avoid = true;
    double clearance = 0.002, layer = 0.012, ramp = 0.03;
    /// Metres in one unit of the mesh: strands are in metres.
    double unit = 1.0;
    std::uint64_t seed = 1;
};

/// Grows a strand from every root into `strands`, which keeps its memory but nothing else: strand i
/// is that of root i, whatever other roots there are, on any number of threads. A strand also ends
/// where it leaves the grid. `head` must be the mesh of the roots.
/// Errors: invalid_argument for options out of range, or a length map of the wrong size;
/// memory_limit; cancelled. After an error there are no strands.
void grow(const Mesh& head, const HairField& field, std::span<const Root> roots,
          const GrowthOptions& options, Strands& strands, const Context& context = {});

}  // namespace lissom
