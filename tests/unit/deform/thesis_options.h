/// Options of the thesis for tests of deformation, in builds that have them.
#pragma once

#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/options.h"
#ifdef LISSOM_HAS_THESIS
#include "kernel/merge/blend/overlap_transition.h"
#include "kernel/thesis/fidelity.h"
#endif

namespace lissom::test {

/// Whether this build has kernel/thesis.
#ifdef LISSOM_HAS_THESIS
inline constexpr bool kHasThesis = true;
#else
inline constexpr bool kHasThesis = false;
#endif

/// Returns the defaults in builds without kernel/thesis.
inline DeformOptions thesis_or_default() {
#ifdef LISSOM_HAS_THESIS
    return thesis_deform_options();
#else
    return {};
#endif
}
inline BoundaryDeformOptions thesis_or_default_boundary() {
#ifdef LISSOM_HAS_THESIS
    return thesis_formulas().deform;
#else
    return {};
#endif
}

}  // namespace lissom::test
