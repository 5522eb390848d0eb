/// Options of fidelity = "thesis", which kernel/thesis makes. A build without that folder refuses
/// them as `unsupported`.
#pragma once

#include "kernel/deform/options.h"
#include "kernel/merge/merge.h"

namespace lissom::lua {

/// Returns the maker of the comparison methods, or null in such a build.
ComparisonMaker comparison_maker();

/// Errors: unsupported.
DeformOptions literal_deform_options();
const ThesisFormulas& literal_formulas();
MergeOptions literal_merge_options(Configuration configuration);

}  // namespace lissom::lua
