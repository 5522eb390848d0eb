/// Curls and waves: strands that wind around their own course.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Sense in which curls wind.
enum class CurlHand {
    random,    ///< left or right, at random for each guide
    left,      ///< all as a screw thread to the left
    right,     ///< all to the right
    mirrored,  ///< right if the guide's root has x above 0, left if not
};

struct CurlOptions : StrandOperatorOptions {
    /// Guides to assign; 0: those that strands have, or kUsualGuides. Strands of one guide curl
    /// together.
    Index guides = 0;
    /// Metres from the course to the curl; 0 or more.
    double radius = 0.0095;
    /// Metres along the course of one turn; positive.
    double wavelength = 0.03;
    /// Radius at the tip as a part of `radius`; 0 or more.
    double tip = 1.0;
    /// The curl begins at `start` metres from the root and has its radius `ramp` metres further; 0
    /// or more.
    double start = 0.02, ramp = 0.1;
    /// Turns are longer at the root and shorter at the tip by this part, as the weight of hair
    /// draws curls out; 0 to 1.5.
    double hang = 0.5;
    /// Radius and wavelength of each guide are up to this part larger or smaller, at random; 0 to
    /// below 1.
    double variation = 0.2;
    /// Part of a turn by which strands of one guide differ: .06 a wire, .2 a ribbon, .5 a coil, 1 a
    /// tube of fuzz; 0 to 1.
    double phase = 0.22;
    /// Neighbouring guides begin their turns alike, as in waves that were set; without it at
    /// random.
    bool together = false;
    /// Turns that each strand has at its root, in place of those of its guide; empty for these.
    /// Hair whose turns grow with its way from a line has its crests along that line, as finger
    /// waves.
    std::vector<float> begin = {};
    CurlHand hand = CurlHand::random;
    /// Extent of the winding towards the normal as a part of that across it: 1 is a helix, 0 a wave
    /// in a surface; 0 to 1.
    double depth = 1.0;
    /// Strands with fewer points a turn get more; 0 keeps their points. At most 64.
    Index points_per_turn = 12;
};

/// Winds strands around their course B: x = B(a) + R(a) (depth cos phi N + sin phi B'), the frame
/// (N, B') turning as little as possible from a root where N is the side that the guide bends to,
/// on a head inward; phi counts turns along the arc of the guide, so that strands of one guide stay
/// together whatever their own lengths are. With `keep_length` hair winds up and becomes shorter on
/// the head; without it strands become longer. The effect of factor, mask and profile is on the
/// radius. Errors: invalid_argument for options out of range, or if there would be more points than
/// can be numbered; not_finite; memory_limit, cancelled.
void curl(Strands& strands, const CurlOptions& options = {}, const Context& context = {});

/// Returns the options of waves: wide, flat, and alike for neighbours.
CurlOptions wave_options();

}  // namespace lissom
