/// The thesis's transition for tests of merging, in builds that have it.
#pragma once

#ifdef LISSOM_HAS_THESIS
#include "kernel/thesis/transition/literal_transition.h"
#endif
#include "kernel/merge/blend/overlap_transition.h"

namespace lissom::test {

/// Null in builds without kernel/thesis.
inline const OverlapTransition* thesis_overlap() {
#ifdef LISSOM_HAS_THESIS
    return &literal_transition();
#else
    return nullptr;
#endif
}

}  // namespace lissom::test
