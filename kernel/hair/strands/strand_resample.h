/// Other points on the same strands.
#pragma once

#include <functional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// A place on a strand: `u` (0 to 1) of the way from point `below` to the next.
struct StrandPlace {
    Index below = 0;
    float u = 0.0f;
};

/// Strands whose points lie at places on those of `strands`, each with all that is known of it;
/// values of points are interpolated. `find(strand, places)` is called once a strand, on several
/// threads, with an empty list, and adds at least one place, from the root on. Errors:
/// invalid_argument if there would be more points than can be numbered; memory_limit, cancelled.
Strands at_places(const Strands& strands,
                  const std::function<void(Index strand, std::vector<StrandPlace>& places)>& find,
                  const Context& context = {});

/// Part of a strand's length in metres to keep, 0 to 1; `fractions` are those of its points
/// (`arc_fractions`), at least two.
using KeptPart =
    std::function<double(Index strand, const std::vector<double>& fractions, double length)>;

/// Shortens strands at their tips. `part` is called on several threads. Errors: as at_places.
Strands shortened(const Strands& strands, const KeptPart& part, const Context& context = {});

/// Returns the place on a strand at the arc length fraction `t`; `fractions` are those of its
/// points (`arc_fractions`), at least two.
StrandPlace place_at(const std::vector<double>& fractions, double t);

/// One of the two must be set.
struct ResampleOptions {
    /// Points of each strand; at least 2, or 0 for `step`.
    Index count = 0;
    /// Distance in metres of points along the strand, adjusted a little to keep the tip; positive,
    /// or 0 for `count`.
    double step = 0.0;
};

/// Spreads points evenly along each strand. Roots and tips stay to the bit; strands of one point
/// stay as they are.
/// Errors: invalid_argument for options out of range; as `at_places`.
Strands resample(const Strands& strands, const ResampleOptions& options,
                 const Context& context = {});

/// Gives each strand as many points as `counts` says, at least 1, spread evenly; strands that have
/// as many already stay to the bit. Errors: as `at_places`.
Strands with_point_counts(const Strands& strands, const std::vector<Index>& counts,
                          const Context& context = {});

}  // namespace lissom
