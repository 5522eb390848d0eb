/// Parts of kernel/thesis that options take. A build without that folder has none of them.
#pragma once

#include "kernel/deform/options.h"
#include "kernel/merge/merge.h"

namespace lissom::lua {

/// Returns the maker of the comparison methods, or null.
ComparisonMaker comparison_maker();

/// Returns the thesis's transition of merging, or null.
const OverlapTransition* thesis_overlap();

}  // namespace lissom::lua
