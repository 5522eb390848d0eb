/// The thesis's formulas for tests of merging, in builds that have them.
#pragma once

#ifdef LISSOM_HAS_THESIS
#include "kernel/thesis/fidelity.h"
#endif
#include "kernel/merge/merge.h"

namespace lissom::test {

/// Returns null in builds without kernel/thesis.
inline const ThesisFormulas* thesis() {
#ifdef LISSOM_HAS_THESIS
    return &thesis_formulas();
#else
    return nullptr;
#endif
}

/// Returns the defaults of a configuration in builds without kernel/thesis.
inline MergeOptions thesis_or_default(Configuration configuration = Configuration::free) {
#ifdef LISSOM_HAS_THESIS
    return thesis_merge_options(configuration);
#else
    MergeOptions options;
    options.configuration = configuration;
    return options;
#endif
}

}  // namespace lissom::test
