/// The thesis's transition of merging (section 3.3.3); private to kernel/thesis.
#pragma once

#include "kernel/merge/blend/overlap_transition.h"

namespace lissom {

/// Returns the one transition of this kind; it lives as long as the program.
const OverlapTransition& literal_transition();

}  // namespace lissom
