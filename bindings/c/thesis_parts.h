/// Options that follow the thesis, which kernel/thesis makes.
#pragma once

#include "kernel/deform/options.h"
#include "kernel/merge/merge.h"

namespace lissom::c {

/// Errors: unsupported in a build without kernel/thesis.
DeformOptions literal_deform_options();
const ThesisFormulas& literal_formulas();

}  // namespace lissom::c
