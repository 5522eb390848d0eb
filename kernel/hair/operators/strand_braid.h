/// Braids and buns: strands that are cut at a tie and go on along a spine or around it.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strand_pass.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// A tie: strands that pass its plane forwards within its reach are in it.
struct StrandTie {
    Vec3 center = Vec3::Zero();
    /// Direction in which hair passes, of any length but 0.
    Vec3 direction = Vec3::UnitZ();
    /// Metres from the center to where strands count; positive.
    double reach = 0.035;
};

struct BraidOptions : StrandOperatorOptions {
    /// The middle of the braid, from its tie on, in metres of the strands; smoothed. At least two
    /// points that differ. If it is shorter than the braid, that ends where it does.
    std::vector<Vec3> spine;
    /// Direction across the braid: it is seen from the side of `across` x spine, and is widest
    /// along it. Must not run along the spine's beginning.
    Vec3 across = Vec3::UnitX();
    /// Metres: of each of the three tubes; positive.
    double radius = 0.0125;
    /// Metres from the spine to where strands enter at the tie; 0: 2.2 radii of a tail of 1.3 times
    /// the tube's radius.
    double reach = 0.0;
    /// Metres from the tie to the lower tie, and of the tuft below it; positive, 0 or more.
    double length = 0.25, tuft = 0.04;
    /// Metres of one turn of a tube; 0: 7 radii.
    double wavelength = 0.0;
    /// Part by which the braid is narrower at its end; 0 to below 1.
    double taper = 0.35;
    /// Metres over which hair comes from the tie into its tube; positive.
    double blend = 0.03;
    /// Part of the strands that lie loosely around their tube, and that end early; 0 to 1.
    double loose = 0.03, early = 0.05;
    /// Metres between points; positive.
    double step = 0.0025;
};

/// Number of strands that were taken, and of the others.
struct BraidReport {
    Index braided = 0, missed = 0;
};

/// Braids the strands that pass a tie at the beginning of the spine. They are cut there, sorted
/// into three tubes by their place across, and go on in these: with phi = 2 pi (a / wavelength + i
/// / 3) the centers are at 1.25 r sin phi across and .8 r sin 2 phi towards the viewer. Other
/// strands stay to the bit, those of a mask below .5 too; the factor does not count. Lengths are
/// those of the braid. Errors: invalid_argument for options out of range, and if fewer than three
/// strands pass the tie; not_finite; memory_limit, cancelled.
BraidReport braid(Strands& strands, const BraidOptions& options, const Context& context = {});

struct BunOptions : StrandOperatorOptions {
    StrandTie tie;
    /// Metres: from the axis to the middle of the torus, and of its tube; positive. A tube wider
    /// than the torus closes its hole.
    double radius = 0.0175, tube = 0.0195;
    /// Metres of the torus's middle above the tie.
    double lift = 0.005;
    /// Radians that hair goes around the axis while it goes once over the tube.
    double turn = 2.9;
    /// Locks, and the part of the strands that lie loosely; at least 1, 0 to 1.
    Index locks = 9;
    double loose = 0.02;
    /// Points of each strand in the bun, at least 4.
    Index points = 60;
};

/// Winds the strands that pass a tie over a torus around it, from the hole outwards and under.
/// Errors and the rest as braid.
BraidReport bun(Strands& strands, const BunOptions& options, const Context& context = {});

}  // namespace lissom
