/// More hair of little: strands interpolated between guides, and copies around strands.
#pragma once

#include <cstdint>
#include <span>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

struct InterpolateOptions {
    /// Number of guides around a root that a strand is between; at least 1.
    Index near = 4;
    /// Guides whose middles are combed to another side than that of the nearest guide, by more than
    /// this angle in radians, do not count: hair stays on its side of a parting. Above 0.
    double apart = 75.0 * kDegree;
    /// Points of each strand, at least 2.
    Index points = 24;
};

/// Returns a strand at each root, whose course is the mean of those of the nearest guides, by the
/// inverse square of their distances. `roots` are in the metres of the strands. Strands have the
/// group of their nearest guide and the common width of the guides. Errors: invalid_argument for
/// options out of range, or if no guide is finite and has a length; memory_limit; cancelled.
Strands interpolate(const Strands& guides, std::span<const Root> roots,
                    const InterpolateOptions& options = {}, const Context& context = {});

struct DuplicateOptions {
    /// Copies of each strand; at least 0.
    Index copies = 4;
    /// Metres around the strand within which the roots of its copies lie, evenly over the disc; 0
    /// or more.
    double radius = 0.002;
    /// Factor of that distance at the tip; 0 brings copies to one point, 1 keeps them apart.
    double tip = 1.0;
    std::uint64_t seed = 1;
};

/// Adds copies beside each strand, behind all strands that there were, with new ids, and with the
/// strand as their guide if it has none. Strands that are not finite or without length get none.
/// Errors: invalid_argument for options out of range or more strands than can be numbered;
/// memory_limit; cancelled. After one the strands are as they were.
void duplicate(Strands& strands, const DuplicateOptions& options = {}, const Context& context = {});

struct BlendOptions : StrandOperatorOptions {
    /// Number of guides: the strands of the lowest ids; at least 1.
    Index guides = 400;
    /// Guides that each strand is between; at least 1.
    Index near = 4;
};

/// Moves strands towards the mean of the guides around them, as if they were interpolated:
/// neighbours become alike. Errors: as change_strands, and invalid_argument for options out of
/// range.
void blend(Strands& strands, const BlendOptions& options = {}, const Context& context = {});

}  // namespace lissom
