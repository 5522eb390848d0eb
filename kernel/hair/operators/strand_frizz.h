/// Frizz: single hairs that leave their lock.
#pragma once

#include "kernel/core/context.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

struct FrizzOptions : StrandOperatorOptions {
    FrizzOptions() { shape = 0.7; }

    /// Metres, about, that a tip moves; 0 or more.
    double amplitude = 0.0009;
    /// Metres along a strand of one bend; positive. Each strand takes up to 30 % more or less.
    double wavelength = 0.03;
    /// Part of the strands, at random, whose amplitude is `flyaway` times as large; 0 to 1, and 0
    /// or more.
    double flyaways = 0.03, flyaway = 4.0;
};

/// Moves each point by two sines of the arc along each axis, of the wavelength and of 2.3 times it,
/// with phases at random for each strand. Errors: invalid_argument for options out of range;
/// not_finite; memory_limit, cancelled.
void frizz(Strands& strands, const FrizzOptions& options = {}, const Context& context = {});

}  // namespace lissom
