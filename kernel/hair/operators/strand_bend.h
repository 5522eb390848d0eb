/// Operators that bend or move strands as wholes: straighten, rotate, roll, puff, displace, and
/// their length. Points and vectors are in the unit and along the axes of the strands.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Stretches strands out towards the straight line from their root to their tip. Lengths are kept.
/// Errors of all operators in this file: invalid_argument for options out of range; not_finite;
/// memory_limit, cancelled.
void straighten(Strands& strands, const StrandOperatorOptions& options = {},
                const Context& context = {});

struct RotateOptions : StrandOperatorOptions {
    /// Axis of the rotation, of any length but 0; absent: the direction in which each strand leaves
    /// the head.
    std::optional<Vec3> axis = std::nullopt;
    /// Radians, and by how much each strand turns more or less at random.
    double angle = 0.0, variation = 0.0;
};

/// Turns the segments of each strand about an axis: with the shape 0 the strand as a whole about
/// its root, else its tip by the angle and the rest by less.
void rotate(Strands& strands, const RotateOptions& options, const Context& context = {});

struct RollOptions : StrandOperatorOptions {
    /// Metres from the axis of the roll; positive.
    double radius = 0.015;
    /// Place where the roll begins, 0 at the root and 1 at the tip; 0 to below 1.
    double start = 0.5;
    /// Rolls away from `center` instead of towards it.
    bool outward = false;
    /// Inside of the head; absent: the middle of all roots.
    std::optional<Vec3> center = std::nullopt;
};

/// Rolls up the ends of strands, as on curlers. Lengths are kept.
void roll(Strands& strands, const RollOptions& options = {}, const Context& context = {});

struct PuffOptions : StrandOperatorOptions {
    PuffOptions() { profile = {0.0, 0.6, 1.0, 1.0, 0.9}; }

    /// Metres that strands rise; negative lets them sink. Finite.
    double amount = 0.01;
    /// They rise away from this point; absent: the middle of all roots.
    std::optional<Vec3> center = std::nullopt;
};

/// Lifts strands off the head.
void puff(Strands& strands, const PuffOptions& options = {}, const Context& context = {});

struct DisplaceOptions : StrandOperatorOptions {
    DisplaceOptions() { shape = 1.0; }

    /// Metres that all tips move.
    Vec3 offset = Vec3::Zero();
    /// Besides, metres that each strand moves; empty for none.
    std::vector<Vec3> offsets = {};
};

/// Moves strands by vectors.
void displace(Strands& strands, const DisplaceOptions& options, const Context& context = {});

struct LengthOptions : StrandOperatorOptions {
    /// Each strand is scaled to this length in metres; positive. Absent: as it is.
    std::optional<double> length = std::nullopt;
    /// And by this; positive.
    double scale = 1.0;
    /// Each strand is up to this part longer or shorter, at random; 0 to below 1.
    double variation = 0.0;
};

/// Makes strands longer or shorter by scaling them about their roots: their shape stays. The mask
/// and the factor go from the old length to the new one.
void set_length(Strands& strands, const LengthOptions& options, const Context& context = {});

}  // namespace lissom
