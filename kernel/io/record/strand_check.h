/// The check of strands before they are written; private to kernel/io.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/io/record/options.h"
#include "kernel/io/record/strand_report.h"

namespace lissom {

/// Limits of a format.
struct StrandCapacity {
    /// Fewest points of a strand.
    Index min_points = 2;
    bool widths = false;
    /// Widths that change along a strand, if there are widths.
    bool widths_along = true;
    bool colors = false, transparency = false;
    /// Transparency is kept only beside colours.
    bool transparency_with_colors = false;
    bool root_uvs = false, groups = false;
    /// Ids, faces and barycentric coordinates of the roots, and guides.
    bool origins = false;
    /// The number of points that all strands must have, if the longest has `points`; null for any.
    Index (*point_count)(Index points) = nullptr;
};

/// Strands that are fit to be written; nothing if they are as they were.
struct CheckedStrands {
    std::optional<Strands> changed;
    StrandReport report;
};

/// Checks strands for values on which hair files are known to break. Errors: with options.mend
/// false, not_finite or invalid_argument naming the strands; cancelled, memory_limit.
CheckedStrands check_strands(const Strands& strands, const StrandCapacity& capacity,
                             const StrandSaveOptions& options, const Context& context);

}  // namespace lissom
