/// Whether a scatter is good, in one line; private to kernel/merge.
#pragma once

#include "kernel/core/index.h"
#include "kernel/merge/paste/scatter.h"

namespace lissom {

/// Judges the findings at `places` places, and writes verdict and reasons into them. It is good if
/// - no faces of parts run through one another that did not before;
/// - all parts that stand are good themselves (verdict_of);
/// - at most one of ten places has no part.
void judge_scatter(ScatterResult& result, Index places);

}  // namespace lissom
