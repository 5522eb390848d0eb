/// Noise: strands wander off their course, neighbours together.
#pragma once

#include <cstdint>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Smooth noise in space (Perlin 2002), three numbers of about [-1, 1] whose mean is 0; features
/// have the size 1. The same on every machine.
Vec3 smooth_noise(const Vec3& place, std::uint64_t seed);

struct NoiseOptions {
    /// Greatest distance in metres, about, that a tip moves; 0 or more. It moves less if it would
    /// turn a segment by more than 27 degrees, or a shorter one than usual by less; a warning is
    /// logged if that holds for most segments.
    double amplitude = 0.0016;
    /// Distance in metres of roots that wander apart; positive.
    double across = 0.02;
    /// Length in metres along a strand of one deviation; positive.
    double along = 0.11;
    /// The amplitude grows with t^shape; positive.
    double shape = 1.0;
    /// Deviations add up along the strand, as if each segment turned those after it.
    bool cumulative = false;
    /// Segments keep their lengths; without it strands become a little longer.
    bool keep_length = true;
    std::uint64_t seed = 1;
    /// Its factor, mask and profile count, besides the options above.
    StrandOperatorOptions effect = {};
};

/// Moves points across their strand by smooth noise: at the root's place / across, shifted along
/// with the arc length / along, less its value at the root. Strands do not fold. Guarantees of all
/// operators: strand_operators.h. Errors: invalid_argument for options out of range; not_finite;
/// memory_limit, cancelled.
void noise(Strands& strands, const NoiseOptions& options = {}, const Context& context = {});

}  // namespace lissom
