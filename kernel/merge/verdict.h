/// Whether the seams of a merge are good, in one line; private to kernel/merge.
#pragma once

#include <string>
#include <vector>

#include "kernel/merge/merge.h"

namespace lissom {

/// Lists the options of an operation that its caller could still change: it has them, and they are
/// not set. Remedies name no others.
struct OpenOptions {
    /// Crossings were looked for.
    bool sought = true;
    /// Keys can be given.
    bool keys = false;
    /// The seam can be fair; a transition can be made; the one that was made can be left out.
    bool fair = false, transition = false, no_transition = false;
    /// More umbrella steps would be made; the collar, which is off, can be left on.
    bool smooth = false, collar = false;
    /// Regions of the source can be fixed; the configuration can be free.
    bool fixed = false, free = false;
    /// The result depends on the place, rotation and size of the part.
    bool moves = false;
};

struct Verdict {
    bool good = false;
    std::string text;
    std::vector<MergeReason> reasons;
};

/// Judges the whole band around each seam against the parts as they were before. It is good if
/// - no faces run through one another that did not before (`open.sought`: they were looked for),
///   but for those that only touch (CrossingGroup::shallow) or lie within the body
///   (CrossingGroup::hidden);
/// - source and target do not lie on the same side of their boundary;
/// - the surface does not fold back within one radius of the seam and did not before, but for .15
///   radii in all; edges of one side within half a radius do not turn by more than 60 degrees along
///   1.3 radii more than before; and thorns and pits of the source within half a radius that it did
///   not have are together at most .22 radii wide;
/// - within half a radius it is at most 1.4 times as rough as both sides were, or turns by less
///   than 8 degrees an edge; the source by itself 1.6 times as rough as it was, or it turns by less
///   than 11 degrees, merged above 14 degrees 1.4 times; the target 1.3 times, or by 5 degrees, as
///   a whole and at its edges below 40 degrees; the source at those 1.3 times, or by 11 degrees, or
///   it gained edges of more than 25 degrees along at most 2 radii; and edges of a merge that turn
///   by 20 degrees more than at rest, or the other way, are together at most 6 radii long;
/// - each part keeps two fifths of its volume at its scale, and the target of a paste half of its
///   area;
/// - planes fitted to either side of the seam differ by at most 35 degrees in the mean, 60 along a
///   tenth of it, and by the crease of a paste, or 1.3 times as much as they did beside the
///   boundaries;
/// - the rim of the source turns outward by at most 65 degrees more than at rest, or 22.5 if the
///   source became rougher as well; not measured of a paste, whose rim is tilted on purpose;
/// - tips and pits within half a radius of the seam lack at most 45 degrees to full turns and 1.5
///   times as much as the sharpest did before, or 88 degrees if that is less, or 1.35 times as
///   much;
/// - the surface turns by no more than 30 degrees at the edges of the seam, but for a thirtieth of
///   its length, and 20 in the mean (two thirds of the crease of a paste), or by no more than a
///   thirtieth of the edges at the boundaries did, 1.3 times as much in the mean;
/// - a paste takes no sharp edge of its target along more than .3 of its radius, or deeper than
///   .15;
/// - its place is not a toss;
/// - no triangle at the seam has an angle under 2 degrees, or under the smallest that was there or
///   that dividing the polygons there makes.
/// Angles of parts that fit (JoinReport::fits) are theirs. The text says which conditions hold, or
/// all that do not.
Verdict verdict_of(const MergeReport& report, const OpenOptions& open);

/// Whether a paste takes more of the sharp edges of its target than a verdict lets pass.
bool is_bitten(const TargetBite& bite);

/// Whether thorns and pits are all that a report that was judged finds fault with.
bool has_only_thorns(const MergeReport& report);

/// Judges a report, and writes verdict and reasons into it.
void judge(MergeReport& report, const OpenOptions& open);

}  // namespace lissom
