/// Whether the seams of a merge are good, in one line; private to kernel/merge.
#pragma once

#include <string>

#include "kernel/merge/merge.h"

namespace lissom {

struct Verdict {
    bool good = false;
    std::string text;
};

/// A seam is good where the surface turns by no more than 30 degrees across it, or by no more than
/// it does beside the boundaries as they were given; where no triangle at it has an angle under 2
/// degrees, or under the smallest that was there; where no faces run through one another that did
/// not before; where source and target do not lie on the same side of their boundary; and where its
/// place is not a toss. The angles of parts that fit (JoinReport::fits) are theirs. The text says
/// what holds, or all that does not. `sought`: intersections were looked for.
Verdict verdict_of(const MergeReport& report, bool sought);

}  // namespace lissom
