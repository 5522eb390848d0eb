/// The measures of a result that a user would see as harm; private to kernel/deform.
#pragma once

#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/deform_report.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/options.h"

namespace lissom {

/// The changes of size that handles ask for by themselves: no fault of the result.
struct AskedSize {
    /// The greatest factor by which one stretches or shrinks a direction, at least 1.
    double length = 1.0;
    /// The least and the greatest factor of a volume, and 1 between them.
    double min_volume = 1.0, max_volume = 1.0;
};

AskedSize asked_size(const Poses& poses);

/// An edge and the factor by which it is longer or shorter than at rest, at least 1.
struct StretchedEdge {
    Index first = kNoIndex, second = kNoIndex;
    double factor = 1.0;
};

/// The factor above which an edge is warned of.
double stretch_limit(const AskedSize& asked);

/// Returns the warnings of a report, tears aside. `stretched` has the edges beyond the
/// limit.
std::vector<DeformWarning> warnings_of(const DeformReport& report, const AskedSize& asked,
                                       const std::vector<StretchedEdge>& stretched,
                                       const DeformOptions& options);

}  // namespace lissom
